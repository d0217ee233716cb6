#define _DEFAULT_SOURCE // mkstemps
// EXR files as other programs write them: without compression, which raingauge always uses.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <openexr.h>
#include <stdlib.h>
#include <unistd.h>

#include "core/image/files/io.h"
#include "tests/tools/expect.h"

// Initializers of newer OpenEXR name the first field alone.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

enum { WIDTH = 7, HIGH = 5, MOST = 4 };

static char path[] = "/tmp/raingauge-foreign-XXXXXX.exr";

// Exact as a half, too.
static float value(int x, int y, int channel)
{
    return (float)(x - 3 * y) * 0.25f + (float)channel;
}

static void write_exr(const char *names, int channels, exr_pixel_type_t type)
{
    float texels[HIGH][WIDTH][MOST];
    for (int i = 0; i < HIGH * WIDTH * MOST; i++)
        texels[i / WIDTH / MOST][i / MOST % WIDTH][i % MOST] =
            value(i / MOST % WIDTH, i / WIDTH / MOST, i % MOST);
    exr_context_t exr;
    int part;
    assert_int_equal(exr_start_write(&exr, path, EXR_WRITE_FILE_DIRECTLY, NULL), EXR_ERR_SUCCESS);
    exr_add_part(exr, NULL, EXR_STORAGE_SCANLINE, &part);
    exr_initialize_required_attr_simple(exr, part, WIDTH, HIGH, EXR_COMPRESSION_NONE);
    for (int c = 0; c < channels; c++)
        exr_add_channel(exr, part, (char[]){names[c], 0}, type, EXR_PERCEPTUALLY_LINEAR, 1, 1);
    assert_int_equal(exr_write_header(exr), EXR_ERR_SUCCESS);
    exr_encode_pipeline_t encode = EXR_ENCODE_PIPELINE_INITIALIZER;
    for (int y = 0; y < HIGH; y++) {
        exr_chunk_info_t info;
        exr_write_scanline_chunk_info(exr, 0, y, &info);
        y ? exr_encoding_update(exr, 0, &info, &encode)
          : exr_encoding_initialize(exr, 0, &info, &encode);
        for (int c = 0; c < channels; c++) {
            const char *at = names;
            while (*at != encode.channels[c].channel_name[0])
                at++;
            encode.channels[c].encode_from_ptr = (const uint8_t *)&texels[y][0][at - names];
            encode.channels[c].user_data_type = EXR_PIXEL_FLOAT;
            encode.channels[c].user_bytes_per_element = 4;
            encode.channels[c].user_pixel_stride = MOST * 4;
            encode.channels[c].user_line_stride = WIDTH * MOST * 4;
        }
        if (!y)
            exr_encoding_choose_default_routines(exr, 0, &encode);
        assert_int_equal(exr_encoding_run(exr, 0, &encode), EXR_ERR_SUCCESS);
    }
    exr_encoding_destroy(exr, &encode);
    assert_int_equal(exr_finish(&exr), EXR_ERR_SUCCESS);
}

static void comes_back(const char *names, int channels, exr_pixel_type_t type)
{
    struct rg_picture picture;
    write_exr(names, channels, type);
    assert_true(rg_picture_read(path, &picture));
    assert_int_equal(picture.channels, channels);
    for (int y = 0; y < HIGH; y++)
        for (int x = 0; x < WIDTH; x++)
            for (int c = 0; c < channels; c++)
                assert_equals(picture.texels[(y * WIDTH + x) * channels + c], value(x, y, c));
    rg_picture_destroy(&picture);
    unlink(path);
}

// With one channel of floats the library reads straight into the picture, and there is nothing to
// unpack.
static void one_channel_of_floats(void **state)
{
    (void)state;
    comes_back("Y", 1, EXR_PIXEL_FLOAT);
}

static void other_channels(void **state)
{
    (void)state;
    comes_back("Y", 1, EXR_PIXEL_HALF);
    comes_back("YA", 2, EXR_PIXEL_FLOAT);
    comes_back("RGB", 3, EXR_PIXEL_HALF);
    comes_back("RGB", 3, EXR_PIXEL_FLOAT);
    comes_back("RGBA", 4, EXR_PIXEL_FLOAT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_channel_of_floats),
        cmocka_unit_test(other_channels),
    };
    const int fd = mkstemps(path, 4);
    if (fd < 0 || close(fd))
        return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
