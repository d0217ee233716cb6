// Picture files: round trips, and one line for everything that can be wrong with them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <png.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/image/files/format.h"
#include "core/image/files/io.h"
#include "core/image/srgb.h"
#include "tests/core/image/files/scratch.h"
#include "tests/tools/expect.h"

static void assert_refused(const char *name, const char *word)
{
    struct rg_picture picture = {.width = 1, .height = 1, .channels = 1, .texels = (float *)1};
    error_count = 0;
    assert_false(rg_picture_read(in_folder(name), &picture));
    if (error_count != 1 || !strstr(errors, word) || !strstr(errors, name))
        fail_msg("%d lines, the last: %s", error_count, errors);
    assert_null(picture.texels);
}

static void floats_come_back(const char *name, int channels, bool full_float, float tolerance)
{
    struct rg_picture picture = noise_picture(channels), back;
    const struct rg_write_options options = {.full_float = full_float};
    assert_true(rg_picture_write(in_folder(name), &picture, &options));
    assert_true(rg_picture_read(in_folder(name), &back));
    assert_int_equal(back.width, WIDTH);
    assert_int_equal(back.height, HEIGHT);
    assert_int_equal(back.channels, channels);
    for (int64_t i = 0; i < rg_picture_values(&picture); i++)
        if (!(fabsf(back.texels[i] - picture.texels[i]) <= tolerance))
            fail_msg("%s, value %d: %g is not %g", name, (int)i, (double)back.texels[i],
                     (double)picture.texels[i]);
    rg_picture_destroy(&picture);
    rg_picture_destroy(&back);
    unlink(in_folder(name));
}

static void exr_keeps_floats(void **state)
{
    (void)state;
    for (int channels = 1; channels <= 4; channels++) {
        floats_come_back("float.exr", channels, true, 0.0f);
        floats_come_back("half.exr", channels, false, 0x1p-12f);
    }
}

static void hdr_and_tiff_keep_floats(void **state)
{
    (void)state;
    floats_come_back("light.hdr", 3, false, 0x1p-8f);
    for (int channels = 1; channels <= 4; channels++) {
        floats_come_back("float.tif", channels, true, 0.0f);
        floats_come_back("half.tiff", channels, false, 0x1p-12f);
    }
}

static void png_keeps_codes(void **state)
{
    (void)state;
    for (int channels = 1; channels <= 4; channels++) {
        struct rg_picture picture, back;
        assert_true(rg_picture_create(&picture, 256, 1, channels, "codes"));
        for (int i = 0; i < 256 * channels; i++)
            picture.texels[i] = i % channels == rg_picture_colours(&picture)
                                    ? (float)(i / channels) / 255.0f
                                    : (float)rg_srgb_decode((255 - i / channels) / 255.0);
        assert_true(
            rg_picture_write(in_folder("codes.png"), &picture, &(struct rg_write_options){0}));
        assert_true(rg_picture_read(in_folder("codes.png"), &back));
        assert_int_equal(back.channels, channels);
        assert_memory_equal(back.texels, picture.texels, (size_t)(256 * channels) * 4);
        rg_picture_destroy(&picture);
        rg_picture_destroy(&back);
    }
    unlink(in_folder("codes.png"));
}

// The exposure multiplies linear light before it is encoded.
static void png_is_exposed(void **state)
{
    (void)state;
    struct rg_picture picture, back;
    assert_true(rg_picture_create(&picture, 1, 1, 3, "grey"));
    for (int c = 0; c < 3; c++)
        picture.texels[c] = 0.1f;
    const struct rg_write_options options = {.exposure = 3};
    assert_true(rg_picture_write(in_folder("grey.png"), &picture, &options));
    assert_true(rg_picture_read(in_folder("grey.png"), &back));
    int code = (int)floor(255 * rg_srgb_encode(0.1 * 3) + 0.5);
    assert_equals(back.texels[0], (float)rg_srgb_decode(code / 255.0));
    rg_picture_destroy(&picture);
    rg_picture_destroy(&back);
    unlink(in_folder("grey.png"));
}

static void png_of_16_bits_is_decoded(void **state)
{
    (void)state;
    static const uint16_t codes[4] = {0, 1234, 40000, 65535};
    png_image image = {.version = PNG_IMAGE_VERSION, .width = 4, .height = 1};
    image.format = PNG_FORMAT_LINEAR_Y;
    // The simplified writer stores linear 16-bit values as they are, and says so (gAMA 100000).
    assert_true(png_image_write_to_file(&image, in_folder("deep.png"), 0, codes, 0, NULL));
    struct rg_picture back;
    assert_true(rg_picture_read(in_folder("deep.png"), &back));
    for (int i = 0; i < 4; i++)
        assert_equals(back.texels[i], (float)(codes[i] / 65535.0));
    assert_true(back.decoded);
    assert_equals(back.gamma, 1);
    rg_picture_destroy(&back);
    struct rg_why why;
    assert_true(rg_png_read_codes(in_folder("deep.png"), 1000, &back, &why));
    for (int i = 0; i < 4; i++)
        assert_equals(back.texels[i], (float)codes[i] / 65535.0f);
    assert_false(back.decoded);
    rg_picture_destroy(&back);
    unlink(in_folder("deep.png"));
}

static void encoding_is_the_formula(void **state)
{
    (void)state;
    const struct rg_srgb *srgb = rg_srgb();
    for (uint32_t i = 0; i < 400000; i++) {
        float x = (float)(rain_noise(i) >> 8) * 0x1p-24f;
        x = i % 4 ? x : x * x * x;
        assert_int_equal(rg_srgb_code(srgb, x), (int)floor(255 * rg_srgb_encode((double)x) + 0.5));
        assert_equals(rg_srgb_encoded(srgb, x), (float)rg_srgb_encode((double)x));
    }
    for (int c = 1; c < 256; c++) {
        assert_equals(rg_srgb_encoded(srgb, srgb->linear[c]),
                      (float)rg_srgb_encode((double)srgb->linear[c]));
        assert_int_equal(rg_srgb_code(srgb, srgb->threshold[c]), c);
        assert_int_equal(rg_srgb_code(srgb, nextafterf(srgb->threshold[c], 0)), c - 1);
    }
    assert_int_equal(rg_srgb_code(srgb, -1.0f), 0);
    assert_int_equal(rg_srgb_code(srgb, NAN), 0);
    assert_int_equal(rg_srgb_code(srgb, INFINITY), 255);
}

static void what_cannot_be_read_is_refused(void **state)
{
    (void)state;
    assert_refused("missing.png", "check the name");
    assert_refused("missing", "extension is missing");
    write_bytes("picture.jpg", "x", 1);
    assert_refused("picture.jpg", ".jpg");
    mkdir(in_folder("folder.exr"), 0777);
    assert_refused("folder.exr", "folder");
    rmdir(in_folder("folder.exr"));
    const char *const names[] = {"bad.exr", "bad.png", "bad.hdr", "bad.tif"};
    for (int i = 0; i < 4; i++) {
        write_bytes(names[i], "", 0);
        assert_refused(names[i], "empty");
        write_bytes(names[i], "this is not a picture at all, whatever its name may say", 55);
        assert_refused(names[i], "write it again");
        unlink(in_folder(names[i]));
    }
    unlink(in_folder("picture.jpg"));
}

static void what_is_cut_short_is_refused(void **state)
{
    (void)state;
    const char *const names[] = {"cut.exr", "cut.png", "cut.hdr", "cut.tif"};
    struct rg_picture picture = noise_picture(3);
    for (int i = 0; i < 4; i++) {
        const struct rg_write_options options = {.full_float = true};
        assert_true(rg_picture_write(in_folder(names[i]), &picture, &options));
        struct stat st;
        assert_int_equal(stat(in_folder(names[i]), &st), 0);
        for (int part = 1; part < 8; part++) {
            assert_int_equal(truncate(in_folder(names[i]), st.st_size * (8 - part) / 8), 0);
            assert_refused(names[i], "write it again");
        }
        unlink(in_folder(names[i]));
    }
    rg_picture_destroy(&picture);
}

static void put_32(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> (24 - 8 * i));
}

// A PNG of 300 bytes or so whose header says `width` x `height`.
static void write_png_header(const char *name, uint32_t width, uint32_t height)
{
    uint8_t bytes[64] = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR";
    put_32(bytes + 16, width);
    put_32(bytes + 20, height);
    bytes[24] = 8;
    bytes[25] = 6;
    uint32_t crc = ~0u;
    for (int i = 12; i < 29; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    put_32(bytes + 29, ~crc);
    memcpy(bytes + 33, "\0\0\0\x08IDAT", 8);
    write_bytes(name, bytes, sizeof(bytes));
}

static void absurd_sizes_are_refused(void **state)
{
    (void)state;
    write_png_header("huge.png", 60000, 60000);
    assert_refused("huge.png", "can hold");
    write_png_header("huge.png", 2000000000, 2000000000);
    assert_refused("huge.png", "write it again");
    write_png_header("huge.png", 0, 7);
    assert_refused("huge.png", "write it again");
    unlink(in_folder("huge.png"));
    static const char header[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n";
    write_bytes("huge.hdr", header, sizeof(header) - 1);
    assert_refused("huge.hdr", "can hold");
    unlink(in_folder("huge.hdr"));
    struct rg_picture picture;
    error_count = 0;
    assert_false(rg_picture_create(&picture, 65536, 65536, 4, "huge"));
    assert_false(rg_picture_create(&picture, 0, 5, 4, "none"));
    assert_false(rg_picture_create(&picture, 5, 5, 5, "five"));
    assert_int_equal(error_count, 3);
    rg_picture_destroy(&picture);
    rg_picture_destroy(NULL);
}

static void huge_exr_is_refused(void **state)
{
    (void)state;
    struct rg_picture picture = noise_picture(3);
    assert_true(rg_picture_write(in_folder("huge.exr"), &picture, &(struct rg_write_options){0}));
    rg_picture_destroy(&picture);
    static uint8_t bytes[65536];
    FILE *file = fopen(in_folder("huge.exr"), "rb");
    size_t size = fread(bytes, 1, sizeof(bytes), file);
    fclose(file);
    static const uint8_t far_corner[8] = {0x5f, 0xea, 0, 0, 0x5f, 0xea, 0, 0}; // 59999, 59999
    for (size_t i = 0; i + 40 < size; i++)
        if (!memcmp(bytes + i, "dataWindow\0box2i", 17))
            memcpy(bytes + i + 17 + 4 + 8, far_corner, 8);
    write_bytes("huge.exr", bytes, size);
    assert_refused("huge.exr", "write it again");
    unlink(in_folder("huge.exr"));
}

static void nonfinite_texels_are_kept_and_counted(void **state)
{
    (void)state;
    struct rg_picture picture = noise_picture(3), back;
    picture.texels[(5 * WIDTH + 7) * 3 + 1] = NAN;
    picture.texels[(9 * WIDTH + 2) * 3] = -INFINITY;
    const struct rg_write_options options = {.full_float = true};
    assert_true(rg_picture_write(in_folder("nan.exr"), &picture, &options));
    warning_count = 0;
    assert_true(rg_picture_read(in_folder("nan.exr"), &back));
    assert_int_equal(warning_count, 1);
    assert_non_null(strstr(errors, "2 values are NaN or infinite, the first at x 7, y 5"));
    assert_true(isnan(back.texels[(5 * WIDTH + 7) * 3 + 1]));
    assert_equals(back.texels[(9 * WIDTH + 2) * 3], -INFINITY);
    rg_picture_destroy(&picture);
    rg_picture_destroy(&back);
    struct rg_picture both[2];
    const char *const paths[] = {in_folder("nan.exr"), in_folder("nan.exr")};
    warning_count = 0;
    assert_true(rg_pictures_read(paths, both, 2));
    assert_int_equal(warning_count, 1);
    rg_picture_destroy(&both[0]);
    rg_picture_destroy(&both[1]);
    unlink(in_folder("nan.exr"));
}

// A tiled TIFF of signed 8-bit CMYK: OpenImageIO 2.4 writes past its memory with it.
static void write_signed_cmyk(const char *name)
{
    enum { SIDE = 64, ENTRIES = 12, AFTER = 8 + 2 + 12 * ENTRIES + 4 };
    static struct {
        char magic[4];
        uint32_t first;
    } head = {{'I', 'I', 42, 0}, 8};
    static const struct {
        uint16_t tag, type;
        uint32_t count, value;
    } entries[ENTRIES] = {
        {256, 3, 1, SIDE},
        {257, 3, 1, SIDE},
        {258, 3, 4, AFTER},
        {259, 3, 1, 1},
        {262, 3, 1, 5},
        {277, 3, 1, 4},
        {284, 3, 1, 1},
        {322, 3, 1, SIDE},
        {323, 3, 1, SIDE},
        {324, 4, 1, 200},
        {325, 4, 1, SIDE * SIDE * 4},
        {339, 3, 4, AFTER + 8},
    };
    static unsigned char file[200 + SIDE * SIDE * 4];
    static const uint16_t count = ENTRIES, bits[] = {8, 8, 8, 8}, is_signed[] = {2, 2, 2, 2};
    memset(file, 0x81, sizeof(file));
    memcpy(file, &head, sizeof(head));
    memcpy(file + 8, &count, sizeof(count));
    memcpy(file + 10, entries, sizeof(entries));
    memset(file + 10 + sizeof(entries), 0, 4);
    memcpy(file + AFTER, bits, sizeof(bits));
    memcpy(file + AFTER + 8, is_signed, sizeof(is_signed));
    write_bytes(name, file, sizeof(file));
}

static void a_crash_of_the_library_is_one_line(void **state)
{
    (void)state;
    write_signed_cmyk("cmyk.tif");
    assert_refused("cmyk.tif", "OpenImageIO");
    unlink(in_folder("cmyk.tif"));
}

// Several bad files leave one line, about the first.
static void one_line_for_many_files(void **state)
{
    (void)state;
    struct rg_picture picture = noise_picture(3), pictures[3];
    assert_true(rg_picture_write(in_folder("good.png"), &picture, &(struct rg_write_options){0}));
    char good[256], bad[256], worse[256];
    snprintf(good, sizeof(good), "%s/good.png", folder);
    snprintf(bad, sizeof(bad), "%s/bad.png", folder);
    snprintf(worse, sizeof(worse), "%s/worse.png", folder);
    error_count = 0;
    assert_false(rg_pictures_read((const char *[]){good, bad, worse}, pictures, 3));
    assert_int_equal(error_count, 1);
    assert_non_null(strstr(errors, "bad.png"));
    assert_null(pictures[0].texels);
    assert_true(rg_pictures_read((const char *[]){good, good, good}, pictures, 3));
    for (int i = 0; i < 3; i++)
        rg_picture_destroy(&pictures[i]);
    rg_picture_destroy(&picture);
    unlink(in_folder("good.png"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exr_keeps_floats),
        cmocka_unit_test(hdr_and_tiff_keep_floats),
        cmocka_unit_test(png_keeps_codes),
        cmocka_unit_test(png_is_exposed),
        cmocka_unit_test(png_of_16_bits_is_decoded),
        cmocka_unit_test(encoding_is_the_formula),
        cmocka_unit_test(what_cannot_be_read_is_refused),
        cmocka_unit_test(what_is_cut_short_is_refused),
        cmocka_unit_test(absurd_sizes_are_refused),
        cmocka_unit_test(huge_exr_is_refused),
        cmocka_unit_test(nonfinite_texels_are_kept_and_counted),
        cmocka_unit_test(a_crash_of_the_library_is_one_line),
        cmocka_unit_test(one_line_for_many_files),
    };
    return cmocka_run_group_tests_name("picture files", tests, make_scratch, remove_scratch);
}
