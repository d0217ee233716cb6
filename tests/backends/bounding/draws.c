// Formats, tests and blending, and the bounds of each draw against pictures that break them by one
// step.
#include <stdio.h>

#include "tests/backends/bounding/rig.h"

// --- formats ---

static void either_neighbour_of_a_value_is_allowed(void **state)
{
    (void)state;
    assert_span(rg_span_scale(rg_round_unorm(rg_span_at(0.5), 8), 255), 127, 128);
    assert_span(rg_span_scale(rg_round_unorm(rg_span_at(17 / 255.0), 8), 255), 17, 17);
    assert_span(rg_round_unorm((struct rg_span){-3, 2}, 8), 0, 1);
    assert_span(rg_span_scale(rg_round_unorm(rg_span_at(0.1), 10), 1023), 102, 103);
    assert_span(rg_span_scale(rg_round_depth(RG_FIXED_D16, rg_span_at(0.3)), 65535), 19660, 19661);
    const struct rg_span third = rg_round_colour(RG_FIXED_RGBA16F, rg_span_at(1 / 3.0));
    assert_equals(third.low, 1365 / 4096.0);
    assert_equals(third.high, 1366 / 4096.0);
    assert_span(rg_round_float(rg_span_at(-0.75), 10, -14), -0.75, -0.75);
    const struct rg_span tiny = rg_round_float(rg_span_at(ldexp(1.5, -24)), 10, -14);
    assert_true(tiny.low == ldexp(1, -24) && tiny.high == ldexp(2, -24));
    const struct rg_span tenth = rg_round_colour(RG_FIXED_RGBA32F, rg_span_at(0.1));
    assert_true((double)(float)tenth.low == tenth.low && (double)(float)tenth.high == tenth.high);
    assert_true(tenth.low < 0.1 && tenth.high > 0.1 && tenth.high - tenth.low < 1e-8);
}

// --- tests and blending ---

static struct rg_sample clear_sample(void)
{
    struct rg_sample sample = {.depth = {0.5, 0.5}, .stencil = {1}};
    for (int c = 0; c < 4; c++)
        sample.colours[0][c] = rg_span_at(51 / 255.0);
    return sample;
}

static enum rg_cover merge(const struct rg_fixed_state *state, double depth, enum rg_cover cover,
                           struct rg_sample *sample)
{
    struct rg_fragment fragment = {.depth = rg_span_at(depth), .stays = RG_COVER_YES};
    for (int c = 0; c < 4; c++)
        fragment.colours[0][c] = fragment.second[c] = rg_span_at(102 / 255.0);
    scene->state = state;
    const enum rg_cover passes = rg_sample_merge(scene, &fragment, 1, cover, sample);
    scene->state = &plain;
    return passes;
}

static void fragments_are_tested(void **state)
{
    (void)state;
    static const struct rg_fixed_state tested = {.depth = RG_FIXED_D32F_S8,
                                                 .depth_test = RG_FIXED_LESS,
                                                 .stencil_front = RG_FIXED_DECREMENT};
    struct rg_sample sample = clear_sample();
    assert_int_equal(merge(&tested, 0.5, RG_COVER_YES, &sample), RG_COVER_NO);
    assert_span(sample.colours[0][0], 0.2, 0.2);
    assert_int_equal(merge(&tested, 0.25, RG_COVER_MAYBE, &sample), RG_COVER_MAYBE);
    assert_span(sample.depth, 0.25, 0.5);
    assert_span(sample.colours[0][0], 0.2, 0.4);
    assert_true(sample.stencil[0] == 1 && sample.stencil[3] == (uint64_t)1 << 63);
    assert_int_equal(merge(&tested, 0.375, RG_COVER_YES, &sample), RG_COVER_MAYBE);
    assert_int_equal(merge(&tested, 0.125, RG_COVER_YES, &sample), RG_COVER_YES);
    assert_span(sample.depth, 0.125, 0.125);
    assert_span(sample.colours[0][3], 0.4, 0.4);
    assert_true(sample.stencil[0] == 0 && sample.stencil[3] == (uint64_t)7 << 61);
}

// 0.4 x 0.4 + 0.2 x 0.6 are 40.8 and 30.6 codes, each of which may be rounded.
static void blending_rounds_as_finely_as_the_target(void **state)
{
    (void)state;
    static const struct rg_fixed_state codes = {.blend = RG_FIXED_BLEND_OVER};
    static const struct rg_fixed_state floats = {.blend = RG_FIXED_BLEND_SRC1_COLOUR,
                                                 .format = RG_FIXED_RGBA32F};
    static const struct rg_fixed_state masked = {.write_off = 5};
    struct rg_sample sample = clear_sample();
    merge(&codes, 0, RG_COVER_YES, &sample);
    assert_span(rg_span_scale(sample.colours[0][1], 255), 70, 72);
    sample = clear_sample();
    merge(&floats, 0, RG_COVER_YES, &sample);
    assert_span(sample.colours[0][1], 0.28, 0.28);
    sample = clear_sample();
    merge(&masked, 0, RG_COVER_YES, &sample);
    assert_span(sample.colours[0][0], 0.2, 0.2);
    assert_span(sample.colours[0][1], 0.4, 0.4);
}

// --- all draws ---

static void every_draw_has_its_sections_or_none(void **state)
{
    (void)state;
    int none = 0;
    for (int i = 0; i < rg_fixed_count(); i++)
        none += !rg_fixed_sections(rg_fixed_draws[i].feature);
    assert_int_equal(none, 2);
    assert_null(rg_fixed_sections("anisotropic"));
    assert_non_null(rg_fixed_sections("linear"));
}

static void faults_are_known_of_one_driver_up_to_a_number(void **state)
{
    (void)state;
    const char *draw = "centroid interpolation", *mesa = "llvmpipe (LLVM 15.0.6, 256 bits)";
    const struct rg_fixed_beyond few = {6, "colour 0", 0, 0, 0, 0, 0, 0, 0};
    const struct rg_fixed_beyond more = {7, "colour 0", 0, 0, 0, 0, 0, 0, 0};
    const struct rg_fixed_beyond none = {0, "colour 0", 0, 0, 0, 0, 0, 0, 0};
    const struct rg_fixed_beyond size = {1, "bytes", 0, 0, 0, 0, 0, 0, 0};
    assert_non_null(rg_fixed_known_fault(draw, mesa, &few));
    assert_null(rg_fixed_known_fault(draw, mesa, &more));
    assert_null(rg_fixed_known_fault(draw, mesa, &none));
    assert_null(rg_fixed_known_fault(draw, mesa, &size));
    assert_null(rg_fixed_known_fault(draw, "another", &few));
    assert_null(rg_fixed_known_fault("linear", mesa, &few));
}

// Bits of a non-negative value in a small float.
static uint32_t pack(double value, int mantissa_bits)
{
    int exponent;
    const double fraction = frexp(value, &exponent); // 0.5 to 1
    if (value == 0 || exponent - 1 < -14)
        return (uint32_t)ldexp(value, 14 + mantissa_bits);
    return (uint32_t)(exponent + 14) << mantissa_bits |
           (uint32_t)(ldexp(fraction, mantissa_bits + 1) - ldexp(1, mantissa_bits));
}

static size_t put(const struct rg_fixed_bounds_part *part, int i, double value, uint8_t *at)
{
    const int c = i % part->channels;
    const float real = (float)value;
    uint16_t word = (uint16_t)(part->numbers == RG_FIXED_HALVES
                                   ? pack(fabs(value), 10) | (value < 0 ? 0x8000 : 0)
                                   : value);
    uint32_t two = 0;
    const uint64_t four = part->numbers == RG_FIXED_COUNTS_64 ? (uint64_t)value : 0;
    switch (part->numbers) {
    case RG_FIXED_CODES_8:
        at[i] = (uint8_t)value;
        return (size_t)i + 1;
    case RG_FIXED_CODES_16:
    case RG_FIXED_HALVES:
        memcpy(at + (ptrdiff_t)2 * i, &word, 2);
        return 2 * ((size_t)i + 1);
    case RG_FIXED_FLOATS:
        memcpy(at + (ptrdiff_t)4 * i, &real, 4);
        return 4 * ((size_t)i + 1);
    case RG_FIXED_COUNTS_32:
        two = (uint32_t)value;
        memcpy(at + (ptrdiff_t)4 * i, &two, 4);
        return 4 * ((size_t)i + 1);
    case RG_FIXED_COUNTS_64:
        memcpy(at + (ptrdiff_t)8 * i, &four, 8);
        return 8 * ((size_t)i + 1);
    default:
        break;
    }
    uint8_t *texel = at + (ptrdiff_t)4 * (i / part->channels);
    const bool is_tens = part->numbers == RG_FIXED_TENS;
    const int shift = (is_tens ? 10 : 11) * c, bits = is_tens ? (c < 3 ? 10 : 2) : c < 2 ? 11 : 10;
    const uint32_t mask = ((1u << bits) - 1) << shift;
    memcpy(&two, texel, 4);
    two = (two & ~mask) | (is_tens ? (uint32_t)value : pack(value, c < 2 ? 6 : 5)) << shift;
    memcpy(texel, &two, 4);
    return 4 * ((size_t)(i / part->channels) + 1);
}

static int values_of(const struct rg_fixed_bounds_part *part)
{
    return part->layers * part->width * part->height * part->channels;
}

// A value one step beyond an interval.
static double beyond(const struct rg_fixed_bounds_part *part, int i)
{
    const struct rg_span a = part->values[i];
    const bool is_real = part->numbers == RG_FIXED_HALVES || part->numbers == RG_FIXED_FLOATS ||
                         part->numbers == RG_FIXED_ELEVENS;
    const int mantissa = part->numbers == RG_FIXED_FLOATS   ? 23
                         : part->numbers == RG_FIXED_HALVES ? 10
                         : i % part->channels < 2           ? 6
                                                            : 5;
    int exponent;
    frexp(a.high, &exponent);
    if (is_real)
        return a.high + ldexp(1, (exponent < -13 ? -13 : exponent) - 1 - mantissa + (a.high < 0));
    return a.low > 0 ? a.low - 1 : a.high + 1;
}

// A picture of the least values is within; with any part's value a step beyond, it is not.
static void each_draw_notices_one_step_beyond(void **state)
{
    (void)state;
    static uint8_t bytes[RG_FIXED_PICTURE_BYTES];
    int bounded = 0;
    for (int d = 0; d < rg_fixed_count(); d++) {
        if (!rg_fixed_sections(rg_fixed_draws[d].feature))
            continue;
        struct rg_fixed_bounds *bounds = rg_fixed_bounds_make(&rg_fixed_draws[d].state, &fine);
        struct rg_fixed_beyond told;
        size_t size = 0, starts[RG_FIXED_BOUNDS_PARTS];
        assert_non_null(bounds);
        memset(bytes, 0, sizeof(bytes));
        for (int p = 0; p < bounds->count; p++) {
            const struct rg_fixed_bounds_part *part = &bounds->parts[p];
            size_t used = 0;
            starts[p] = size;
            for (int i = 0; i < values_of(part); i++)
                used = put(part, i, part->values[i].low, bytes + size);
            size += used;
        }
        if (!rg_fixed_bounds_hold(bounds, bytes, size, &told)) {
            char text[RG_FIXED_BEYOND_TEXT];
            rg_fixed_beyond_tell(&told, text);
            fail_msg("%s: %s", rg_fixed_draws[d].feature, text);
        }
        assert_false(rg_fixed_bounds_hold(bounds, bytes, size - 1, &told));
        for (int p = 0; p < bounds->count; p++) {
            const struct rg_fixed_bounds_part *part = &bounds->parts[p];
            int i = values_of(part) * 5 / 9;
            while (i + 1 < values_of(part) && part->numbers == RG_FIXED_CODES_8 &&
                   part->values[i].low == 0 && part->values[i].high == 255)
                i++;
            put(part, i, beyond(part, i), bytes + starts[p]);
            assert_false(rg_fixed_bounds_hold(bounds, bytes, size, &told));
            const int pixel = i / part->channels;
            assert_int_equal(told.count, 1);
            assert_string_equal(told.part, part->name);
            assert_int_equal(told.channel, i % part->channels);
            assert_int_equal((told.layer * part->height + told.y) * part->width + told.x, pixel);
            put(part, i, part->values[i].low, bytes + starts[p]);
        }
        rg_fixed_bounds_free(bounds);
        bounded++;
    }
    assert_int_equal(bounded, rg_fixed_count() - 2);
}

// Of a draw's first part, at least so many percent of the intervals are at most this wide.
static void bounds_are_narrow(void **state)
{
    (void)state;
    static const struct {
        const char *feature;
        double width;
        int percent;
    } rows[] = {{"nearest", 0, 70},
                {"linear", 5, 75},
                {"LOD bias and clamp", 6, 35},
                {"gather", 1, 98},
                {"BC1", 3, 75},
                {"BC1", 18, 98},
                {"ETC2", 0, 70},
                {"provoking vertex", 1, 98},
                {"cube seams", 5, 70},
                {"clipping", 1, 98},
                {"culling", 1, 95},
                {"points", 1, 95},
                {"scissor", 1, 98},
                {"vertex formats", 0.001, 98},
                {"depth test", 1, 94},
                {"blending RGBA16F", 0.01, 95},
                {"write mask", 1, 98},
                {"multisampling", 8, 70},
                {"blit", 3, 95},
                {"derivatives", 0.1, 90}};
    for (size_t r = 0; r < sizeof(rows) / sizeof(rows[0]); r++) {
        int d = 0, narrow = 0;
        while (strcmp(rg_fixed_draws[d].feature, rows[r].feature) != 0)
            d++;
        struct rg_fixed_bounds *bounds = rg_fixed_bounds_make(&rg_fixed_draws[d].state, &fine);
        assert_non_null(bounds);
        const struct rg_fixed_bounds_part *part = &bounds->parts[0];
        for (int i = 0; i < values_of(part); i++)
            narrow += part->values[i].high - part->values[i].low <= rows[r].width;
        if (narrow * 100 < rows[r].percent * values_of(part))
            fail_msg("%s: %d of %d are narrow", rows[r].feature, narrow, values_of(part));
        rg_fixed_bounds_free(bounds);
    }
}

static void what_is_beyond_is_told_in_one_line(void **state)
{
    (void)state;
    struct rg_fixed_beyond told = {3, "colour 0", 1, 2, 4, 3, 17, 20, 24};
    char text[RG_FIXED_BEYOND_TEXT];
    rg_fixed_beyond_tell(&told, text);
    assert_string_equal(
        text, "colour 0 at x 2, y 4, layer 1, channel 3 is 17, not from 20 to 24, and 2 more");
    told.count = 1;
    rg_fixed_beyond_tell(&told, text);
    assert_string_equal(text, "colour 0 at x 2, y 4, layer 1, channel 3 is 17, not from 20 to 24");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(either_neighbour_of_a_value_is_allowed),
        cmocka_unit_test(fragments_are_tested),
        cmocka_unit_test(blending_rounds_as_finely_as_the_target),
        cmocka_unit_test(every_draw_has_its_sections_or_none),
        cmocka_unit_test(faults_are_known_of_one_driver_up_to_a_number),
        cmocka_unit_test(each_draw_notices_one_step_beyond),
        cmocka_unit_test(bounds_are_narrow),
        cmocka_unit_test(what_is_beyond_is_told_in_one_line),
    };
    return cmocka_run_group_tests_name("bounds of draws", tests, begin, end);
}
