// Draws of fixed functions: the table alone, or on the device that the command line names.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/outcome.h"
#include "harness/devices/measure/serving/fixed_pairs.h"
#include "tests/tools/expect.h"

static const char *name;

// --- the table ---

static int differing_fields(const struct rg_fixed_state *a, const struct rg_fixed_state *b)
{
    enum { FIELDS = sizeof(*a) / sizeof(int) };
    int of_a[FIELDS], of_b[FIELDS], differing = 0;
    memcpy(of_a, a, sizeof(*a));
    memcpy(of_b, b, sizeof(*b));
    for (int i = 0; i < FIELDS; i++)
        differing += of_a[i] != of_b[i];
    return differing;
}

static void neighbours_differ_in_one_field(void **state)
{
    (void)state;
    assert_at_most(rg_fixed_count(), RG_FIXED_MAX_DRAWS);
    for (int i = 0; i < rg_fixed_count(); i++) {
        const struct rg_fixed_state neighbour = rg_fixed_neighbour(&rg_fixed_draws[i]);
        assert_int_equal(differing_fields(&rg_fixed_draws[i].state, &neighbour), 1);
        for (int j = 0; j < i; j++)
            assert_string_not_equal(rg_fixed_draws[i].feature, rg_fixed_draws[j].feature);
    }
}

// Each stage that a draw names has code of its name.
static void shaders_are_there(void **state)
{
    (void)state;
    for (int i = 0; i < rg_fixed_count(); i++) {
        const struct rg_fixed_state neighbour = rg_fixed_neighbour(&rg_fixed_draws[i]);
        const struct rg_fixed_state *both[] = {&rg_fixed_draws[i].state, &neighbour};
        for (int n = 0; n < 2; n++) {
            assert_non_null(rg_fixed_code_of(both[n], RG_FIXED_STAGE_VERT));
            assert_non_null(rg_fixed_code_of(both[n], RG_FIXED_STAGE_FRAG));
            assert_true(!both[n]->between || rg_fixed_code_of(both[n], RG_FIXED_STAGE_GEOM) ||
                        rg_fixed_code_of(both[n], RG_FIXED_STAGE_TESE));
        }
    }
    for (int i = 0; i < RG_FIXED_FRAGMENT_COUNT; i++)
        assert_non_null(rg_fixed_code_of(&(struct rg_fixed_state){.fragment = i}, //
                                         RG_FIXED_STAGE_FRAG));
}

static void textures_fit_their_room(void **state)
{
    (void)state;
    uint8_t texels[RG_FIXED_LEVEL_BYTES];
    for (int i = 0; i < rg_fixed_count(); i++) {
        const struct rg_fixed_state *s = &rg_fixed_draws[i].state;
        for (int level = 0; s->texels && level < rg_fixed_levels(s); level++)
            assert_at_most(rg_fixed_make_texels(s, 0, level, texels), sizeof(texels));
    }
}

static void closed_cases_are_of_draws(void **state)
{
    (void)state;
    for (int i = 0; i < rg_fixed_closed_count(); i++) {
        const struct rg_fixed_closed *closed = &rg_fixed_closed[i];
        int found = 0;
        for (int d = 0; d < rg_fixed_count(); d++)
            found += !strcmp(closed->feature, rg_fixed_draws[d].feature);
        assert_int_equal(found, 1);
        assert_at_least(differing_fields(&closed->state, &closed->same), 1);
    }
}

static enum rg_outcome judge(int row, uint64_t other, bool is_constant, const char *lacks)
{
    struct rg_fixed_told told = {.digest = 7, .other = other, .is_constant = is_constant};
    char why[RG_FIXED_WHY];
    snprintf(told.lacks, sizeof(told.lacks), "%s", lacks);
    const enum rg_outcome outcome = rg_fixed_judge(row, &told, why);
    assert_int_equal(!*why, outcome == RG_OK);
    return outcome;
}

// A draw must differ from its neighbour, and the two ways of a closed case must not.
static void pairs_are_judged(void **state)
{
    (void)state;
    const int draw = rg_fixed_count() - 1, closed = rg_fixed_count();
    assert_int_equal(judge(draw, 8, false, ""), RG_OK);
    assert_int_equal(judge(draw, 7, false, ""), RG_FAIL);
    assert_int_equal(judge(closed, 7, false, ""), RG_OK);
    assert_int_equal(judge(closed, 8, false, ""), RG_FAIL);
    assert_int_equal(judge(draw, 8, true, ""), RG_FAIL);
    assert_int_equal(judge(closed, 7, true, ""), RG_FAIL);
    assert_int_equal(judge(draw, 7, true, "a feature"), RG_UNSUPPORTED);
}

// A value beyond the bounds fails, unless a known fault of the driver explains it.
static void bounds_are_judged(void **state)
{
    (void)state;
    struct rg_fixed_told told = {.digest = 7, .other = 8, .is_bounded = true};
    char why[RG_FIXED_WHY];
    assert_int_equal(rg_fixed_judge(0, &told, why), RG_OK);
    told.beyond = (struct rg_fixed_beyond){1, "depth", 0, 2, 4, 0, 0.5, 0.25, 0.375};
    assert_int_equal(rg_fixed_judge(0, &told, why), RG_FAIL);
    assert_string_equal(why,
                        "depth at x 2, y 4, layer 0, channel 0 is 0.5, not from 0.25 to 0.375");
    snprintf(told.known, sizeof(told.known), "it is known");
    assert_int_equal(rg_fixed_judge(0, &told, why), RG_OK);
    assert_string_equal(why, "");
}

// --- a device ---

// What a device can draw is no constant, is not its neighbour's, and is the same once more.
static void draws_are_told_from_their_neighbours(void **state)
{
    struct rg_device *device = *state;
    int drawn = 0, bounded = 0;
    for (int i = 0; i < rg_fixed_count(); i++) {
        const char *feature = rg_fixed_draws[i].feature;
        struct rg_fixed_told told = {0}, again = {0};
        if (!rg_fixed_take(device, i, &told) || !rg_fixed_take(device, i, &again))
            fail_msg("%s: is not drawn", feature);
        if (*told.lacks) {
            print_message("%s: %s lacks %s\n", feature, name, told.lacks);
            continue;
        }
        drawn++;
        if (told.is_constant)
            fail_msg("%s: is the same everywhere", feature);
        if (told.digest == told.other)
            fail_msg("%s: its neighbour looks the same", feature);
        char why[RG_FIXED_WHY];
        if (rg_fixed_judge(i, &told, why) != RG_OK)
            fail_msg("%s: %s", feature, why);
        bounded += told.is_bounded && !told.beyond.count;
        if (told.digest != again.digest || told.other != again.other)
            fail_msg("%s: another picture the second time", feature);
    }
    if (device->info.software) {
        assert_at_least(drawn, rg_fixed_count() - 2);
        assert_at_least(bounded, drawn - 3);
    }
}

static void closed_cases_hold(void **state)
{
    struct rg_device *device = *state;
    char why[RG_FIXED_WHY] = "";
    for (int i = rg_fixed_count(); i < rg_fixed_pairs(); i++) {
        const struct rg_fixed_closed *closed = &rg_fixed_closed[i - rg_fixed_count()];
        struct rg_fixed_told told = {0};
        if (!rg_fixed_take(device, i, &told) || rg_fixed_judge(i, &told, why) == RG_FAIL)
            fail_msg("%s, %s: %s", closed->feature, closed->about, why);
    }
}

static int open_device(void **state)
{
    *state = rg_device_open(name);
    return *state ? 0 : -1;
}

static int close_device(void **state)
{
    return rg_device_close(*state) ? 0 : -1;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest of_table[] = {
        cmocka_unit_test(neighbours_differ_in_one_field),
        cmocka_unit_test(shaders_are_there),
        cmocka_unit_test(textures_fit_their_room),
        cmocka_unit_test(closed_cases_are_of_draws),
        cmocka_unit_test(pairs_are_judged),
        cmocka_unit_test(bounds_are_judged),
    };
    const struct CMUnitTest of_device[] = {
        cmocka_unit_test_setup_teardown(draws_are_told_from_their_neighbours, open_device,
                                        close_device),
        cmocka_unit_test_setup_teardown(closed_cases_hold, open_device, close_device),
    };
    const int skipped = 77;
    name = argc > 1 ? argv[1] : NULL;
    setenv("RG_VK_VALIDATION", "1", 1);
    struct rg_device *device = name ? rg_device_open(name) : NULL;
    if (name && !device && rg_failure_take().outcome == RG_UNSUPPORTED)
        return skipped;
    rg_device_close(device);
    return name ? cmocka_run_group_tests(of_device, NULL, NULL)
                : cmocka_run_group_tests(of_table, NULL, NULL);
}
