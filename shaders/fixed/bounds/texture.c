// The texture functions of a sampler.
//
// A coordinate has an interval, and so has each weight: a device keeps so many bits of a
// coordinate's fraction (Vulkan, Texel Filtering, subTexelPrecisionBits; OpenGL gives no number).
// A linear filter is linear between texel centres in x and in y, so that its least and greatest
// value over a box of coordinates lie at the box's corners and at texel centres inside.
#include <string.h>

#include "shaders/fixed/bounds/scene.h"

// --- texels ---

static double decode_srgb(double code)
{
    const double value = fmin(fmax(code / 255, 0), 1);
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

static struct rg_span decode(const struct rg_fixed_state *state, const uint8_t *texel, int c)
{
    float depth;
    if (state->texels == RG_FIXED_TEXELS_D32F) {
        memcpy(&depth, texel, sizeof(depth));
        return rg_span_at(c ? 0 : depth);
    }
    // No number is given for the curve's precision: half a code of what is stored.
    if (state->texels == RG_FIXED_TEXELS_SRGB8 && c < 3)
        return (struct rg_span){decode_srgb(texel[c] - 0.5), decode_srgb(texel[c] + 0.5)};
    return rg_span_at(texel[c] / 255.0);
}

static void decode_level(struct rg_scene *scene, int layer, int level)
{
    uint8_t bytes[RG_FIXED_LEVEL_BYTES];
    const struct rg_fixed_state *state = scene->state;
    struct rg_span(*texels)[4] = scene->texture.texels[layer][level];
    const int px = RG_FIXED_TEXTURE_PX >> level;
    rg_fixed_make_texels(state, layer, level, bytes);
    if (state->texels >= RG_FIXED_TEXELS_BC1) {
        rg_decode_blocks(state->texels, bytes, texels);
        return;
    }
    for (int i = 0; i < px * px; i++)
        for (int c = 0; c < 4; c++)
            texels[i][c] = decode(state, bytes + (ptrdiff_t)4 * i, c);
}

void rg_scene_texture(struct rg_scene *scene)
{
    static const double borders[][4] = {{0, 0, 0, 0}, {0, 0, 0, 1}, {1, 1, 1, 1}};
    struct rg_texture *texture = &scene->texture;
    texture->weight = rg_precision_step(scene->precision->subtexel_bits);
    for (int c = 0; c < 4; c++)
        texture->border[c] = rg_span_at(borders[scene->state->border][c]);
    if (!scene->state->texels)
        return;
    texture->layers = rg_fixed_layers(scene->state);
    texture->levels = rg_fixed_levels(scene->state);
    for (int layer = 0; layer < texture->layers; layer++)
        for (int level = 0; level < texture->levels; level++)
            decode_level(scene, layer, level);
    if (scene->state->texture == RG_FIXED_CUBE)
        rg_cube_corners(texture);
}

// --- addressing (OpenGL, Coordinate Wrapping and Texel Selection; Vulkan, Wrapping Operation) ---

// -1: the border.
static int wrap(int mode, int i, int px)
{
    const int turned = i & (2 * px - 1); // px is a power of two
    switch (mode) {
    case RG_FIXED_REPEAT:
        return i & (px - 1);
    case RG_FIXED_MIRROR:
        return turned < px ? turned : 2 * px - 1 - turned;
    case RG_FIXED_EDGE:
        return i < 0 ? 0 : i >= px ? px - 1 : i;
    default:
        return i < 0 || i >= px ? -1 : i;
    }
}

static const struct rg_span *texel(const struct rg_scene *scene, int x, int y, int layer, int level)
{
    const int px = RG_FIXED_TEXTURE_PX >> level;
    if (scene->state->texture == RG_FIXED_CUBE)
        return rg_cube_texel(&scene->texture, layer, x, y);
    const int at_x = wrap(scene->state->wrap_u, x, px), at_y = wrap(scene->state->wrap_v, y, px);
    return at_x < 0 || at_y < 0 ? scene->texture.border
                                : scene->texture.texels[layer][level][at_y * px + at_x];
}

// --- filters ---

// A filter may round each mix to the texels' 8 bits: no precision of its sums is given.
static struct rg_span mixed(const struct rg_scene *scene, struct rg_span a, int mixes)
{
    const bool has_codes = scene->state->texels == RG_FIXED_TEXELS_RGBA8;
    return has_codes ? rg_span_clamp(rg_span_widen(a, mixes * 0.5 / 255), 0, 1) : a;
}

static double mix(double a, double b, double t)
{
    return a + (b - a) * t;
}

// Of a box of coordinates in texels: its ends, and the texel centres between them.
static int breaks(struct rg_span at, double all[64])
{
    int count = 0;
    all[count++] = at.low;
    for (double centre = floor(at.low) + 1; centre < at.high && count < 63; centre++)
        all[count++] = centre;
    all[count++] = at.high;
    return count;
}

static struct rg_span between(const struct rg_span *const four[4], int c, double s, double t)
{
    return (struct rg_span){
        mix(mix(four[0][c].low, four[1][c].low, s), mix(four[2][c].low, four[3][c].low, s), t),
        mix(mix(four[0][c].high, four[1][c].high, s), mix(four[2][c].high, four[3][c].high, s), t)};
}

// Coordinates in texels, whose centres are whole numbers.
static void filter(const struct rg_scene *scene, struct rg_span x, struct rg_span y, int layer,
                   int level, struct rg_span out[4])
{
    double at_x[64], at_y[64];
    const int columns = breaks(x, at_x), rows = breaks(y, at_y);
    for (int i = 0; i < columns * rows; i++) {
        const double s = at_x[i % columns], t = at_y[i / columns];
        const int left = (int)floor(s), under = (int)floor(t);
        const struct rg_span *const four[] = {texel(scene, left, under, layer, level),
                                              texel(scene, left + 1, under, layer, level),
                                              texel(scene, left, under + 1, layer, level),
                                              texel(scene, left + 1, under + 1, layer, level)};
        for (int c = 0; c < 4; c++) {
            const struct rg_span value = between(four, c, s - left, t - under);
            out[c] = i ? rg_span_join(out[c], value) : value;
        }
    }
}

struct rg_span rg_grid_filter(const struct rg_span *texels, int stride, int px, struct rg_span x,
                              struct rg_span y)
{
    double at_x[64], at_y[64];
    struct rg_span all = {INFINITY, -INFINITY};
    const int columns = breaks(x, at_x), rows = breaks(y, at_y);
    for (int i = 0; i < columns * rows; i++) {
        const double s = at_x[i % columns], t = at_y[i / columns];
        const int left = (int)floor(s), under = (int)floor(t);
        const struct rg_span *four[4];
        for (int k = 0; k < 4; k++) {
            const int column = wrap(RG_FIXED_EDGE, left + k % 2, px);
            const int row = wrap(RG_FIXED_EDGE, under + k / 2, px);
            four[k] = &texels[(ptrdiff_t)stride * (row * px + column)];
        }
        all = rg_span_join(all, between(four, 0, s - left, t - under));
    }
    return all;
}

static struct rg_span to_texels(struct rg_span u, int px, double shift, double error)
{
    return rg_span_widen((struct rg_span){u.low * px - shift, u.high * px - shift}, error);
}

// Every texel that a box touches.
static void nearest(const struct rg_scene *scene, struct rg_span x, struct rg_span y, int layer,
                    int level, struct rg_span out[4])
{
    bool is_first = true;
    for (int j = (int)floor(y.low); j <= (int)floor(y.high); j++)
        for (int i = (int)floor(x.low); i <= (int)floor(x.high); i++, is_first = false)
            for (int c = 0; c < 4; c++) {
                const struct rg_span one = texel(scene, i, j, layer, level)[c];
                out[c] = is_first ? one : rg_span_join(out[c], one);
            }
}

void rg_texture_look(const struct rg_scene *scene, struct rg_span u, struct rg_span v, int layer,
                     int level, struct rg_span out[4])
{
    const int px = RG_FIXED_TEXTURE_PX >> level;
    const double error = scene->texture.weight;
    if (scene->state->mag == RG_FIXED_NEAREST) {
        nearest(scene, to_texels(u, px, 0, 0), to_texels(v, px, 0, 0), layer, level, out);
        return;
    }
    filter(scene, to_texels(u, px, 0.5, error), to_texels(v, px, 0.5, error), layer, level, out);
    for (int c = 0; c < 4; c++)
        out[c] = mixed(scene, out[c], 2);
}

// --- levels ---

static void look_nearest_level(const struct rg_scene *scene, struct rg_span u, struct rg_span v,
                               struct rg_span lod, struct rg_span out[4])
{
    // Between two levels either may be nearest.
    const int first = (int)ceil(lod.low + 0.5) - 1, last = (int)floor(lod.high + 0.5);
    for (int level = first; level <= last; level++) {
        struct rg_span one[4];
        rg_texture_look(scene, u, v, 0, level, one);
        for (int c = 0; c < 4; c++)
            out[c] = level == first ? one[c] : rg_span_join(out[c], one[c]);
    }
}

static void look_between(const struct rg_scene *scene, struct rg_span u, struct rg_span v,
                         double lod, struct rg_span out[4])
{
    const int last = scene->texture.levels - 1, level = (int)fmin(floor(lod), last);
    struct rg_span next[4];
    rg_texture_look(scene, u, v, 0, level, out);
    rg_texture_look(scene, u, v, 0, level < last ? level + 1 : last, next);
    for (int c = 0; c < 4; c++)
        out[c] = mixed(scene,
                       (struct rg_span){mix(out[c].low, next[c].low, lod - level),
                                        mix(out[c].high, next[c].high, lod - level)},
                       1);
}

// Of a level. No specification gives the logarithm's precision; a device may look it up in a table.
#define LOGARITHM (1 / 64.0)

void rg_texture_look_lod(const struct rg_scene *scene, struct rg_span u, struct rg_span v,
                         struct rg_span lod, struct rg_span out[4])
{
    const struct rg_fixed_state *state = scene->state;
    const double error = rg_precision_step(scene->precision->mip_bits);
    lod = rg_span_add(rg_span_widen(lod, LOGARITHM), rg_span_at(state->bias_16 / 16.0));
    if (state->lod_most_16)
        lod = rg_span_clamp(lod, state->lod_least_16 / 16.0, state->lod_most_16 / 16.0);
    lod = rg_span_clamp(rg_span_widen(lod, error), 0, scene->texture.levels - 1);
    if (state->mip == RG_FIXED_MIP_NEAREST) {
        look_nearest_level(scene, u, v, lod, out);
        return;
    }
    double all[64];
    const int count = breaks(lod, all);
    for (int i = 0; i < count; i++) {
        struct rg_span one[4];
        look_between(scene, u, v, all[i], one);
        for (int c = 0; c < 4; c++)
            out[c] = i ? rg_span_join(out[c], one[c]) : one[c];
    }
}

// --- four texels ---

void rg_texture_gather(const struct rg_scene *scene, struct rg_span u, struct rg_span v,
                       int channel, struct rg_span out[4])
{
    static const int order[4][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    const struct rg_span x = to_texels(u, RG_FIXED_TEXTURE_PX, 0.5, 0);
    const struct rg_span y = to_texels(v, RG_FIXED_TEXTURE_PX, 0.5, 0);
    for (int k = 0; k < 4; k++) {
        struct rg_span all = {INFINITY, -INFINITY};
        for (int j = (int)floor(y.low); j <= (int)floor(y.high); j++)
            for (int i = (int)floor(x.low); i <= (int)floor(x.high); i++)
                all = rg_span_join(all,
                                   texel(scene, i + order[k][0], j + order[k][1], 0, 0)[channel]);
        out[k] = all;
    }
}

static struct rg_span passes(int compare, struct rg_span depth, double texel)
{
    const bool is_less = compare == RG_FIXED_LESS;
    const bool surely = is_less ? depth.high < texel : depth.low > texel;
    const bool never = is_less ? depth.low >= texel : depth.high <= texel;
    return (struct rg_span){surely, !never};
}

struct rg_span rg_texture_compare(const struct rg_scene *scene, struct rg_span u, struct rg_span v,
                                  struct rg_span depth)
{
    const struct rg_span x = to_texels(u, RG_FIXED_TEXTURE_PX, 0.5, 0);
    const struct rg_span y = to_texels(v, RG_FIXED_TEXTURE_PX, 0.5, 0);
    struct rg_span all = {INFINITY, -INFINITY};
    for (int j = (int)floor(y.low); j <= (int)floor(y.high) + 1; j++)
        for (int i = (int)floor(x.low); i <= (int)floor(x.high) + 1; i++)
            all = rg_span_join(
                all, passes(scene->state->compare, depth, texel(scene, i, j, 0, 0)[0].low));
    return all;
}
