#include "shaders/fixed/bounds/bounds.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "shaders/fixed/bounds/scene.h"

enum { PX = RG_FIXED_PX };

// Vulkan's least limits (Required Limits), and its standard places of four samples.
const struct rg_fixed_precision rg_fixed_precision_least = {
    .subpixel_bits = 4,
    .subtexel_bits = 4,
    .mip_bits = 4,
    .has_places = true,
    .places = {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}},
};

// --- parts ---

static int size_of(const struct rg_fixed_bounds_part *part)
{
    return part->layers * part->width * part->height * part->channels;
}

// NULL, and one logged line, without memory.
static struct rg_span *add(struct rg_fixed_bounds *bounds, struct rg_fixed_bounds_part part)
{
    struct rg_fixed_bounds_part *added = &bounds->parts[bounds->count++];
    *added = part;
    added->values = rg_alloc((size_t)size_of(added), sizeof(*added->values), "bounds");
    return added->values;
}

static double codes_of(enum rg_fixed_numbers numbers)
{
    return numbers == RG_FIXED_CODES_8 ? 255 : numbers == RG_FIXED_CODES_16 ? 65535 : 1;
}

static struct rg_span in_codes(struct rg_span a, double codes)
{
    return codes == 1 ? a : (struct rg_span){rint(a.low * codes), rint(a.high * codes)};
}

static enum rg_fixed_numbers numbers_of(int format)
{
    return format == RG_FIXED_RGBA8     ? RG_FIXED_CODES_8
           : format == RG_FIXED_RGBA16F ? RG_FIXED_HALVES
                                        : RG_FIXED_FLOATS;
}

// The mean of a pixel's samples.
static struct rg_span resolve(const struct rg_scene *scene, int layer, int x, int y, int target,
                              int c)
{
    struct rg_span sum = rg_span_at(0);
    for (int i = 0; i < scene->sample_count; i++)
        sum = rg_span_add(sum, rg_scene_sample(scene, layer, x, y, i)->colours[target][c]);
    return scene->sample_count == 1
               ? sum
               : rg_round_colour(scene->state->format,
                                 rg_span_scale(sum, 1.0 / scene->sample_count));
}

static bool add_colour(const struct rg_scene *scene, int target, struct rg_fixed_bounds *bounds)
{
    static const char *const names[RG_FIXED_EQUATIONS] = {"colour 0", "colour 1", "colour 2",
                                                          "colour 3", "colour 4"};
    const enum rg_fixed_numbers numbers = numbers_of(scene->state->format);
    struct rg_span *values =
        add(bounds, (struct rg_fixed_bounds_part){names[target], numbers, PX, PX,
                                                  scene->layer_count, 4, NULL});
    for (int i = 0; values && i < scene->layer_count * PX * PX * 4; i++)
        values[i] =
            in_codes(resolve(scene, i / 4 / PX / PX, i / 4 % PX, i / 4 / PX % PX, target, i % 4),
                     codes_of(numbers));
    return values;
}

// Scaled down, a pixel's centre lies between four of the target's (OpenGL, Blitting Pixel
// Rectangles; Vulkan, Image Copies With Scaling).
static bool add_blit(const struct rg_scene *scene, struct rg_fixed_bounds *bounds)
{
    enum { SMALL = RG_FIXED_BLIT_PX };
    const enum rg_fixed_numbers numbers = numbers_of(scene->state->format);
    const bool is_linear = scene->state->blit == 1 + RG_FIXED_LINEAR;
    const double error =
        is_linear ? rg_precision_step(scene->precision->subtexel_bits) : ldexp(1, -20);
    struct rg_span *from = rg_alloc(PX * PX * 4, sizeof(*from), "bounds");
    struct rg_span *values =
        from ? add(bounds, (struct rg_fixed_bounds_part){"blit", numbers, SMALL, SMALL, 1, 4, NULL})
             : NULL;
    for (int i = 0; values && i < PX * PX * 4; i++)
        from[i] = resolve(scene, 0, i / 4 % PX, i / 4 / PX, 0, i % 4);
    for (int i = 0; values && i < SMALL * SMALL * 4; i++) {
        const int c = i % 4, pixel = i / 4;
        struct rg_span place[2];
        for (int k = 0; k < 2; k++) {
            const double at = ((k ? pixel / SMALL : pixel % SMALL) + 0.5) * PX / SMALL - 0.5;
            place[k] = rg_span_widen(rg_span_at(is_linear ? at : floor(at + 0.5)), error);
        }
        const struct rg_span value = rg_grid_filter(from + c, 4, PX, place[0], place[1]);
        values[i] = in_codes(rg_round_colour(scene->state->format, value), codes_of(numbers));
    }
    free(from);
    return values;
}

static bool add_depth(const struct rg_scene *scene, struct rg_fixed_bounds *bounds)
{
    const bool is_short = scene->state->depth == RG_FIXED_D16;
    const enum rg_fixed_numbers numbers = is_short ? RG_FIXED_CODES_16 : RG_FIXED_FLOATS;
    struct rg_span *values =
        add(bounds, (struct rg_fixed_bounds_part){"depth", numbers, PX, PX, 1, 1, NULL});
    for (int i = 0; values && i < PX * PX; i++)
        values[i] = in_codes(scene->samples[i].depth, codes_of(numbers));
    return values;
}

static struct rg_span stencil_of(const uint64_t values[4])
{
    struct rg_span all = {INFINITY, -INFINITY};
    for (int word = 0; word < 4; word++)
        for (uint64_t rest = values[word]; rest; rest &= rest - 1)
            all = rg_span_reach(all, 64 * word + __builtin_ctzll(rest));
    return all;
}

static bool add_stencil(const struct rg_scene *scene, struct rg_fixed_bounds *bounds)
{
    struct rg_span *values =
        add(bounds, (struct rg_fixed_bounds_part){"stencil", RG_FIXED_CODES_8, PX, PX, 1, 1, NULL});
    for (int i = 0; values && i < PX * PX; i++)
        values[i] = stencil_of(scene->samples[i].stencil);
    return values;
}

// A store's value in its format.
static struct rg_span stored(int store, int c, struct rg_span a)
{
    const double tens = c < 3 ? 1023 : 3;
    switch (store) {
    case 0:
        return in_codes(rg_round_unorm(a, 8), 255);
    case 1:
        return rg_round_float(a, 10, -14);
    case 2:
        return in_codes(rg_round_unorm(a, c < 3 ? 10 : 2), tens);
    default:
        return rg_round_small_float(rg_span_clamp(a, 0, INFINITY), c < 2 ? 6 : 5);
    }
}

static bool add_stores(const struct rg_scene *scene, struct rg_fixed_bounds *bounds)
{
    static const char *const names[RG_FIXED_STORES] = {"store 0", "store 1", "store 2", "store 3"};
    static const enum rg_fixed_numbers numbers[RG_FIXED_STORES] = {
        RG_FIXED_CODES_8, RG_FIXED_HALVES, RG_FIXED_TENS, RG_FIXED_ELEVENS};
    for (int k = 0; k < RG_FIXED_STORES; k++) {
        const int channels = numbers[k] == RG_FIXED_ELEVENS ? 3 : 4;
        struct rg_span *values = add(
            bounds, (struct rg_fixed_bounds_part){names[k], numbers[k], PX, PX, 1, channels, NULL});
        for (int i = 0; values && i < PX * PX * channels; i++)
            values[i] = stored(k, i % channels, scene->stores[i / channels][k][i % channels]);
        if (!values)
            return false;
    }
    return true;
}

static bool add_counts(const struct rg_scene *scene, struct rg_fixed_bounds *bounds)
{
    struct rg_span *values =
        add(bounds, (struct rg_fixed_bounds_part){"counts", RG_FIXED_COUNTS_32, RG_FIXED_COUNTS, 1,
                                                  1, 1, NULL});
    if (values)
        memcpy(values, scene->counts, sizeof(scene->counts));
    return values;
}

static bool add_caught(const struct rg_scene *scene, struct rg_fixed_bounds *bounds)
{
    struct rg_span *values =
        add(bounds, (struct rg_fixed_bounds_part){"caught", RG_FIXED_FLOATS, 1,
                                                  3 * RG_FIXED_MAX_VERTICES, 1, 8, NULL});
    if (values)
        memcpy(values, scene->caught, sizeof(scene->caught));
    return values;
}

// Samples that passed; vertices, primitives, primitives before and after clipping (OpenGL,
// Pipeline Statistics Queries; Vulkan, Pipeline Statistics Queries): one with a corner inside the
// clip volume leaves one or more.
static bool add_queries(const struct rg_scene *scene, struct rg_fixed_bounds *bounds)
{
    struct rg_span *values =
        add(bounds, (struct rg_fixed_bounds_part){"queries", RG_FIXED_COUNTS_64,
                                                  1 + RG_FIXED_STATISTICS, 1, 1, 1, NULL});
    if (!values)
        return false;
    values[0] = scene->visible;
    values[1] = rg_span_at(scene->vertices.count);
    values[2] = values[3] = rg_span_at(scene->primitive_count);
    values[4] = (struct rg_span){scene->inside_count, INFINITY};
    return true;
}

// --- all parts, in a picture's order ---

static bool add_all(const struct rg_scene *scene, struct rg_fixed_bounds *bounds)
{
    const struct rg_fixed_state *state = scene->state;
    bool ok = true;
    if (state->blit)
        ok = add_blit(scene, bounds);
    for (int i = 0; ok && !state->blit && i <= state->more_targets; i++)
        ok = add_colour(scene, i, bounds);
    return ok && (!state->depth || add_depth(scene, bounds)) &&
           (state->depth != RG_FIXED_D32F_S8 || add_stencil(scene, bounds)) &&
           (!state->stores || add_stores(scene, bounds)) &&
           (!state->counts || add_counts(scene, bounds)) &&
           (!state->feedback || add_caught(scene, bounds)) &&
           (!state->queries || add_queries(scene, bounds));
}

struct rg_fixed_bounds *rg_fixed_bounds_make(const struct rg_fixed_state *state,
                                             const struct rg_fixed_precision *precision)
{
    struct rg_scene *scene = rg_scene_draw(state, precision);
    struct rg_fixed_bounds *bounds = scene ? rg_alloc(1, sizeof(*bounds), "bounds") : NULL;
    const bool ok = bounds && add_all(scene, bounds);
    rg_scene_free(scene);
    if (ok)
        return bounds;
    rg_fixed_bounds_free(bounds);
    return NULL;
}

void rg_fixed_bounds_free(struct rg_fixed_bounds *bounds)
{
    for (int i = 0; bounds && i < bounds->count; i++)
        free(bounds->parts[i].values);
    free(bounds);
}

// --- a picture's values ---

static double small_float(uint32_t bits, int mantissa_bits)
{
    const int exponent = (int)(bits >> mantissa_bits & 31);
    const double mantissa = bits & ((1u << mantissa_bits) - 1);
    if (exponent == 31)
        return mantissa != 0 ? NAN : INFINITY;
    return exponent ? ldexp(ldexp(1, mantissa_bits) + mantissa, exponent - 15 - mantissa_bits)
                    : ldexp(mantissa, -14 - mantissa_bits);
}

static size_t bytes_of(const struct rg_fixed_bounds_part *part)
{
    static const size_t sizes[] = {
        [RG_FIXED_CODES_8] = 1, [RG_FIXED_CODES_16] = 2,  [RG_FIXED_HALVES] = 2,
        [RG_FIXED_FLOATS] = 4,  [RG_FIXED_COUNTS_32] = 4, [RG_FIXED_COUNTS_64] = 8};
    const size_t values = (size_t)size_of(part), texels = values / (size_t)part->channels;
    const bool is_packed = part->numbers == RG_FIXED_TENS || part->numbers == RG_FIXED_ELEVENS;
    return is_packed ? texels * 4 : values * sizes[part->numbers];
}

static double packed(enum rg_fixed_numbers numbers, uint32_t word, int c)
{
    if (numbers == RG_FIXED_TENS)
        return c < 3 ? word >> 10 * c & 1023 : word >> 30;
    return c < 2 ? small_float(word >> 11 * c & 2047, 6) : small_float(word >> 22, 5);
}

static double value_of(const struct rg_fixed_bounds_part *part, const uint8_t *bytes, int i)
{
    const size_t at = (size_t)i;
    uint16_t word;
    uint32_t two;
    uint64_t four;
    float real;
    switch (part->numbers) {
    case RG_FIXED_CODES_8:
        return bytes[at];
    case RG_FIXED_CODES_16:
        memcpy(&word, bytes + 2 * at, sizeof(word));
        return word;
    case RG_FIXED_HALVES:
        memcpy(&word, bytes + 2 * at, sizeof(word));
        return word & 0x8000 ? -small_float(word & 0x7fff, 10) : small_float(word, 10);
    case RG_FIXED_FLOATS:
        memcpy(&real, bytes + 4 * at, sizeof(real));
        return real;
    case RG_FIXED_COUNTS_32:
        memcpy(&two, bytes + 4 * at, sizeof(two));
        return two;
    case RG_FIXED_COUNTS_64:
        memcpy(&four, bytes + 8 * at, sizeof(four));
        return (double)four;
    default:
        memcpy(&two, bytes + at / (size_t)part->channels * 4, sizeof(two));
        return packed(part->numbers, two, i % part->channels);
    }
}

static double told(double value)
{
    return fmin(fmax(value, -RG_FIXED_BEYOND_MOST), RG_FIXED_BEYOND_MOST);
}

static void note(const struct rg_fixed_bounds_part *part, int i, double value,
                 struct rg_fixed_beyond *beyond)
{
    const int pixel = i / part->channels;
    if (beyond->count++)
        return;
    snprintf(beyond->part, sizeof(beyond->part), "%s", part->name);
    beyond->channel = i % part->channels;
    beyond->x = pixel % part->width;
    beyond->y = pixel / part->width % part->height;
    beyond->layer = pixel / part->width / part->height;
    beyond->value = isnan(value) ? RG_FIXED_BEYOND_MOST : told(value);
    beyond->low = told(part->values[i].low);
    beyond->high = told(part->values[i].high);
}

bool rg_fixed_bounds_hold(const struct rg_fixed_bounds *bounds, const void *bytes, size_t size,
                          struct rg_fixed_beyond *beyond)
{
    size_t used = 0;
    *beyond = (struct rg_fixed_beyond){.part = "bytes"};
    for (int p = 0; p < bounds->count; p++)
        used += bytes_of(&bounds->parts[p]);
    if (used != size) {
        beyond->count = 1;
        beyond->value = (double)size;
        beyond->low = beyond->high = (double)used;
        return false;
    }
    used = 0;
    for (int p = 0; p < bounds->count; p++) {
        const struct rg_fixed_bounds_part *part = &bounds->parts[p];
        for (int i = 0; i < size_of(part); i++) {
            const double value = value_of(part, (const uint8_t *)bytes + used, i);
            if (!(value >= part->values[i].low && value <= part->values[i].high))
                note(part, i, value, beyond);
        }
        used += bytes_of(part);
    }
    return !beyond->count;
}

void rg_fixed_beyond_tell(const struct rg_fixed_beyond *beyond, char text[RG_FIXED_BEYOND_TEXT])
{
    const int used =
        snprintf(text, RG_FIXED_BEYOND_TEXT,
                 "%s at x %d, y %d, layer %d, channel %d is %.9g, not from %.9g to %.9g",
                 beyond->part, beyond->x, beyond->y, beyond->layer, beyond->channel, beyond->value,
                 beyond->low, beyond->high);
    if (beyond->count > 1)
        snprintf(text + used, RG_FIXED_BEYOND_TEXT - (size_t)used, ", and %d more",
                 beyond->count - 1);
}
