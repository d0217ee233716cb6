// Blame and replays on two devices that are made up: the stage, the place and the words of a
// difference, and what a replayed case says of a device.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "tests/harness/verifying/shrinking/made.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/printed.h"

static enum made_way way;

static enum made_way in_that_way(const struct rg_digest_run *run)
{
    (void)run;
    return way;
}

static struct rg_digest_run run_of(int frames, void **settings)
{
    *settings = rg_settings_create(&made_technique);
    assert_non_null(*settings);
    made_way = in_that_way;
    return (struct rg_digest_run){{&made_technique, *settings, 16, 16}, frames};
}

// --- blame ---

static void find(int frames, struct rg_blame *blame)
{
    void *settings;
    const struct rg_digest_run run = run_of(frames, &settings);
    made_takes = 0;
    assert_true(rg_blame_find(&run, &made_device, &made_truth, blame));
    free(settings);
}

// A word of the third frame, by its last bit, by more, and as it was before: that is what the truth
// had after the stage before, which wrote the same asset.
static void what_differs_is_told(void **state)
{
    (void)state;
    static const struct {
        enum made_way way;
        enum rg_difference difference;
        const char *text;
    } cases[] = {
        {MADE_OFF, RG_DIFFERENCE_LAST_BITS,
         "frame 3, stage rain_step: water[5] is 18.0000019 (0x41900001), not 18 (0x41900000), off "
         "by 1.91e-06; 1 of 8 words differ; in the last bits"},
        {MADE_OTHER, RG_DIFFERENCE_VALUES,
         "frame 3, stage rain_step: water[5] is 20 (0x41a00000), not 18 (0x41900000), off by 2; 1 "
         "of 8 words differ; other values"},
        {MADE_LEFT, RG_DIFFERENCE_MISSING,
         "frame 3, stage rain_step: water[5] is 12 (0x41400000), not 18 (0x41900000), off by 6; 1 "
         "of 8 words differ; missing: what was there before the stage still is"},
    };
    made_frame = 3;
    for (int i = 0; i < 3; i++) {
        struct rg_blame blame;
        way = cases[i].way;
        find(2, &blame);
        assert_false(blame.found);
        find(9, &blame);
        assert_true(blame.found);
        assert_int_equal(made_takes, 3); // of 1, 2 and 4 frames
        assert_false(blame.is_alone);
        assert_int_equal(blame.first.frame, 3);
        assert_int_equal(blame.first.stages_run, 5);
        assert_int_equal(blame.first.hash, 3006);
        assert_int_equal(blame.expected, 3005);
        assert_int_equal(blame.difference, cases[i].difference);
        assert_false(blame.is_image);
        assert_int_equal(blame.item, MADE_WRONG);
        assert_int_equal(blame.differing, 1);
        assert_int_equal(blame.words, MADE_WORDS);
        assert_string_equal(blame.text, cases[i].text);
    }
}

// An image of 4 x 2 texels, 2 layers and 2 levels: the second level has 2 x 1 texels a layer.
static void texels_of_layers_and_levels_are_named(void **state)
{
    (void)state;
    static const struct {
        int word, x, y, layer, level;
    } cases[] = {{0, 0, 0, 0, 0},  {7, 3, 1, 0, 0},  {8, 0, 0, 1, 0},  {13, 1, 1, 1, 0},
                 {15, 3, 1, 1, 0}, {16, 0, 0, 0, 1}, {17, 1, 0, 0, 1}, {19, 1, 0, 1, 1}};
    way = MADE_TEXEL;
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_blame blame;
        made_word = cases[i].word;
        find(1, &blame);
        assert_string_equal(blame.first.asset, "target");
        assert_true(blame.is_image);
        assert_int_equal(blame.x, cases[i].x);
        assert_int_equal(blame.y, cases[i].y);
        assert_int_equal(blame.layer, cases[i].layer);
        assert_int_equal(blame.level, cases[i].level);
        assert_int_equal(blame.words, MADE_TEXELS);
        json_t *json = rg_blame_json(&blame),
               *due = json_pack("[iiii]", cases[i].x, cases[i].y, cases[i].layer, cases[i].level);
        assert_true(json_equal(json_object_get(json, "texel"), due));
        assert_null(json_object_get(json, "item"));
        json_decref(json);
        json_decref(due);
    }
}

// An asset that one device alone writes has no contents to compare.
static void what_one_alone_writes_is_told(void **state)
{
    (void)state;
    struct rg_blame blame;
    way = MADE_FEWER;
    made_frame = 2;
    find(2, &blame);
    assert_true(blame.is_alone);
    assert_int_equal(blame.first.stages_run, 4);
    assert_int_equal(blame.difference, RG_DIFFERENCE_NONE);
    assert_string_equal(blame.text,
                        "frame 2, stage rain_draw: target is written by one of the two alone");
}

static void blame_has_a_machine_form(void **state)
{
    (void)state;
    struct rg_blame blame;
    way = MADE_OTHER;
    made_frame = 3;
    find(4, &blame);
    json_t *json = rg_blame_json(&blame);
    json_t *due = json_pack("{sb si si ss ss ss ss ss si si ss si}", "alone", 0, "frame", 3,
                            "stages_run", 5, "stage", "rain_step", "asset", "water", "class",
                            "values", "digest", "0000000000000bbe", "expected", "0000000000000bbd",
                            "differing", 1, "words", 8, "text", blame.text, "item", 5);
    assert_non_null(due);
    assert_true(json_equal(json, due));
    json_decref(json);
    json_decref(due);
}

static void rows_differ_by_hash_stage_and_asset(void **state)
{
    (void)state;
    const struct rg_digest due[] = {{.hash = 1, .stages_run = 1, .asset = "a"},
                                    {.hash = 2, .stages_run = 2, .asset = "a"},
                                    {.hash = 3, .stages_run = 3, .asset = "b"}};
    struct rg_digest now[3];
    const struct rg_digests a = {.count = 3, .rows = now},
                            b = {.count = 3, .rows = (struct rg_digest *)due},
                            fewer = {.count = 2, .rows = now}, none = {.count = 0};
    memcpy(now, due, sizeof(now));
    assert_int_equal(rg_blame_first(&a, &b), -1);
    assert_int_equal(rg_blame_first(&fewer, &b), 2);
    assert_int_equal(rg_blame_first(&b, &fewer), 2);
    assert_int_equal(rg_blame_first(&none, &b), 0);
    assert_int_equal(rg_blame_first(&none, &none), -1);
    now[1].hash = now[2].hash = 9;
    assert_int_equal(rg_blame_first(&a, &b), 1);
    memcpy(now, due, sizeof(now));
    now[2].stages_run = 4;
    assert_int_equal(rg_blame_first(&a, &b), 2);
    memcpy(now, due, sizeof(now));
    strcpy(now[0].asset, "c");
    assert_int_equal(rg_blame_first(&a, &b), 0);
}

// --- failures ---

// A failure is about the first row whose stage's kernel it names in quotes, also of those that pack
// for it; else about the last row.
static void a_failure_names_a_stage(void **state)
{
    (void)state;
    struct rg_digest rows[] = {{.stage = ""},     {.stage = "flow_blur"}, {.stage = "flow"},
                               {.stage = "mesh"}, {.stage = "mesh"},      {.stage = "last"}};
    const struct rg_digests digests = {.count = 6, .rows = rows}, none = {.count = 0};
    static const struct {
        const char *what;
        int row;
    } cases[] = {{"while running kernel 'flow'", 2},    {"while running kernel 'flow_blur'", 1},
                 {"kernel 'mesh': it is lost", 3},      {"kernel 'mesh_count'", 3},
                 {"kernel 'mesh_emit' is lost", 3},     {"kernel 'mesh_other'", 5},
                 {"a buffer 'x' of kernel 'flow'", 2},  {"kernel flow", 5},
                 {"while running kernel 'nothing'", 5}, {"", 5}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_fall fall = {.outcome = RG_CRASH};
        strcpy(fall.what, cases[i].what);
        assert_int_equal(rg_fall_row(&fall, &digests), cases[i].row);
        assert_int_equal(rg_fall_row(&fall, &none), -1);
        const struct rg_fall other = {.outcome = RG_TIMEOUT};
        struct rg_fall same = fall;
        assert_true(rg_fall_is_same(&fall, &same));
        same.outcome = RG_TIMEOUT;
        assert_false(rg_fall_is_same(&fall, &same));
        if (*cases[i].what)
            assert_false(rg_fall_is_same(&same, &other));
    }
}

// A driver's error is told by its line, and its end by what it did; other failures are none. The
// process is started anew.
static void how_a_device_fails_is_told(void **state)
{
    (void)state;
    rg_log_hold(true);
    rg_driver_error("kernel 'rain_draw': its driver is \ttired");
    struct rg_fall fall = rg_fall_now(&made_device);
    assert_int_equal(fall.outcome, RG_ERROR);
    assert_string_equal(fall.what, "kernel 'rain_draw': its driver is  tired");
    rg_timeout_error("doubtful: it did not answer");
    fall = rg_fall_now(&made_device);
    assert_int_equal(fall.outcome, RG_TIMEOUT);
    assert_string_equal(fall.what, "while running kernel 'rain_step'");
    assert_int_equal(made_renewals, 2);
    assert_int_equal(rg_fall_now(&made_truth).outcome, RG_OK); // it has no process of its own
    rg_error("a file is not there");
    assert_int_equal(rg_fall_now(&made_device).outcome, RG_OK);
    assert_int_equal(made_renewals, 2);
    rg_log_hold(false);
}

// --- replays ---

static const struct rg_case case_of_water = {.stages_run = 5,
                                             .stage = "rain_step",
                                             .asset = "water",
                                             .difference = RG_DIFFERENCE_VALUES,
                                             .expected = 3005,
                                             .found = 3006};

// Replays a case of 3 frames, which prints this.
static void replay(struct rg_case c, int exit, const char *prints)
{
    void *settings;
    c.run = run_of(3, &settings);
    made_frame = 3;
    printed_begin();
    const int ended = rg_case_replay(&c, "rain.txt", &made_device);
    const char *text = printed_end();
    assert_string_equal(text, prints);
    assert_int_equal(ended, exit);
    free(settings);
}

static void a_replay_tells_what_the_asset_holds(void **state)
{
    (void)state;
    struct rg_case c = case_of_water;
    way = MADE_SAME;
    replay(c, RG_EXIT_PASS,
           "same: doubtful leaves 0000000000000bbd in water after stage rain_step; expected "
           "0000000000000bbd\n");
    way = MADE_OTHER;
    replay(c, RG_EXIT_FAIL,
           "other: doubtful leaves 0000000000000bbe in water after stage rain_step; expected "
           "0000000000000bbd, as was found\n");
    c.found = 7;
    replay(c, RG_EXIT_FAIL,
           "other: doubtful leaves 0000000000000bbe in water after stage rain_step; expected "
           "0000000000000bbd\n");
    strcpy(c.asset, "target");
    replay(c, RG_EXIT_FAIL, "other: doubtful leaves no target after stage 5\n");
}

static void a_replay_tells_how_the_device_fails(void **state)
{
    (void)state;
    struct rg_case c = case_of_water;
    rg_log_hold(true);
    way = MADE_CRASH;
    replay(c, RG_EXIT_FAIL, "other: doubtful: crash while running kernel 'rain_step'\n");
    c.fall = (struct rg_fall){RG_CRASH, "while running kernel 'rain_step'"};
    replay(c, RG_EXIT_FAIL,
           "other: doubtful: crash while running kernel 'rain_step', as was found\n");
    way = MADE_TIRED;
    replay(c, RG_EXIT_FAIL, "other: doubtful: error kernel 'rain_step': its driver is tired\n");
    way = MADE_REFUSED;
    replay(c, RG_EXIT_USAGE, "");
    rg_log_hold(false);
}

// A case of a raingauge with other stages or assets says nothing of a device.
static void a_case_of_another_version_is_refused(void **state)
{
    (void)state;
    rg_log_hold(true);
    way = MADE_SAME;
    struct rg_case c = case_of_water;
    c.stages_run = 7;
    replay(c, RG_EXIT_USAGE, "");
    assert_string_equal(rg_last_error(), "rain.txt: there are fewer than 7 stages here; write one "
                                         "anew with `raingauge shrink`");
    c.stages_run = 6;
    replay(c, RG_EXIT_USAGE, "");
    assert_string_equal(rg_last_error(), "rain.txt: stage 6 is 'rain_draw' here, and not "
                                         "'rain_step'; write one anew with `raingauge shrink`");
    c = case_of_water;
    strcpy(c.asset, "snow");
    replay(c, RG_EXIT_USAGE, "");
    assert_string_equal(rg_last_error(), "rain.txt: there is no asset 'snow' here; write one anew "
                                         "with `raingauge shrink`");
    rg_log_hold(false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(what_differs_is_told, made_reset),
        cmocka_unit_test_setup(texels_of_layers_and_levels_are_named, made_reset),
        cmocka_unit_test_setup(what_one_alone_writes_is_told, made_reset),
        cmocka_unit_test_setup(blame_has_a_machine_form, made_reset),
        cmocka_unit_test_setup(rows_differ_by_hash_stage_and_asset, made_reset),
        cmocka_unit_test_setup(a_failure_names_a_stage, made_reset),
        cmocka_unit_test_setup(how_a_device_fails_is_told, made_reset),
        cmocka_unit_test_setup(a_replay_tells_what_the_asset_holds, made_reset),
        cmocka_unit_test_setup(a_replay_tells_how_the_device_fails, made_reset),
        cmocka_unit_test_setup(a_case_of_another_version_is_refused, made_reset),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
