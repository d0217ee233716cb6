// The outcome of `verify` for work that could not be done depends on whose error it was.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/techniques/stages/frame.h"
#include "harness/compare/verify/verify.h"
#include "harness/console/exit.h"
#include "tests/harness/verifying/rig.h"
#include "tests/tools/process/logged.h"

// A driver that fails on one device.
static bool fail_on_cpu(struct rg_instance *instance)
{
    if (strcmp(instance->device->info.name, "cpu"))
        return rg_technique_find("flow")->step(instance);
    return rg_driver_error("kernel 'rain': its driver is tired");
}

// How far one texel of `cpu` is from the other device's, in steps of a half: 1 is a rounding, 80
// some 4 codes of 255.
static int steps_off;

static bool draw(struct rg_instance *instance)
{
    if (!rg_technique_find("flow")->draw(instance))
        return false;
    if (strcmp(instance->device->info.name, "cpu"))
        return true;
    size_t size;
    uint16_t *texels = rg_frame_read(instance, &size);
    assert_non_null(texels);
    texels[0] = (uint16_t)(texels[0] + steps_off);
    assert_true(rg_image_write(instance->target, 0, 0, texels));
    free(texels);
    return true;
}

static void what_agrees_passes(void **state)
{
    (void)state;
    struct rg_checks checks;
    rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "state", "cpu"), RG_OK);
    assert_int_equal(rig_outcome(&checks, "image", "cpu"), RG_OK);
    assert_int_equal(rg_checks_exit(&checks), RG_EXIT_PASS);
    rg_checks_free(&checks);
}

static void bad_input_is_bad_usage(void **state)
{
    (void)state;
    struct rg_checks checks;
    rig_verify(RIG_CHEAP " environment=/nonexistent.exr", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "state", "cpu:reference"), RG_ERROR);
    assert_int_equal(rig_outcome(&checks, "image", "cpu"), RG_ERROR);
    assert_int_equal(rg_checks_exit(&checks), RG_EXIT_USAGE);
    rg_checks_free(&checks);
}

static void what_no_device_can_do_is_unsupported(void **state)
{
    (void)state;
    struct rg_checks checks;
    rig_verify(RIG_CHEAP, RG_T0, 1 << 20, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "state", "cpu:reference"), RG_UNSUPPORTED);
    assert_int_equal(rig_outcome(&checks, "image", "cpu"), RG_UNSUPPORTED);
    assert_int_equal(rg_checks_exit(&checks), RG_EXIT_UNSUPPORTED); // though another check is ok
    rg_checks_free(&checks);
}

static void a_drivers_failure_fails(void **state)
{
    (void)state;
    struct rg_checks checks;
    rig_flow.step = fail_on_cpu;
    rig_verify(RIG_CHEAP, RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "state", "cpu"), RG_ERROR);
    assert_int_equal(rig_outcome(&checks, "image", "cpu"), RG_ERROR);
    assert_int_equal(rg_checks_exit(&checks), RG_EXIT_FAIL);
    rg_checks_free(&checks);
}

// The outcome of an image on a device of this tier.
static enum rg_outcome judge(enum rg_tier tier, const char *says)
{
    enum { SIDE_PX = 64 };
    struct rg_checks checks;
    rig_flow.draw = draw;
    rig_verify(RIG_CHEAP " drops=90", tier, SIDE_PX, SIDE_PX, &checks);
    const enum rg_outcome outcome = rig_outcome(&checks, "image", "cpu");
    const char *detail = checks.rows[checks.count - 1].detail;
    if (!strstr(detail, says))
        fail_msg("'%s' does not say '%s'", detail, says);
    assert_int_equal(rg_checks_exit(&checks), outcome == RG_OK ? RG_EXIT_PASS : RG_EXIT_FAIL);
    rg_checks_free(&checks);
    return outcome;
}

static void devices_are_held_to_what_they_owe(void **state)
{
    (void)state;
    steps_off = 1;
    assert_int_equal(judge(RG_T0, "(T0)"), RG_FAIL);
    assert_int_equal(judge(RG_T1, "but within T1"), RG_OK);
    steps_off = 80;
    assert_int_equal(judge(RG_T1, "(T1)"), RG_FAIL);
    assert_int_equal(judge(RG_T2, "but within T2"), RG_OK);
}

// --- how long poses are run ---

static int taken; // steps on `cpu`

static bool count_step(struct rg_instance *instance)
{
    taken += !strcmp(instance->device->info.name, "cpu");
    return rg_technique_find("flow")->step(instance);
}

static const struct rg_pose long_poses[] = {
    {"drops=40", 3, 2}, {"drops=50", 5, RG_POSE_LEFT_OUT}, {"drops=60", 2, 1}, {NULL, 0, 0}};
static const struct rg_pose uncommon_poses[] = {
    {"", 11, RG_POSE_LEFT_OUT}, {"", 0, 0}, {"", 8, 0}, {"", RG_POSE_LEFT_OUT, 5}, {NULL, 0, 0}};
static const struct rg_proof long_proof = {
    .poses = long_poses, .dry = "drops=0 rain_drops_s=0 pane_rain_mm_h=0", .laws = rig_no_laws};

// Verifies these poses: all seeds together take `with_all` steps, and the line says how many a run
// has.
static void expect_steps(enum rg_verify_length length, int asked, int with_all, const char *says)
{
    struct rg_checks checks;
    rig_flow.proof = &long_proof;
    rig_flow.step = count_step;
    rig_length = length;
    rig_steps = asked;
    taken = 0;
    rig_verify(RIG_CHEAP, RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "state", "cpu"), RG_OK);
    assert_string_equal(checks.rows[1].detail, says);
    assert_int_equal(taken, with_all);
    rg_checks_free(&checks);
}

static void poses_say_how_long(void **state)
{
    (void)state;
    expect_steps(RG_VERIFY_FULL, -1, 3 * 10, "9 runs of 2 to 5 steps, identical to cpu:reference");
    expect_steps(RG_VERIFY_QUICK, -1, 3 * 2 + 1,
                 "4 runs of 1 to 2 steps, identical to cpu:reference");
    expect_steps(RG_VERIFY_USUAL, -1, 3 * 2 + 1 + 1,
                 "5 runs of 1 to 2 steps, identical to cpu:reference");
    expect_steps(RG_VERIFY_FULL, 4, 3 * 12, "9 runs of 4 steps, identical to cpu:reference");
    expect_steps(RG_VERIFY_QUICK, 4, 3 * 4 + 4, "4 runs of 4 steps, identical to cpu:reference");
    expect_steps(RG_VERIFY_USUAL, 4, 3 * 4 + 8, "5 runs of 4 steps, identical to cpu:reference");
}

// Usual runs take a fifth of the full steps, but no more than all of these, and no fewer than the
// quick ones, without which it may not rain.
static void usual_runs_are_shorter(void **state)
{
    (void)state;
    const struct rg_verify v = {.technique = &rig_flow, .steps = -1};
    assert_int_equal(rg_verify_steps(&v, &uncommon_poses[0]), 3);
    assert_int_equal(rg_verify_steps(&v, &uncommon_poses[1]), 200);
    assert_int_equal(rg_verify_steps(&v, &uncommon_poses[2]), 8);
    assert_int_equal(rg_verify_steps(&v, &uncommon_poses[3]), RG_POSE_LEFT_OUT);
}

// Poses without numbers of steps take verify's own; the progress bar counts them all.
static void poses_need_not_say(void **state)
{
    (void)state;
    const struct rg_devices none = {0};
    struct rg_verify v = {
        .technique = &rig_flow, .devices = &none, .length = RG_VERIFY_FULL, .steps = -1};
    assert_int_equal(rg_verify_steps(&v, &rig_poses[0]), 1000);
    assert_int_equal(rg_verify_device_work(&v), 1000 * RG_VERIFY_SEEDS);
    v.length = RG_VERIFY_QUICK;
    assert_int_equal(rg_verify_steps(&v, &rig_poses[0]), 100);
    v.steps = 0;
    assert_int_equal(rg_verify_steps(&v, &rig_poses[0]), 0);
    rig_flow.proof = &long_proof;
    v.steps = -1;
    assert_int_equal(rg_verify_device_work(&v), 2 * RG_VERIFY_SEEDS + 1);
    assert_int_equal(rg_verify_poses(&v), 2);
    assert_int_equal(rg_verify_stage_work(&v), 2);
}

// A device beside the reference takes as many steps as it; a contrast is drawn twice, and the model
// once before all mutants.
static void the_bar_counts_all_steps(void **state)
{
    (void)state;
    static const struct rg_mutant mutants[] = {{"a", "", 1, 1}, {"b", "", 1, 1}, {NULL}};
    static const struct rg_contrast contrasts[] = {
        {"c", "", ""}, {"d", "", ""}, {"e", "", ""}, {NULL}};
    struct rg_proof seen = long_proof;
    struct rg_device reference, one, other;
    const struct rg_devices three = {.count = 3, .devices = {&one, &reference, &other}};
    struct rg_verify v = {.technique = &rig_flow,
                          .reference = &reference,
                          .devices = &three,
                          .length = RG_VERIFY_QUICK,
                          .steps = -1};
    rig_flow.proof = &seen;
    seen.mutants = mutants;
    assert_int_equal(rg_verify_device_work(&v), 3 * (2 * RG_VERIFY_SEEDS + 1));
    assert_int_equal(rg_verify_stage_work(&v), 2 * 4);
    assert_int_equal(rg_verify_mutant_work(&v), 300);
    seen.contrasts = contrasts;
    assert_int_equal(rg_verify_mutant_work(&v), 300 + 600);
}

// Except in full runs, the first pose has every seed, and the others take turns.
static void poses_take_turns_with_seeds(void **state)
{
    (void)state;
    struct rg_verify v = {.technique = &rig_flow, .steps = -1};
    rig_flow.proof = &long_proof;
    for (int seed = 0; seed < RG_VERIFY_SEEDS; seed++) {
        assert_true(rg_verify_has_seed(&v, &long_poses[0], seed));
        assert_int_equal(rg_verify_has_seed(&v, &long_poses[1], seed), seed == 1);
        assert_int_equal(rg_verify_has_seed(&v, &long_poses[2], seed), seed == 2);
        v.length = RG_VERIFY_FULL;
        assert_true(rg_verify_has_seed(&v, &long_poses[1], seed));
        v.length = seed == 0 ? RG_VERIFY_QUICK : RG_VERIFY_USUAL;
    }
}

// Draws mutants and contrasts of flow in this scene, and expects this outcome.
static void verify_contrasts(const char *scene, const struct rg_mutant *mutants,
                             const struct rg_contrast *contrasts, enum rg_outcome outcome,
                             const char *says)
{
    const struct rg_proof seen = {.dry = "drops=0 rain_drops_s=0 pane_rain_mm_h=0",
                                  .mutant_scene = scene,
                                  .mutants = mutants,
                                  .contrasts = contrasts};
    struct rg_checks checks = {0};
    struct rg_progress progress;
    struct rg_verify v = {.technique = &rig_flow,
                          .mutant_device = rg_device_open("cpu"),
                          .checks = &checks,
                          .progress = &progress};
    rig_flow.proof = &seen;
    rg_log_listen(log_last, NULL);
    rg_progress_start(&progress, rg_verify_mutant_work(&v));
    rg_verify_mutants(&v);
    rg_progress_end(&progress);
    rg_log_listen(NULL, NULL);
    assert_int_equal(checks.count, 1);
    assert_string_equal(checks.rows[0].check, "mutants");
    assert_string_equal(checks.rows[0].detail, says);
    assert_int_equal(checks.rows[0].status, outcome);
    assert_int_equal(rg_checks_exit(&checks), outcome == RG_OK ? RG_EXIT_PASS : RG_EXIT_FAIL);
    assert_true(rg_device_close(v.mutant_device));
    rg_checks_free(&checks);
}

static void verify_mutants(const char *scene, const struct rg_mutant *mutants,
                           enum rg_outcome outcome, const char *says)
{
    verify_contrasts(scene, mutants, NULL, outcome, says);
}

// flow in a scene where another seed shows, but another model does not.
static void a_mutant_that_lives_fails(void **state)
{
    (void)state;
    const struct rg_mutant mutants[] = {{"another seed", "seed", 1, 1},
                                        {"a model behind", "model_size", 1.01, 0},
                                        {"a rounding", "fresnel_bias", 1.002, 0},
                                        {NULL, NULL, 0, 0}};
    verify_mutants(RIG_CHEAP " pane_rain_mm_h=0 drops=400", mutants, RG_FAIL,
                   "killed 1/3; T1 accepts: a model behind, a rounding");
}

// A contrast has a scene of its own, over the defaults: what is wrong in it is right in the
// others'.
static void a_contrast_is_a_mutant(void **state)
{
    (void)state;
    const struct rg_mutant none[] = {{NULL, NULL, 0, 0}};
    const struct rg_contrast contrasts[] = {
        {"other drops", RIG_CHEAP " pane_rain_mm_h=0 drops=60", "drops=400"},
        {"a model behind", RIG_CHEAP " pane_rain_mm_h=0 drops=60", "model_size=0.5"},
        {NULL, NULL, NULL}};
    verify_contrasts(RIG_CHEAP " pane_rain_mm_h=0 drops=400", none, contrasts, RG_FAIL,
                     "killed 1/2; T1 accepts: a model behind");
}

// A mutant that cannot be drawn is a fault of the list, even if all the others are killed.
static void a_mutant_that_is_none_fails(void **state)
{
    (void)state;
    const struct rg_mutant seed = {"another seed", "seed", 1, 1}, none = {NULL, NULL, 0, 0};
    const struct rg_mutant above[] = {seed, {"too many drops", "drops", 1, 1e6}, none};
    const struct rg_mutant below[] = {{"too few drops", "drops", 1, -401}, seed, none};
    const struct rg_mutant itself[] = {seed, {"the model", "fresnel_bias", 1, 0}, none};
    const char scene[] = RIG_CHEAP " pane_rain_mm_h=0 drops=400";
    verify_mutants(scene, above, RG_FAIL,
                   "'too many drops' is none: drops is 400 in the model's scene and would be "
                   "1000400, of 0 to 100000; mend the list of flow");
    verify_mutants(scene, below, RG_FAIL,
                   "'too few drops' is none: drops is 400 in the model's scene and would be -1, of "
                   "0 to 100000; mend the list of flow");
    verify_mutants(scene, itself, RG_FAIL,
                   "'the model' is none: fresnel_bias is 0.02 in the model's scene and would be "
                   "0.02, of 0 to 1; mend the list of flow");
}

// Whether the instance has the seed after the default one.
static bool has_another_seed(const struct rg_instance *instance)
{
    char text[16];
    rg_params_text(rg_params_find(rig_flow.params, "seed"),
                   (const char *)instance + rig_flow.settings, text, sizeof(text));
    return !strcmp(text, "2");
}

static bool fail_on_another_seed(struct rg_instance *instance)
{
    if (strcmp(instance->device->info.name, "cpu") || !has_another_seed(instance))
        return rg_technique_find("flow")->step(instance);
    return rg_driver_error("kernel 'rain': its driver is tired");
}

// One error is an error, even if the others of the list are killed.
static void a_mutant_that_fails_is_an_error(void **state)
{
    (void)state;
    const struct rg_mutant mutants[] = {
        {"fewer drops", "drops", 0.5, 0}, {"another seed", "seed", 1, 1}, {NULL, NULL, 0, 0}};
    rig_flow.step = fail_on_another_seed;
    verify_mutants(RIG_CHEAP " pane_rain_mm_h=0 drops=400", mutants, RG_ERROR,
                   "kernel 'rain': its driver is tired");
}

// One failed run of several is an error, too.
static void a_run_that_fails_is_an_error(void **state)
{
    (void)state;
    struct rg_checks checks;
    rig_flow.step = fail_on_another_seed;
    rig_verify(RIG_CHEAP " drops=40", RG_T0, 16, 16, &checks);
    assert_int_equal(rig_outcome(&checks, "state", "cpu"), RG_ERROR);
    assert_int_equal(rig_outcome(&checks, "image", "cpu"), RG_ERROR);
    assert_int_equal(rg_checks_exit(&checks), RG_EXIT_FAIL);
    rg_checks_free(&checks);
}

// A small error shows among the few pixels with rain, not among all. The dry picture is of the
// mutants' own scene.
static void a_mutant_is_judged_where_it_rains(void **state)
{
    (void)state;
    const struct rg_mutant mutants[] = {{"Fresnel bias a quarter higher", "fresnel_bias", 1.25, 0},
                                        {NULL, NULL, 0, 0}};
    verify_mutants(RIG_CHEAP " move=paper rain_drops_s=0 drops=60", mutants, RG_OK, "killed 1/1");
}

// Whose error it was decides the exit status.
static void errors_are_somebodys(void **state)
{
    (void)state;
    for (int is_input = 0; is_input < 2; is_input++) {
        struct rg_checks checks = {0};
        rg_log_listen(log_last, NULL);
        is_input ? rg_error("no such file") : rg_driver_error("the driver is tired");
        rg_log_listen(NULL, NULL);
        rg_checks_add_error(&checks, "flow", "state", "cpu");
        assert_int_equal(rg_checks_exit(&checks), is_input ? RG_EXIT_USAGE : RG_EXIT_FAIL);
        assert_int_equal(checks.rows[0].status, RG_ERROR);
        assert_string_equal(checks.rows[0].detail, rg_last_error());
        rg_checks_free(&checks);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(what_agrees_passes, rig_setup),
        cmocka_unit_test_setup(bad_input_is_bad_usage, rig_setup),
        cmocka_unit_test_setup(what_no_device_can_do_is_unsupported, rig_setup),
        cmocka_unit_test_setup(a_drivers_failure_fails, rig_setup),
        cmocka_unit_test_setup(devices_are_held_to_what_they_owe, rig_setup),
        cmocka_unit_test_setup(poses_say_how_long, rig_setup),
        cmocka_unit_test_setup(usual_runs_are_shorter, rig_setup),
        cmocka_unit_test_setup(poses_need_not_say, rig_setup),
        cmocka_unit_test_setup(poses_take_turns_with_seeds, rig_setup),
        cmocka_unit_test_setup(the_bar_counts_all_steps, rig_setup),
        cmocka_unit_test_setup(a_contrast_is_a_mutant, rig_setup),
        cmocka_unit_test(errors_are_somebodys),
        cmocka_unit_test_setup(a_mutant_that_lives_fails, rig_setup),
        cmocka_unit_test_setup(a_mutant_that_is_none_fails, rig_setup),
        cmocka_unit_test_setup(a_mutant_that_fails_is_an_error, rig_setup),
        cmocka_unit_test_setup(a_run_that_fails_is_an_error, rig_setup),
        cmocka_unit_test_setup(a_mutant_is_judged_where_it_rains, rig_setup),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
