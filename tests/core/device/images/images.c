// Images keep texels of every format, layer and level.
#include "tests/core/device/images/texels.h"
#include "tests/core/device/suite.h"

static const struct {
    int width, height, layers, levels;
} shapes[] = {{1, 1, 1, 1}, {3, 5, 1, 1}, {257, 129, 2, 9}, {64, 64, 3, 7}, {1, 130, 2, 8}};

static size_t level_size(const struct rg_image_desc *desc, int level)
{
    return (size_t)(rg_level_size(desc->width, level) * rg_level_size(desc->height, level) *
                    rg_format_size(desc->format));
}

// The texels that a test writes to a layer of a level; the caller frees them.
static void *layer_texels(const struct rg_image_desc *desc, int layer, int level)
{
    const size_t size = level_size(desc, level);
    void *texels = malloc(size);
    random_texels(desc->format, (uint32_t)(layer * 100 + level) * 7919u,
                  (int)size / rg_format_size(desc->format), texels);
    return texels;
}

static void write_all(struct rg_image *image)
{
    for (int layer = 0; layer < image->desc.layers; layer++) {
        for (int level = 0; level < image->desc.levels; level++) {
            void *texels = layer_texels(&image->desc, layer, level);
            assert_true(rg_image_write(image, layer, level, texels));
            free(texels);
        }
    }
}

static void check_all(struct rg_image *image)
{
    for (int layer = 0; layer < image->desc.layers; layer++) {
        for (int level = 0; level < image->desc.levels; level++) {
            const size_t size = level_size(&image->desc, level);
            void *texels = layer_texels(&image->desc, layer, level), *back = calloc(1, size);
            assert_true(rg_image_read(image, layer, level, back));
            if (memcmp(texels, back, size))
                fail_msg("%s, %dx%d, layer %d, level %d", rg_format_name(image->desc.format),
                         image->desc.width, image->desc.height, layer, level);
            free(texels);
            free(back);
        }
    }
}

static void images_keep_what_was_written(void **state)
{
    for (int format = RG_RGBA8; format < RG_FORMAT_COUNT; format++) {
        for (int s = 0; s < COUNT_OF(shapes); s++) {
            const struct rg_image_desc desc = {(enum rg_format)format, shapes[s].width,
                                               shapes[s].height, shapes[s].layers,
                                               shapes[s].levels};
            struct rg_image *image = rg_image_create(*state, &desc, "image");
            assert_non_null(image);
            write_all(image);
            check_all(image);
            rg_image_destroy(image);
        }
    }
}

static void check_clear(struct rg_image *image, const unsigned char *texel, int texel_size)
{
    for (int layer = 0; layer < image->desc.layers; layer++) {
        for (int level = 0; level < image->desc.levels; level++) {
            const size_t size = level_size(&image->desc, level);
            unsigned char *back = calloc(1, size);
            assert_true(rg_image_read(image, layer, level, back));
            for (size_t i = 0; i < size; i++)
                if (back[i] != texel[i % (size_t)texel_size])
                    fail_msg("%s, layer %d, level %d, byte %zu", rg_format_name(image->desc.format),
                             layer, level, i);
            free(back);
        }
    }
}

static void clearing_sets_every_layer_and_level(void **state)
{
    for (int format = RG_RGBA8; format < RG_FORMAT_COUNT; format++) {
        const struct rg_image_desc desc = {(enum rg_format)format, 37, 19, 3, 6};
        struct rg_image *image = rg_image_create(*state, &desc, "image");
        assert_non_null(image);
        write_all(image);
        for (uint32_t seed = 1; seed < 4; seed++) {
            uint32_t texel[4];
            random_texels(desc.format, seed, 1, texel);
            assert_true(rg_image_clear(image, texel));
            check_clear(image, (const unsigned char *)texel, rg_format_size(desc.format));
        }
        write_all(image);
        check_all(image);
        rg_image_destroy(image);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(images_keep_what_was_written),
    cmocka_unit_test(clearing_sets_every_layer_and_level),
};
const struct suite_tests image_tests = {tests, COUNT_OF(tests)};
