// Differences are reported: in a state, a law, a stage, an image without rain, cpu:reference
// itself, and in every run.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/verify/snapshot.h"
#include "harness/console/exit.h"
#include "tests/harness/verifying/rig.h"

static bool is_on(const struct rg_instance *instance, const char *device)
{
    return !strcmp(instance->device->info.name, device);
}

// Changes the last word of the last buffer of the state.
static bool change_last_word(struct rg_instance *instance)
{
    struct rg_buf *buf = instance->state[instance->state_count - 1].asset->buf;
    uint32_t word;
    return rg_buf_read(buf, (int64_t)buf->size - 4, &word, 4) &&
           (word++, rg_buf_write(buf, (int64_t)buf->size - 4, &word, 4));
}

static bool step_off_on_cpu(struct rg_instance *instance)
{
    return rg_technique_find("flow")->step(instance) &&
           (!is_on(instance, "cpu") || instance->frame < 2 || change_last_word(instance));
}

static void assert_says(const struct rg_checks *checks, const char *check, const char *device,
                        const char *says)
{
    const char *detail = rig_check(checks, check, device)->detail;
    if (!strstr(detail, says))
        fail_msg("'%s' does not say '%s'", detail, says);
}

// One word of the state is enough on a device that owes T0; other devices are judged by the image
// alone.
static void a_state_that_differs_fails(void **state)
{
    (void)state;
    struct rg_checks checks;
    rig_flow.step = step_off_on_cpu;
    rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "state", "cpu"), RG_FAIL);
    assert_says(&checks, "state", "cpu", "3 of 3 runs; seed 1: ");
    assert_says(&checks, "state", "cpu", "after step 2");
    assert_int_equal(rg_checks_exit(&checks), RG_EXIT_FAIL);
    rg_checks_free(&checks);
    rig_verify(RIG_CHEAP " drops=40", RG_T1, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "state", "cpu"), RG_OK);
    assert_says(&checks, "state", "cpu",
                "3 of 3 runs of 2 steps are not identical to cpu:reference, which T1 leaves to the "
                "image");
    rg_checks_free(&checks);
}

// The first differing element is named by its buffer's layout, without the margin.
static void an_element_is_named(void **state)
{
    (void)state;
    uint32_t found[16] = {0}, due[16] = {0};
    struct rg_snapshot a = {.state_count = 1, .state = {found}, .state_bytes = {sizeof(found)}};
    struct rg_snapshot b = {.state_count = 1, .state = {due}, .state_bytes = {sizeof(due)}};
    char text[256];
    found[6] = 7;
    found[15] = 8;
    a.layout[0] = (struct rg_state){.name = "water", .row = 4, .margin = 1};
    rg_snapshot_describe(&a, &b, text, sizeof(text));
    assert_string_equal(
        text, "water (1, 0) is 7 (0x00000007), not 0 (0x00000000), off by 7; 2 of 16 words differ");
    a.layout[0] = (struct rg_state){.name = "water"};
    rg_snapshot_describe(&a, &b, text, sizeof(text));
    assert_string_equal(
        text, "water[6] is 7 (0x00000007), not 0 (0x00000000), off by 7; 2 of 16 words differ");
    assert_false(rg_snapshot_same_state(&a, &b));
    found[6] = found[15] = 0;
    assert_true(rg_snapshot_same_state(&a, &b));
    rg_snapshot_describe(&a, &b, text, sizeof(text));
    assert_string_equal(text, "");
    // Of several buffers the first that differs is named, by its own layout.
    a.state_count = 2;
    assert_false(rg_snapshot_same_state(&a, &b));
    uint32_t more[4] = {0, 0, 5, 0};
    a.state[1] = more;
    b.state[1] = due;
    a.state_bytes[1] = b.state_bytes[1] = sizeof(more);
    a.layout[0] = (struct rg_state){.name = "water", .row = 4, .margin = 1};
    a.layout[1] = (struct rg_state){.name = "snow"};
    b.state_count = 2;
    assert_false(rg_snapshot_same_state(&a, &b));
    rg_snapshot_describe(&a, &b, text, sizeof(text));
    assert_string_equal(
        text, "snow[2] is 5 (0x00000005), not 0 (0x00000000), off by 5; 1 of 4 words differ");
}

// --- stages ---

// Draws no last frame.
static bool draw_less_on_cpu(struct rg_instance *instance)
{
    return (is_on(instance, "cpu") && instance->frame == 2) ||
           rg_technique_find("flow")->draw(instance);
}

// The same stages with other drops.
static bool open_another_on_cpu(struct rg_instance *instance)
{
    return (!is_on(instance, "cpu") ||
            rg_params_set(rig_flow.params, (char *)instance + rig_flow.settings, "seed=77")) &&
           rg_technique_find("flow")->open(instance);
}

// The first stage after which something differs is named, and so is one that did not run.
static void a_stage_that_differs_is_named(void **state)
{
    (void)state;
    struct rg_checks checks;
    rig_part = rg_verify_stages;
    rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "stages", "cpu"), RG_OK);
    assert_says(&checks, "stages", "cpu", "2 frames, ");
    assert_says(&checks, "stages", "cpu", "as on cpu:reference");
    rg_checks_free(&checks);
    rig_flow.step = step_off_on_cpu;
    rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "stages", "cpu"), RG_FAIL);
    assert_says(&checks, "stages", "cpu", "frame 2, stage ");
    rg_checks_free(&checks);
    rig_flow.step = rg_technique_find("flow")->step;
    rig_flow.open = open_another_on_cpu;
    rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "stages", "cpu"), RG_FAIL);
    rg_checks_free(&checks);
    rig_flow.open = rg_technique_find("flow")->open;
    rig_flow.draw = draw_less_on_cpu;
    rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "stages", "cpu"), RG_FAIL);
    assert_int_equal(rg_checks_exit(&checks), RG_EXIT_FAIL);
    rg_checks_free(&checks);
}

static bool fail_on_cpu(struct rg_instance *instance)
{
    return is_on(instance, "cpu") ? rg_driver_error("kernel 'rain': its driver is tired")
                                  : rg_technique_find("flow")->step(instance);
}

static bool fail_on_reference(struct rg_instance *instance)
{
    if (is_on(instance, "cpu"))
        return rg_technique_find("flow")->step(instance);
    return rg_unsupported("device 'cpu:reference': is too small");
}

// Devices of other tiers may leave other bits, which is told all the same. A device that fails is
// told by its failure, and without the reference nothing is compared.
static void stages_of_other_tiers_may_differ(void **state)
{
    (void)state;
    struct rg_checks checks;
    rig_part = rg_verify_stages;
    rig_flow.step = step_off_on_cpu;
    rig_verify(RIG_CHEAP " drops=40", RG_T1, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "stages", "cpu"), RG_OK);
    assert_says(&checks, "stages", "cpu", "frame 2, stage ");
    rg_checks_free(&checks);
    rig_flow.step = fail_on_cpu;
    rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "stages", "cpu"), RG_ERROR);
    assert_says(&checks, "stages", "cpu", "its driver is tired");
    rg_checks_free(&checks);
    rig_flow.step = fail_on_reference;
    rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
    assert_int_equal(checks.count, 2);
    assert_int_equal(rig_outcome(&checks, "stages", "cpu:reference"), RG_UNSUPPORTED);
    assert_int_equal(rg_checks_exit(&checks), RG_EXIT_UNSUPPORTED);
    rg_checks_free(&checks);
}

// --- laws ---

static bool always_holds(const struct rg_instance *instance, char *detail, size_t size)
{
    (void)instance;
    (void)detail;
    (void)size;
    return true;
}

// The law fails for the second seed, on cpu alone.
static int asked_on_cpu;

static bool fails_once(const struct rg_instance *instance, char *detail, size_t size)
{
    snprintf(detail, size, "it leaks");
    return !is_on(instance, "cpu") || ++asked_on_cpu != 2;
}

static void a_law_that_fails_once_fails(void **state)
{
    (void)state;
    static const struct rg_law laws[] = {
        {"order", always_holds}, {"water", fails_once}, {NULL, NULL}};
    static const struct rg_proof proof = {
        .poses = rig_poses, .dry = "drops=0 rain_drops_s=0 pane_rain_mm_h=0", .laws = laws};
    struct rg_checks checks;
    rig_flow.proof = &proof;
    asked_on_cpu = 0;
    rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "order", "cpu"), RG_OK);
    assert_int_equal(rig_outcome(&checks, "water", "cpu"), RG_FAIL);
    assert_says(&checks, "water", "cpu", "1 of 3 runs; seed 2: it leaks");
    assert_int_equal(rig_outcome(&checks, "water", "cpu:reference"), RG_OK);
    assert_says(&checks, "water", "cpu:reference", "holds after 3 runs of 2 steps");
    assert_int_equal(rg_checks_exit(&checks), RG_EXIT_FAIL);
    rg_checks_free(&checks);
}

// --- images ---

// Makes green and blue of a texel of the picture brighter on cpu.
static bool draw_brighter_on_cpu(struct rg_instance *instance)
{
    uint16_t texels[16 * 16 * 4];
    if (!rg_technique_find("flow")->draw(instance))
        return false;
    if (!is_on(instance, "cpu"))
        return true;
    assert_true(rg_image_read(instance->target, 0, 0, texels));
    texels[4 * (16 * 9 + 5) + 1] = 0x4c00; // 16
    texels[4 * (16 * 9 + 5) + 2] = 0x4c00; // two values are one pixel
    return rg_image_write(instance->target, 0, 0, texels);
}

static void a_texel_that_differs_is_named(void **state)
{
    (void)state;
    struct rg_checks checks;
    rig_flow.draw = draw_brighter_on_cpu;
    rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "image", "cpu"), RG_FAIL);
    assert_says(&checks, "image", "cpu", "3 of 3 runs; seed 1: 1 pixels differ, the most by 1");
    assert_says(&checks, "image", "cpu", " at x 5, y 9 (T0)");
    rg_checks_free(&checks);
}

static void an_image_without_rain_proves_nothing(void **state)
{
    (void)state;
    struct rg_checks checks;
    rig_verify(RIG_CHEAP " drops=0 rain_drops_s=0 pane_rain_mm_h=0", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "state", "cpu"), RG_OK);
    assert_int_equal(rig_outcome(&checks, "image", "cpu"), RG_NOTHING);
    assert_says(&checks, "image", "cpu", "proves nothing");
    assert_int_equal(rg_checks_exit(&checks), RG_EXIT_NOTHING);
    rg_checks_free(&checks);
}

// --- seeds ---

// The seeds of instances that have begun on cpu, in order.
static char seeds[64];

static bool note_seed(struct rg_instance *instance)
{
    const struct rg_param *seed = rg_params_find(rig_flow.params, "seed");
    char text[16], *end = seeds + strlen(seeds);
    rg_params_text(seed, (const char *)instance + rig_flow.settings, text, sizeof(text));
    if (is_on(instance, "cpu") && instance->frame == 0)
        snprintf(end, (size_t)(seeds + sizeof(seeds) - end), "%s ", text);
    return rg_technique_find("flow")->step(instance);
}

static void each_seed_is_another(void **state)
{
    (void)state;
    struct rg_checks checks;
    rig_flow.step = note_seed;
    seeds[0] = 0;
    rig_verify(RIG_CHEAP " drops=40 seed=5", RG_T0, 16, 16, &checks);
    assert_string_equal(seeds, "5 6 7 ");
    rg_checks_free(&checks);
    seeds[0] = 0; // the largest seed has none after it
    rig_verify(RIG_CHEAP " drops=40 seed=2147483647", RG_T0, 16, 16, &checks);
    assert_string_equal(seeds, "2147483647 2147483646 2147483645 ");
    rg_checks_free(&checks);
}

// --- errors ---

// Fails at the first step of each run on cpu, in turn by one of these.
static const bool *is_unsupported;
static int begun;

static bool fail_in_turn(struct rg_instance *instance)
{
    if (!is_on(instance, "cpu"))
        return rg_technique_find("flow")->step(instance);
    const int number = begun++;
    return is_unsupported[number] ? rg_unsupported("run %d: too small", number + 1)
                                  : rg_driver_error("run %d: is tired", number + 1);
}

// Of several failures the first is told, unless it says only that something is lacking.
static void the_failure_that_says_most_is_told(void **state)
{
    (void)state;
    static const struct {
        bool is_unsupported[3];
        enum rg_outcome outcome;
        const char *says;
    } cases[] = {{{true, true, true}, RG_UNSUPPORTED, "run 1: too small"},
                 {{true, false, true}, RG_ERROR, "run 2: is tired"},
                 {{false, true, false}, RG_ERROR, "run 1: is tired"},
                 {{true, false, false}, RG_ERROR, "run 2: is tired"}};
    rig_flow.step = fail_in_turn;
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_checks checks;
        is_unsupported = cases[i].is_unsupported;
        begun = 0;
        rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
        assert_int_equal(rig_outcome(&checks, "image", "cpu"), cases[i].outcome);
        assert_string_equal(rig_check(&checks, "image", "cpu")->detail, cases[i].says);
        rg_checks_free(&checks);
    }
}

// --- the reference ---

// If the reference fails, nothing is proven, though another check is ok.
static void a_reference_that_fails_proves_nothing(void **state)
{
    (void)state;
    struct rg_checks checks;
    rig_flow.step = fail_on_reference;
    rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "state", "cpu:reference"), RG_UNSUPPORTED);
    assert_int_equal(rig_outcome(&checks, "state", "cpu"), RG_UNSUPPORTED);
    assert_says(&checks, "state", "cpu", "not run");
    assert_int_equal(rg_checks_exit(&checks), RG_EXIT_UNSUPPORTED);
    rg_checks_free(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_state_that_differs_fails, rig_setup),
        cmocka_unit_test(an_element_is_named),
        cmocka_unit_test_setup(a_stage_that_differs_is_named, rig_setup),
        cmocka_unit_test_setup(stages_of_other_tiers_may_differ, rig_setup),
        cmocka_unit_test_setup(a_law_that_fails_once_fails, rig_setup),
        cmocka_unit_test_setup(an_image_without_rain_proves_nothing, rig_setup),
        cmocka_unit_test_setup(each_seed_is_another, rig_setup),
        cmocka_unit_test_setup(a_texel_that_differs_is_named, rig_setup),
        cmocka_unit_test_setup(the_failure_that_says_most_is_told, rig_setup),
        cmocka_unit_test_setup(a_reference_that_fails_proves_nothing, rig_setup),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
