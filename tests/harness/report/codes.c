// Pictures of the page keep every code: what WebP holds is what PNG held.
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <webp/decode.h>
#include <webp/encode.h>

#include "harness/report/pictures/codes.h"
#include "tests/tools/expect.h"

enum { WIDTH = 61, HEIGHT = 37, BYTES = 4 * WIDTH * HEIGHT };

// Codes of all kinds, among them coloured ones that alpha hides.
static void make(uint8_t texels[BYTES])
{
    uint32_t state = 1;
    for (int i = 0; i < BYTES; i++) {
        state = state * 1664525 + 1013904223;
        texels[i] = (uint8_t)(i % 4 == 3 ? (i % 8 == 3 ? 0 : 255) : state >> 24);
    }
}

// The PNG of texels in a format of libpng's; the caller frees it.
static void *png_of(const void *texels, uint32_t format, size_t *size)
{
    png_image image = {
        .version = PNG_IMAGE_VERSION, .width = WIDTH, .height = HEIGHT, .format = format};
    png_alloc_size_t bytes = 0;
    assert_true(png_image_write_to_memory(&image, NULL, &bytes, 0, texels, 0, NULL));
    void *png = malloc(bytes);
    assert_true(png_image_write_to_memory(&image, png, &bytes, 0, texels, 0, NULL));
    *size = bytes;
    return png;
}

static void test_nothing_is_lost(void **state)
{
    (void)state;
    uint8_t texels[BYTES];
    size_t size, webp_size;
    int width, height;
    struct rg_codes codes;
    make(texels);
    void *png = png_of(texels, PNG_FORMAT_RGBA, &size);
    assert_true(rg_codes_of_png(png, size, &codes));
    assert_int_equal(codes.width, WIDTH);
    assert_int_equal(codes.height, HEIGHT);
    uint8_t *webp = rg_codes_webp(&codes, &webp_size);
    uint8_t *decoded = WebPDecodeRGBA(webp, webp_size, &width, &height);
    assert_int_equal(width, WIDTH);
    assert_int_equal(height, HEIGHT);
    assert_memory_equal(decoded, texels, BYTES);
    WebPFree(decoded);
    free(webp);
    free(png);
    rg_codes_free(&codes);
}

// A picture has one digest, whatever its file; others have another, and so has another shape.
static void test_digests(void **state)
{
    (void)state;
    uint8_t texels[BYTES];
    make(texels);
    struct rg_codes codes = {WIDTH, HEIGHT, texels}, turned = {HEIGHT, WIDTH, texels};
    const uint64_t digest = rg_codes_digest(&codes);
    assert_true(rg_codes_digest(&turned) != digest);
    texels[BYTES - 4] ^= 1;
    assert_true(rg_codes_digest(&codes) != digest);
}

// The chunk that makes a PNG an animation, of two frames; its place is behind the head.
enum { BEFORE_FRAMES = 33 };
static const uint8_t frames[] = {0, 0, 0, 8, 'a', 'c', 'T',  'L',  0,    0,
                                 0, 2, 0, 0, 0,   0,   0xf3, 0x8d, 0x93, 0x70};

// A PNG that WebP cannot hold, or that is damaged, stays what it is.
static void test_others_are_left(void **state)
{
    (void)state;
    static uint16_t wide[BYTES];
    uint8_t texels[BYTES];
    size_t size;
    struct rg_codes codes;
    void *png = png_of(wide, PNG_FORMAT_LINEAR_RGB_ALPHA, &size);
    assert_false(rg_codes_of_png(png, size, &codes));
    free(png);
    make(texels);
    png = png_of(texels, PNG_FORMAT_RGBA, &size);
    assert_false(rg_codes_of_png(png, size / 2, &codes));
    assert_null(codes.texels);
    assert_true(rg_codes_of_png(png, size, &codes));
    rg_codes_free(&codes);
    uint8_t *animation = malloc(size + sizeof(frames));
    memcpy(animation, png, BEFORE_FRAMES);
    memcpy(animation + BEFORE_FRAMES, frames, sizeof(frames));
    memcpy(animation + BEFORE_FRAMES + sizeof(frames), (char *)png + BEFORE_FRAMES,
           size - BEFORE_FRAMES);
    assert_false(rg_codes_of_png(animation, size + sizeof(frames), &codes));
    free(animation);
    free(png);
}

// WebP holds 16383 pixels along a side.
static void test_sizes(void **state)
{
    (void)state;
    static uint8_t line[4 * (WEBP_MAX_DIMENSION + 1)];
    for (int turned = 0; turned < 2; turned++)
        for (int more = 0; more < 2; more++) {
            const int side = WEBP_MAX_DIMENSION + more;
            png_image image = {.version = PNG_IMAGE_VERSION,
                               .width = turned ? 1 : (png_uint_32)side,
                               .height = turned ? (png_uint_32)side : 1,
                               .format = PNG_FORMAT_RGBA};
            png_alloc_size_t size = 0;
            struct rg_codes codes;
            assert_true(png_image_write_to_memory(&image, NULL, &size, 0, line, 0, NULL));
            void *png = malloc(size);
            assert_true(png_image_write_to_memory(&image, png, &size, 0, line, 0, NULL));
            assert_int_equal(rg_codes_of_png(png, size, &codes), !more);
            rg_codes_free(&codes);
            free(png);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_is_lost),
        cmocka_unit_test(test_digests),
        cmocka_unit_test(test_others_are_left),
        cmocka_unit_test(test_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
