// What a record says of itself: marks, rates, drifts, names and ends.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/record/record.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

enum { SAMPLES = 6 };

// A record of so many samples, of which the first has lost this share to others.
static struct rg_record timed(double low, double high, int samples, double taken)
{
    struct rg_record record = {.frame_ms = {.median = 20, .low = low, .high = high},
                               .sample_count = samples};
    record.taken[0] = taken;
    record.taken[samples] = 1; // of a sample that is not there
    return record;
}

// An interval counts from 1.1 times on, by half its logarithm; a twentieth of the processors is
// still undisturbed.
static void numbers_have_marks(void **state)
{
    (void)state;
    static const struct {
        double low, high, taken, noise;
        int disturbed;
        const char *mark;
    } rows[] = {{10, 11, 0.05, 0, 0, ""},
                {10, 12.1, 0.05, 0.1, 0, "+-10%"},
                {10, 14.4, 0.06, 0.2, 1, "+-20% busy"},
                {10, 10.5, 0.06, 0, 1, "busy"},
                {NAN, NAN, 0, 0, 0, ""},
                {1, 1e20, 0, 1e10 - 1, 0, "+-1000000%"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_record record = timed(rows[i].low, rows[i].high, SAMPLES, rows[i].taken);
        char mark[RG_MARK_SIZE] = "unset";
        rg_record_mark(&record, mark);
        assert_string_equal(mark, rows[i].mark);
        assert_below(fabs(rg_record_noise(&record) - rows[i].noise), 1e-9 * (1 + rows[i].noise));
        assert_int_equal(rg_record_disturbed(&record), rows[i].disturbed);
    }
}

static void disturbances_are_counted(void **state)
{
    (void)state;
    struct rg_record record = timed(10, 10, 4, 0.2);
    record.taken[3] = 0.3;
    assert_int_equal(rg_record_disturbed(&record), 2);
    assert_equals(rg_record_fps(&record), 50);
    static const struct {
        double stolen, others;
        bool is_disturbed;
    } rows[] = {{0.05, 0.05, false}, {0.06, 0, true}, {0, 0.06, true}, {0, 0, false}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_launch launch = {1, 500, rows[i].stolen, rows[i].others, 900};
        assert_int_equal(rg_launch_is_disturbed(&launch), rows[i].is_disturbed);
    }
}

// A cell is whole when it ended otherwise, or has its samples and its run by pass.
static void a_cell_is_whole_or_not(void **state)
{
    (void)state;
    static const struct {
        enum rg_outcome outcome;
        int samples, wanted, pass_frames;
        bool is_whole;
    } rows[] = {{RG_OK, 6, 6, 1, true}, {RG_OK, 5, 6, 1, false},   {RG_OK, 6, 6, 0, false},
                {RG_OK, 7, 6, 2, true}, {RG_CRASH, 0, 6, 0, true}, {RG_NOTHING, 1, 6, 0, true},
                {RG_OK, 0, 0, 1, true}, {RG_OK, 0, 0, 0, false}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_record record = {.outcome = rows[i].outcome,
                                         .sample_count = rows[i].samples,
                                         .wanted_samples = rows[i].wanted,
                                         .pass_frames = rows[i].pass_frames};
        assert_int_equal(rg_record_is_whole(&record), rows[i].is_whole);
    }
}

// The load's mean time tells a machine's speed; without one on either side nothing is known.
static void machines_drift(void **state)
{
    (void)state;
    static const struct {
        double begin_a, end_a, begin_b, end_b, drift;
    } rows[] = {
        {1, 3, 2, 6, 2}, {2, 6, 1, 3, 2}, {4, 4, 3, 5, 1}, {0, 0, 1, 1, 1}, {1, 1, 0, 0, 1}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_record a = {.calibration_begin_ms = rows[i].begin_a,
                                    .calibration_end_ms = rows[i].end_a};
        const struct rg_record b = {.calibration_begin_ms = rows[i].begin_b,
                                    .calibration_end_ms = rows[i].end_b};
        assert_equals(rg_record_drift(&a, &b), rows[i].drift);
        assert_equals(rg_record_load_ms(&a), (rows[i].begin_a + rows[i].end_a) / 2);
    }
}

// Names beside numbers; NAN: not there.
static struct rg_record printed(double fps, double least_ms, double most_ms)
{
    struct rg_record record = {0};
    struct rg_named *to = record.published;
    if (!isnan(fps))
        rg_named_set_number(&to[record.published_count++], "fps", fps);
    if (!isnan(least_ms))
        rg_named_set_number(&to[record.published_count++], "ms_per_frame_min", least_ms);
    if (!isnan(most_ms))
        rg_named_set_number(&to[record.published_count++], "ms_per_frame_max", most_ms);
    return record;
}

// The longest time is the lowest rate.
static void printed_rates_are_ranges(void **state)
{
    (void)state;
    static const struct {
        double fps, least_ms, most_ms, low, high;
    } rows[] = {{30, NAN, NAN, 30, 30},
                {NAN, 10, 25, 40, 100},
                {30, 10, NAN, 30, 100},
                {30, NAN, 40, 25, 30},
                {30, 10, 40, 25, 100}};
    double low, high;
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_record record = printed(rows[i].fps, rows[i].least_ms, rows[i].most_ms);
        rg_record_published_range(&record, &low, &high);
        assert_equals(low, rows[i].low);
        assert_equals(high, rows[i].high);
    }
    const struct rg_record none = printed(NAN, NAN, NAN);
    assert_true(isnan(rg_record_published_fps(&none)));
    rg_record_published_range(&none, &low, &high);
    assert_true(isnan(low) && isnan(high));
}

// Up to a factor of 1.2, in either direction, the work is the printed one.
static void other_work_is_told_by_its_particles(void **state)
{
    (void)state;
    static const struct {
        double due, found, apart;
        bool is_other;
    } rows[] = {{1000, 1000, 1, false},   {1000, 1200, 1.2, false}, {1200, 1000, 1.2, false},
                {1000, 1210, 1.21, true}, {1210, 1000, 1.21, true}, {0, 1000, 1, false},
                {1000, 0, 1, false},      {NAN, 1000, 1, false},    {1000, NAN, 1, false}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_record record = {0};
        double apart = 0;
        if (!isnan(rows[i].due))
            rg_named_set_number(&record.published[record.published_count++], "particles",
                                rows[i].due);
        if (!isnan(rows[i].found))
            rg_named_set_number(&record.facts[record.fact_count++], "particles", rows[i].found);
        assert_int_equal(rg_record_is_other_work(&record, &apart), rows[i].is_other);
        assert_int_equal(rg_record_is_other_work(&record, NULL), rows[i].is_other);
        assert_below(fabs(apart - rows[i].apart), 1e-12);
    }
}

static void a_row_is_named_by_its_values(void **state)
{
    (void)state;
    struct rg_record record = {0};
    char name[64] = "unset", cut[9];
    rg_record_row_name(&record, name, sizeof(name));
    assert_string_equal(name, "");
    rg_named_set_text(&record.row[record.row_count++], "scene", "all");
    rg_named_set_text(&record.row[record.row_count++], "merge", "on");
    rg_named_set_number(&record.row[record.row_count++], "camera", 1);
    rg_named_set_number(&record.row[record.row_count++], "drops", 1234567890);
    rg_record_row_name(&record, name, sizeof(name));
    assert_string_equal(name, "all, merge on, camera 1, drops 1234567890");
    rg_record_row_name(&record, cut, sizeof(cut));
    assert_string_equal(cut, "all, mer");
    rg_named_set_number(&record.row[0], "height_m", 2.5);
    record.row_count = 2;
    rg_record_row_name(&record, name, sizeof(name));
    assert_string_equal(name, "height_m 2.5, merge on");
}

// Each count has its own name; one that a device cannot take is null.
static void tallies_are_named(void **state)
{
    (void)state;
    const struct rg_tally tally = {.runs = 1,
                                   .dispatches = 2,
                                   .items = 3,
                                   .records = 4,
                                   .fragments = 5,
                                   .fragments_kept = 6,
                                   .light_evaluations = -1,
                                   .texels_fetched = 0,
                                   .bytes_written = 9,
                                   .bytes_read = 10};
    json_t *json = rg_tally_json(&tally);
    json_t *due =
        json_pack("{si si si si si si sn si si si}", "runs", 1, "dispatches", 2, "items", 3,
                  "records", 4, "fragments", 5, "fragments_kept", 6, "light_evaluations",
                  "texels_fetched", 0, "bytes_written", 9, "bytes_read", 10);
    assert_true(json_equal(json, due));
    json_decref(json);
    json_decref(due);
}

static void an_end_has_its_reason(void **state)
{
    (void)state;
    struct rg_record record = {0};
    assert_false(rg_record_end(&record, RG_FAIL, "differs"));
    assert_int_equal(record.outcome, RG_FAIL);
    assert_string_equal(record.detail, "differs");
    rg_log_listen(log_last, NULL);
    rg_timeout_error("gl: %s", "does not return");
    assert_false(rg_record_end_by_error(&record));
    rg_log_listen(NULL, NULL);
    assert_int_equal(record.outcome, RG_TIMEOUT);
    assert_string_equal(record.detail, "gl: does not return");
}

// Every number of a record, each of which documents keep to nine digits.
static int numbers_of(struct rg_record *r, double *numbers[])
{
    double *const all[] = {&r->truth_error.flip_mask_mean,
                           &r->truth_error.flip_mean,
                           &r->create_ms,
                           &r->first_frame_ms,
                           &r->api_over_wall,
                           &r->calibration_begin_ms,
                           &r->calibration_end_ms,
                           &r->passes[0].ms,
                           &r->passes[1].ms,
                           &r->samples_ms[0],
                           &r->samples_ms[1],
                           &r->taken[0],
                           &r->taken[1],
                           &r->launches[0].ms,
                           &r->launches[0].stolen,
                           &r->launches[0].others,
                           &r->launches[0].seconds,
                           &r->launches[1].ms,
                           &r->launches[1].stolen,
                           &r->launches[1].others,
                           &r->launches[1].seconds};
    memcpy(numbers, all, sizeof(all));
    return (int)(sizeof(all) / sizeof(all[0]));
}

static void all_numbers_are_settled(void **state)
{
    (void)state;
    static struct rg_record record = {.pass_count = 2, .sample_count = 2, .launch_count = 2};
    double *numbers[32];
    const int count = numbers_of(&record, numbers);
    for (int i = 0; i < count; i++)
        *numbers[i] = i + 1 + 1.0 / 3;
    rg_record_settle(&record);
    for (int i = 0; i < count; i++) {
        const double due = i + 1 + (i < 9 ? 0.33333333 : 0.3333333); // nine digits in all
        assert_below(fabs(*numbers[i] - due), 1e-12);
    }
    assert_below(fabs(record.frame_ms.median - 10.8333333), 1e-12); // of 10.3333333 and 11.3333333
    assert_below(fabs(rg_record_passes_ms(&record) - 17.66666666), 1e-12);
}

// Two undisturbed launches tell more than any samples, which are all of one process.
static void launches_replace_samples(void **state)
{
    (void)state;
    static struct rg_record record = {
        .sample_count = 6,
        .samples_ms = {10, 10, 10, 10, 10, 10},
        .taken = {0.5},
        .launch_count = 3,
        .launches = {{1, 20, 0, 0, 1}, {2, 400, 0, 0.06, 1}, {3, 20, 0.06, 0, 1}}};
    rg_record_settle(&record);
    assert_int_equal(rg_record_calm_launches(&record), 1);
    assert_equals(record.frame_ms.median, 10);
    assert_int_equal(rg_record_disturbed(&record), 1);
    record.launches[2].stolen = 0.05;
    rg_record_settle(&record);
    assert_int_equal(rg_record_calm_launches(&record), 2);
    assert_near(record.frame_ms.median, 20, 1e-12);
    assert_near(record.frame_ms.low, 20, 1e-12);
    assert_near(record.frame_ms.high, 20, 1e-12);
    assert_int_equal(rg_record_disturbed(&record), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_have_marks),
        cmocka_unit_test(disturbances_are_counted),
        cmocka_unit_test(a_cell_is_whole_or_not),
        cmocka_unit_test(machines_drift),
        cmocka_unit_test(printed_rates_are_ranges),
        cmocka_unit_test(other_work_is_told_by_its_particles),
        cmocka_unit_test(a_row_is_named_by_its_values),
        cmocka_unit_test(tallies_are_named),
        cmocka_unit_test(an_end_has_its_reason),
        cmocka_unit_test(all_numbers_are_settled),
        cmocka_unit_test(launches_replace_samples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
