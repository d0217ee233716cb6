#include "core/scene/atlas/levels.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/alloc.h"
#include "core/scene/atlas/splash.h"
#include "kernels/dialect/image/format.h"

static const int rows[RG_ATLAS_VIEWS + 1] = {RG_ATLAS_ROWS};

static int level_px(int size, int level)
{
    return size >> level > 1 ? size >> level : 1;
}

int rg_atlas_row_start(int view, int level)
{
    return rows[view] >> level;
}

int rg_atlas_row_height(int view, int level)
{
    return (rows[view + 1] >> level) - (rows[view] >> level);
}

size_t rg_atlas_image_texels(const struct rg_atlas_image *image)
{
    size_t texels = 0;
    for (int level = 0; level < image->levels; level++)
        texels += (size_t)level_px(image->width, level) * (size_t)level_px(image->height, level);
    return texels * (size_t)image->layers;
}

// The offset of a layer's level.
static size_t offset_of(const struct rg_atlas_image *image, int layer, int level)
{
    struct rg_atlas_image above = *image;
    above.layers = 1;
    const size_t layer_texels = rg_atlas_image_texels(&above);
    above.levels = level;
    return layer_texels * (size_t)layer + rg_atlas_image_texels(&above);
}

const uint16_t *rg_atlas_texels(const struct rg_atlas *atlas, enum rg_atlas_part part, int layer,
                                int level)
{
    return atlas->images[part].texels + offset_of(&atlas->images[part], layer, level);
}

// In the order of enum rg_atlas_size.
// clang-format off
const struct rg_atlas_kind rg_atlas_kinds[RG_ATLAS_SIZE_COUNT] = {
    {"full",           false, false, RG_ATLAS_MEASURED,       {RG_SWINGS_DATABASE, RG_DATABASE_POSES, 12, 256}},
    {"small",          true,  false, RG_ATLAS_MEASURED_SMALL, {RG_SWINGS_DATABASE, RG_DATABASE_POSES, 20, 64}},
    {"cave",           false, true,  RG_ATLAS_CAVE,           {0}},
    {"cave-small",     true,  true,  RG_ATLAS_CAVE_SMALL,     {0}},
    {"measured",       false, false, RG_ATLAS_MEASURED,       {RG_SWINGS_MEASURED, 2 * RG_DATABASE_POSES, 12, 176}},
    {"measured-small", true,  false, RG_ATLAS_MEASURED_SMALL, {RG_SWINGS_MEASURED, RG_DATABASE_POSES, 20, 64}},
};
// clang-format on

struct rg_atlas *rg_atlas_allocate(enum rg_atlas_size size)
{
    struct rg_atlas *atlas = rg_alloc(1, sizeof(*atlas), "streak atlas");
    if (!atlas)
        return NULL;
    const int first = rg_atlas_kinds[size].is_small ? 2 : 0;
    atlas->size = size;
    atlas->first_level = first;
    for (int part = 0; part < 2; part++)
        atlas->images[part] = (struct rg_atlas_image){
            .width = (part == RG_ATLAS_POINT ? RG_ATLAS_CELLS : 1) * (RG_ATLAS_CELL_PX >> first),
            .height = RG_ATLAS_HEIGHT_PX >> first,
            .layers = RG_ATLAS_OSCILLATIONS,
            .levels = RG_ATLAS_MAX_LEVELS - first};
    atlas->images[RG_ATLAS_SPLASH] =
        (struct rg_atlas_image){.width = RG_SPLASH_WIDTH_PX,
                                .height = RG_SPLASH_HEIGHT_PX,
                                .layers = RG_ATLAS_MATERIALS * RG_ATLAS_FRAMES,
                                .levels = RG_SPLASH_LEVELS};
    for (int part = 0; part < RG_ATLAS_PART_COUNT; part++) {
        struct rg_atlas_image *image = &atlas->images[part];
        image->texels = rg_alloc(rg_atlas_image_texels(image), sizeof(uint16_t), "streak atlas");
        if (!image->texels) {
            rg_atlas_destroy(atlas);
            return NULL;
        }
    }
    return atlas;
}

void rg_atlas_destroy(struct rg_atlas *atlas)
{
    for (int part = 0; atlas && part < RG_ATLAS_PART_COUNT; part++)
        free(atlas->images[part].texels);
    free(atlas);
}

uint16_t rg_half_of(float value)
{
    // rg_pack_half truncates; adding half of its step first rounds
    return (uint16_t)rg_pack_half(rg_bits_float(rg_float_bits(value) + 0x1000u));
}

float rg_half_value(uint16_t half)
{
    return rg_unpack_half(half);
}

// How much of [low, high) lies in pixel i.
static double overlap(double low, double high, int i)
{
    const double from = low > i ? low : i, to = high < i + 1 ? high : i + 1;
    return to > from ? to - from : 0;
}

static double mean_of(const float *from, int width, const double x[2], const double y[2])
{
    double sum = 0, area = 0;
    for (int r = (int)y[0]; r < y[1]; r++) {
        for (int c = (int)x[0]; c < x[1]; c++) {
            const double share = overlap(x[0], x[1], c) * overlap(y[0], y[1], r);
            sum += share * (double)from[r * width + c];
            area += share;
        }
    }
    return sum / area;
}

void rg_shrink(const float *from, int width, int height, float *to, int to_width, int to_height)
{
    for (int r = 0; r < to_height; r++) {
        const double y[2] = {(double)r * height / to_height, (double)(r + 1) * height / to_height};
        for (int c = 0; c < to_width; c++) {
            const double x[2] = {(double)c * width / to_width, (double)(c + 1) * width / to_width};
            to[r * to_width + c] = (float)mean_of(from, width, x, y);
        }
    }
}

void rg_atlas_put_cell(struct rg_atlas *atlas, enum rg_atlas_part part, int layer, int view,
                       int column, int level, const float *texels)
{
    struct rg_atlas_image *image = &atlas->images[part];
    const int own = level - atlas->first_level, width = RG_ATLAS_CELL_PX >> level;
    const int pitch = level_px(image->width, own);
    uint16_t *to = image->texels + offset_of(image, layer, own) +
                   (size_t)(rg_atlas_row_start(view, level) * pitch + column * width);
    for (int r = 0; r < rg_atlas_row_height(view, level); r++)
        for (int c = 0; c < width; c++)
            to[(size_t)r * (size_t)pitch + (size_t)c] = rg_half_of(texels[r * width + c]);
}

bool rg_atlas_put_cell_levels(struct rg_atlas *atlas, enum rg_atlas_part part, int layer, int view,
                              int column, int level, const float *texels)
{
    const int width = RG_ATLAS_CELL_PX >> level, height = rg_atlas_row_height(view, level);
    float *shrunk = rg_alloc((size_t)(width * height), sizeof(float), "a cell of the atlas");
    if (!shrunk)
        return false;
    rg_atlas_put_cell(atlas, part, layer, view, column, level, texels);
    for (int below = level + 1; below < RG_ATLAS_CELL_LEVELS; below++) {
        rg_shrink(texels, width, height, shrunk, RG_ATLAS_CELL_PX >> below,
                  rg_atlas_row_height(view, below));
        rg_atlas_put_cell(atlas, part, layer, view, column, below, shrunk);
    }
    free(shrunk);
    return true;
}

bool rg_atlas_shrink_layer(struct rg_atlas_image *image, int layer, int level)
{
    int width = level_px(image->width, level - 1), height = level_px(image->height, level - 1);
    float *above = rg_alloc((size_t)(width * height), sizeof(float), "a level of the atlas");
    float *below =
        above ? rg_alloc((size_t)(width * height), sizeof(float), "a level of the atlas") : NULL;
    const uint16_t *from = image->texels + offset_of(image, layer, level - 1);
    for (int i = 0; below && i < width * height; i++)
        above[i] = rg_half_value(from[i]);
    for (; below && level < image->levels; level++) {
        const int to_width = level_px(image->width, level);
        const int to_height = level_px(image->height, level);
        uint16_t *to = image->texels + offset_of(image, layer, level);
        rg_shrink(above, width, height, below, to_width, to_height);
        for (int i = 0; i < to_width * to_height; i++)
            to[i] = rg_half_of(below[i]);
        memcpy(above, below, (size_t)(to_width * to_height) * sizeof(float));
        width = to_width;
        height = to_height;
    }
    const bool done = below != NULL;
    free(above);
    free(below);
    return done;
}

static void hash_floats(XXH3_state_t *state, const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const uint32_t bits = rg_float_bits(values[i]);
        const unsigned char bytes[4] = {(unsigned char)bits, (unsigned char)(bits >> 8),
                                        (unsigned char)(bits >> 16), (unsigned char)(bits >> 24)};
        XXH3_64bits_update(state, bytes, sizeof(bytes));
    }
}

static void hash_halves(XXH3_state_t *state, const uint16_t *halves, size_t count)
{
    unsigned char bytes[8192];
    for (size_t done = 0; done < count;) {
        const size_t part = count - done < sizeof(bytes) / 2 ? count - done : sizeof(bytes) / 2;
        for (size_t i = 0; i < part; i++) {
            bytes[2 * i] = (unsigned char)halves[done + i];
            bytes[2 * i + 1] = (unsigned char)(halves[done + i] >> 8);
        }
        XXH3_64bits_update(state, bytes, 2 * part);
        done += part;
    }
}

bool rg_atlas_find_hash(struct rg_atlas *atlas)
{
    XXH3_state_t *state = XXH3_createState();
    if (!state)
        return rg_harness_error("streak atlas: no memory for its hash");
    XXH3_64bits_reset(state);
    hash_floats(state, &atlas->point_factor[0][0][0][0],
                sizeof(atlas->point_factor) / sizeof(float));
    hash_floats(state, &atlas->env_factor[0][0], sizeof(atlas->env_factor) / sizeof(float));
    hash_floats(state, &atlas->splash_part[0][0][0], sizeof(atlas->splash_part) / sizeof(float));
    for (int part = 0; part < RG_ATLAS_PART_COUNT; part++)
        hash_halves(state, atlas->images[part].texels, rg_atlas_image_texels(&atlas->images[part]));
    atlas->hash = XXH3_64bits_digest(state);
    XXH3_freeState(state);
    return true;
}
