// Tests and blending: how a fragment changes a sample of the target.
//
// A fragment that may or may not arrive leaves every value from the old one to the new one.
#include <string.h>

#include "shaders/fixed/bounds/scene.h"

static enum rg_cover least_of(enum rg_cover a, enum rg_cover b)
{
    return a < b ? a : b;
}

// --- depth (OpenGL, Depth Buffer Test; Vulkan, Depth Test) ---

static enum rg_cover compare(int mode, struct rg_span a, struct rg_span b)
{
    const bool less = a.high < b.low, not_less = a.low >= b.high;
    const bool more = a.low > b.high, not_more = a.high <= b.low;
    const bool equal = a.low == a.high && b.low == b.high && a.low == b.low;
    switch (mode) {
    case RG_FIXED_LESS:
        return less ? RG_COVER_YES : not_less ? RG_COVER_NO : RG_COVER_MAYBE;
    case RG_FIXED_LESS_EQUAL:
        return not_more ? RG_COVER_YES : more ? RG_COVER_NO : RG_COVER_MAYBE;
    case RG_FIXED_GREATER:
        return more ? RG_COVER_YES : not_more ? RG_COVER_NO : RG_COVER_MAYBE;
    case RG_FIXED_NOT_EQUAL:
        return less || more ? RG_COVER_YES : equal ? RG_COVER_NO : RG_COVER_MAYBE;
    default:
        return RG_COVER_YES;
    }
}

static enum rg_cover test_depth(const struct rg_scene *scene, const struct rg_fragment *fragment,
                                enum rg_cover cover, struct rg_sample *sample)
{
    const struct rg_fixed_state *state = scene->state;
    if (!state->depth_test)
        return cover;
    const struct rg_span depth = rg_round_depth(state->depth, fragment->depth);
    const enum rg_cover passes = least_of(cover, compare(state->depth_test, depth, sample->depth));
    if (passes == RG_COVER_YES)
        sample->depth = depth;
    else if (passes == RG_COVER_MAYBE)
        sample->depth = rg_span_join(sample->depth, depth);
    return passes;
}

// --- stencil (OpenGL, Stencil Test; Vulkan, Stencil Test) ---

static void operate(int operation, const uint64_t in[4], uint64_t out[4])
{
    for (int word = 0; word < 4; word++)
        for (uint64_t rest = in[word]; rest; rest &= rest - 1) {
            const int value = 64 * word + __builtin_ctzll(rest);
            const int next = operation == RG_FIXED_INCREMENT   ? (value + 1) & 255
                             : operation == RG_FIXED_DECREMENT ? (value + 255) & 255
                             : operation == RG_FIXED_INVERT    ? 255 - value
                                                               : value;
            out[next / 64] |= (uint64_t)1 << next % 64;
        }
}

static void change_stencil(const struct rg_scene *scene, int facing, enum rg_cover passes,
                           struct rg_sample *sample)
{
    uint64_t next[4] = {0};
    if (passes != RG_COVER_YES)
        memcpy(next, sample->stencil, sizeof(next));
    if (passes != RG_COVER_NO && facing >= 0)
        operate(scene->state->stencil_front, sample->stencil, next);
    if (passes != RG_COVER_NO && facing <= 0)
        operate(scene->state->stencil_back, sample->stencil, next);
    memcpy(sample->stencil, next, sizeof(next));
}

// --- blending (OpenGL, Blending; Vulkan, Blend Operations) ---
//
// Precision is no lower than the target's: source, factors and products may each be rounded to it.

static struct rg_span rounded(int format, struct rg_span a)
{
    return rg_round_colour(format, a);
}

static struct rg_span equate(int equation, struct rg_span source, struct rg_span source_part,
                             struct rg_span target, struct rg_span target_part)
{
    switch (equation) {
    case 1:
        return rg_span_less(source_part, target_part);
    case 2:
        return rg_span_less(target_part, source_part);
    case 3:
        return rg_span_least(source, target);
    case 4:
        return rg_span_most(source, target);
    default:
        return rg_span_add(source_part, target_part);
    }
}

struct factors {
    struct rg_span source, target;
};

static struct factors factors_of(const struct rg_scene *scene, const struct rg_fragment *f,
                                 int target, int c)
{
    const struct rg_fixed_state *state = scene->state;
    const struct rg_span factor =
        rounded(state->format, state->blend == RG_FIXED_BLEND_SRC1_COLOUR  ? f->second[c]
                               : state->blend == RG_FIXED_BLEND_SRC1_ALPHA ? f->second[3]
                                                                           : f->colours[target][3]);
    return (struct factors){factor, rounded(state->format, rg_span_less(rg_span_at(1), factor))};
}

static struct rg_span blend(const struct rg_scene *scene, const struct factors *factors, int target,
                            struct rg_span source, struct rg_span old)
{
    const struct rg_fixed_state *state = scene->state;
    const struct rg_span source_part =
        rounded(state->format, rg_span_times(source, factors->source));
    const struct rg_span target_part = rounded(state->format, rg_span_times(old, factors->target));
    const int equation = state->blend == RG_FIXED_BLEND_EQUATIONS ? target : 0;
    return rounded(state->format, equate(equation, source, source_part, old, target_part));
}

static void write_target(const struct rg_scene *scene, const struct rg_fragment *fragment, int i,
                         enum rg_cover passes, struct rg_span colours[4])
{
    const struct rg_fixed_state *state = scene->state;
    struct factors factors = {0};
    if (state->blend)
        factors = factors_of(scene, fragment, i, 0);
    for (int c = 0; c < 4; c++) {
        struct rg_span *old = &colours[c], now = rounded(state->format, fragment->colours[i][c]);
        if (state->write_off >> c & 1)
            continue;
        if (state->blend == RG_FIXED_BLEND_SRC1_COLOUR) // others are the same for all channels
            factors = factors_of(scene, fragment, i, c);
        if (state->blend)
            now = blend(scene, &factors, i, now, *old);
        *old = passes == RG_COVER_YES ? now : rg_span_join(*old, now);
    }
}

static void write(const struct rg_scene *scene, const struct rg_fragment *fragment,
                  enum rg_cover passes, struct rg_sample *sample)
{
    for (int i = 0; i <= scene->state->more_targets; i++)
        write_target(scene, fragment, i, passes, sample->colours[i]);
}

enum rg_cover rg_sample_merge(const struct rg_scene *scene, const struct rg_fragment *fragment,
                              int facing, enum rg_cover cover, struct rg_sample *sample)
{
    const bool early = scene->state->fragment == RG_FIXED_FRAGMENT_EARLY;
    const enum rg_cover arrives = early ? cover : least_of(cover, fragment->stays);
    const enum rg_cover passes = test_depth(scene, fragment, arrives, sample);
    const enum rg_cover writes = least_of(passes, fragment->stays);
    if (scene->state->stencil_front || scene->state->stencil_back)
        change_stencil(scene, facing, passes, sample);
    if (writes != RG_COVER_NO)
        write(scene, fragment, writes, sample);
    return passes;
}
