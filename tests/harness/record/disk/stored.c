// Results on disk are read back as they were written.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/record/disk/stored.h"
#include "harness/record/passport/passport.h"
#include "harness/tables/print.h"
#include "tests/harness/record/made.h"
#include "tests/tools/expect.h"

// Each record is the same to the last bit, except for fields that a file does not hold.
static void assert_same_records(const struct rg_result *a, const struct rg_result *b)
{
    for (struct rg_place at = rg_result_start(a); rg_result_next(a, &at);) {
        const struct rg_record *x = rg_result_at(a, at), *y = rg_result_at(b, at);
        assert_string_equal(x->set, y->set);
        assert_string_equal(x->work, y->work);
        assert_string_equal(x->device.driver, y->device.driver);
        assert_memory_equal(x->row, y->row, sizeof(x->row));
        assert_memory_equal(x->published, y->published, sizeof(x->published));
        assert_memory_equal(x->facts, y->facts, sizeof(x->facts));
        assert_memory_equal(x->counters, y->counters, sizeof(x->counters));
        assert_int_equal(x->counted_count, y->counted_count);
        assert_memory_equal(x->counted, y->counted, sizeof(x->counted));
        assert_int_equal(x->has_tally, y->has_tally);
        assert_true(!x->has_tally || !memcmp(&x->tally, &y->tally, sizeof(x->tally)));
        assert_memory_equal(x->passes, y->passes, sizeof(x->passes));
        assert_memory_equal(x->samples_ms, y->samples_ms, sizeof(x->samples_ms));
        assert_memory_equal(&x->frame_ms, &y->frame_ms, sizeof(x->frame_ms));
        assert_equals(x->create_ms, y->create_ms);
        assert_equals(x->api_over_wall, y->api_over_wall);
        assert_equals(x->calibration_begin_ms, y->calibration_begin_ms);
        assert_equals(x->calibration_end_ms, y->calibration_end_ms);
        assert_equals(x->truth_error.flip_mask_mean, y->truth_error.flip_mask_mean);
        assert_int_equal(x->outcome, y->outcome);
        assert_string_equal(x->detail, y->detail);
    }
}

static void test_round_trip(void **state)
{
    (void)state;
    char why[RG_WHY_SIZE];
    struct rg_result made = make_result(), found = {0};
    char *text = print_result(&made, RG_RESULT_JSON);
    json_t *document = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
    if (!rg_result_from_json(document, "file", &found, why))
        fail_msg("%s", why);
    assert_false(rg_result_has(&found, 2));
    assert_same_records(&made, &found);
    assert_prints_same(&made, &found);
    json_decref(document);
    free(text);
    rg_result_free(&made);
    rg_result_free(&found);
}

// A budget's choices are read back. A row that the budget left out is not missing; another row
// without a record is.
static void test_budget(void **state)
{
    (void)state;
    char why[RG_WHY_SIZE];
    struct rg_result made = make_result(), found = {0};
    made.budget_s = 240;
    made.size_divisor = 4;
    made.few_samples = true;
    assert_false(rg_result_is_of_print(&made, 0));
    assert_int_equal(rg_result_first_missing(&made), 2);
    made.left_out[1] = true;
    assert_int_equal(rg_result_first_missing(&made), 4);
    json_t *document = rg_result_json(&made);
    assert_false(json_boolean_value(json_object_get(document, "interrupted")));
    if (!rg_result_from_json(document, "file", &found, why))
        fail_msg("%s", why);
    assert_equals(found.budget_s, 240);
    assert_equals(found.size_divisor, 4);
    assert_true(found.few_samples);
    assert_true(!found.left_out[0] && found.left_out[1] && !found.left_out[2]);
    assert_same_records(&made, &found);
    assert_prints_same(&made, &found);
    // Rows that are kept keep their marks.
    assert_true(rg_result_keep_rows(&found, 2, 3));
    assert_true(found.left_out[0] && !found.left_out[1]);
    rg_result_free(&found);
    json_array_append_new(json_object_get(json_object_get(document, "budget"), "left_out"),
                          json_integer(99));
    assert_false(rg_result_from_json(document, "file", &found, why));
    assert_non_null(strstr(why, "left_out"));
    json_decref(document);
    rg_result_free(&made);
    rg_result_free(&found);
}

// Quick mode's choice of rows is read back, too.
static void test_quick_choice(void **state)
{
    (void)state;
    char why[RG_WHY_SIZE];
    struct rg_result made = make_result(), found = {0};
    made.full = false;
    made.left_out[1] = true;
    json_t *document = rg_result_json(&made);
    if (!rg_result_from_json(document, "file", &found, why))
        fail_msg("%s", why);
    assert_true(!found.left_out[0] && found.left_out[1] && !found.left_out[2]);
    assert_int_equal(rg_result_first_missing(&found), 4);
    rg_result_free(&found);
    json_array_append_new(json_object_get(document, "left_out"), json_integer(99));
    assert_false(rg_result_from_json(document, "file", &found, why));
    assert_non_null(strstr(why, "left_out"));
    json_decref(document);
    rg_result_free(&made);
    rg_result_free(&found);
}

// --- every field ---

#define assert_same(a, b, field)      assert_equals((a)->field, (b)->field)
#define assert_same_text(a, b, field) assert_string_equal((a)->field, (b)->field)
#define assert_same_bytes(a, b, field)                                                             \
    assert_memory_equal((a)->field, (b)->field, sizeof((a)->field))

static void assert_same_heads(const struct rg_result *a, const struct rg_result *b)
{
    assert_same_text(a, b, table);
    assert_same_text(a, b, technique);
    assert_same_text(a, b, hardware);
    assert_same_text(a, b, truth);
    assert_same_text(a, b, quick);
    assert_same_text(a, b, changed);
    assert_same_text(a, b, note);
    assert_same(a, b, full);
    assert_same(a, b, is_of_textures);
    assert_same(a, b, width);
    assert_same(a, b, height);
    assert_same(a, b, check_frames);
    assert_same(a, b, first_row);
    assert_same(a, b, last_row);
    assert_same(a, b, resumed_rows);
    assert_same(a, b, work_count);
    assert_same_bytes(a, b, works);
    assert_same(a, b, variant_count);
    assert_same_bytes(a, b, variants);
    assert_same(a, b, missing_count);
    assert_same_bytes(a, b, missing);
    assert_same(a, b, device_count);
    assert_true(json_equal(a->passport, b->passport));
}

static void assert_same_devices(const struct rg_device_info *a, const struct rg_device_info *b)
{
    assert_same_text(a, b, name);
    assert_same_text(a, b, full);
    assert_same_text(a, b, api);
    assert_same_text(a, b, device);
    assert_same_text(a, b, driver);
    assert_same(a, b, software);
    assert_same_bytes(a, b, libraries);
}

// What a file holds of a record besides what assert_same_records looks at.
static void assert_same_rest(const struct rg_record *a, const struct rg_record *b)
{
    assert_same_text(a, b, technique);
    assert_same_text(a, b, variant);
    assert_same(a, b, row_count);
    assert_same(a, b, published_count);
    assert_same(a, b, fact_count);
    assert_same(a, b, counter_count);
    assert_same(a, b, first_frame_ms);
    assert_same(a, b, frames_a_sample);
    assert_same(a, b, sample_count);
    assert_same(a, b, wanted_samples);
    assert_same(a, b, is_watched);
    assert_same_bytes(a, b, taken);
    assert_same(a, b, retaken);
    assert_same(a, b, launch_count);
    assert_same(a, b, pass_frames);
    assert_same(a, b, pass_count);
    for (int i = 0; i < a->launch_count; i++) {
        assert_same(a, b, launches[i].number);
        assert_same(a, b, launches[i].ms);
        assert_same(a, b, launches[i].stolen);
        assert_same(a, b, launches[i].others);
        assert_same(a, b, launches[i].seconds);
    }
    assert_same(a, b, truth_error.outcome);
    assert_same_text(a, b, truth_error.detail);
    assert_same(a, b, truth_error.flip_mean);
    assert_same(a, b, truth_error.max_codes);
    assert_same_devices(&a->device, &b->device);
}

// Every field of a device that a document has is another text.
static void fill_devices(struct rg_result *result)
{
    const struct rg_device_info *infos[2] = {&result->devices[0], &result->devices[1]};
    for (int d = 0; d < 2; d++) {
        struct rg_device_info *info = &result->devices[d];
        snprintf(info->full, sizeof(info->full), "%s@X=%d", d ? "gl" : "cpu:reference", d);
        snprintf(info->api, sizeof(info->api), "API %d", d);
        snprintf(info->device, sizeof(info->device), "a device, %d", d);
        info->software = d == 1;
        for (int i = 0; i <= d; i++) {
            snprintf(info->libraries[i].path, sizeof(info->libraries[i].path), "%d.so", i);
            snprintf(info->libraries[i].build, sizeof(info->libraries[i].build), "%d%d", d, i);
        }
    }
    json_object_set_new(result->passport, "devices", rg_passport_devices(infos, 2));
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);)
        rg_result_at(result, at)->device = result->devices[at.device];
}

// Gives a measured cell numbers that are all different.
static void fill_measured(struct rg_record *record)
{
    record->wanted_samples = record->sample_count;
    record->first_frame_ms = 29;
    record->frames_a_sample = 4;
    record->retaken = record->is_watched ? 5 : 0;
    record->pass_frames = 6;
    record->truth_error.flip_mean = 0.25;
    record->truth_error.max_codes = 77;
    record->launch_count = 2;
    record->launches[0] = (struct rg_launch){2, 20.5, 0.01, 0.02, 3.5};
    record->launches[1] = (struct rg_launch){5, 21.5, 0.03, 0.04, 4.5};
    record->has_tally = true;
    record->tally = (struct rg_tally){11, 12, 13, 14, 15, 16, 17, 18, 19, 20};
}

// A result in which something stands in every field, and no two of a kind are the same.
static struct rg_result make_filled(void)
{
    struct rg_result result = make_result();
    static const enum rg_outcome ends[] = {RG_LACKING, RG_SETUP, RG_UNSUPPORTED, RG_TIMEOUT};
    int cell = 0;
    snprintf(result.changed, sizeof(result.changed), "drops=1");
    snprintf(result.works[1].reading, sizeof(result.works[1].reading), "as one can read it");
    snprintf(result.missing[result.missing_count++], sizeof(result.missing[0]), "opencl: none");
    result.resumed_rows = 2;
    result.check_frames = 7;
    result.full = true;
    fill_devices(&result);
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at); cell++) {
        struct rg_record *record = rg_result_at(&result, at);
        if (record->outcome == RG_OK)
            fill_measured(record);
        if (cell >= 4 && cell < 8) {
            rg_record_end(record, ends[cell - 4], "it ended");
            record->sample_count = record->launch_count = record->pass_count = 0;
        }
        if (cell >= 8 && cell < 12)
            record->truth_error =
                (struct rg_truth_error){.outcome = ends[cell - 8], .detail = "why"};
    }
    return result;
}

static void test_each_field(void **state)
{
    (void)state;
    char why[RG_WHY_SIZE];
    struct rg_result made = make_filled(), found = {0};
    const struct rg_place begun = {.row = 3, .work = 1}, first = {.row = 1};
    rg_result_at(&made, begun)->wanted_samples = 9; // of which it has 7, and no run by pass
    rg_result_at(&made, begun)->pass_frames = 0;
    json_t *document = rg_result_json(&made);
    if (!rg_result_from_json(document, "file", &found, why))
        fail_msg("%s", why);
    assert_same_heads(&made, &found);
    for (int d = 0; d < 2; d++)
        assert_same_devices(&made.devices[d], &found.devices[d]);
    for (struct rg_place at = rg_result_start(&made); rg_result_next(&made, &at);) {
        const struct rg_record *a = rg_result_at(&made, at), *b = rg_result_at(&found, at);
        assert_int_equal(a->outcome, b->outcome);
        assert_string_equal(a->detail, b->detail);
        if (a->outcome == RG_OK) {
            assert_same_rest(a, b);
            assert_memory_equal(&a->tally, &b->tally, sizeof(a->tally));
        }
    }
    assert_string_equal(rg_result_at(&found, first)->device.full, "cpu:reference@X=0");
    json_decref(document);
    rg_result_free(&made);
    rg_result_free(&found);
}

// Of textures nothing is timed, and a table without works or print says so.
static void test_bare(void **state)
{
    (void)state;
    char why[RG_WHY_SIZE];
    struct rg_result made = make_result(), found = {0};
    const struct rg_place last = {.row = 3, .variant = 1};
    made.is_of_textures = true;
    made.work_count = made.missing_count = 0;
    *made.hardware = *made.truth = *made.quick = *made.note = 0;
    json_t *document = rg_result_json(&made);
    assert_true(json_is_null(json_object_get(document, "hardware")));
    assert_null(json_object_get(document, "works"));
    if (!rg_result_from_json(document, "file", &found, why))
        fail_msg("%s", why);
    assert_true(found.is_of_textures && !found.work_count && !found.missing_count);
    assert_true(!*found.hardware && !*found.truth && !*found.quick && !*found.note);
    assert_int_equal(rg_result_at(&found, last)->sample_count, 0);
    assert_string_equal(rg_result_at(&found, last)->set, "a=3 b=2");
    json_decref(document);
    rg_result_free(&made);
    rg_result_free(&found);
}

// What a document derives from samples and passes, by hand.
static void test_derived(void **state)
{
    (void)state;
    struct rg_result made = make_result();
    struct rg_record *record = rg_result_at(&made, (struct rg_place){.row = 1});
    double fps, ms, low, high, noise, move, light;
    int disturbed, retaken, wanted;
    record->sample_count = 6;
    for (int i = 0; i < 6; i++) {
        record->samples_ms[i] = 15 - i;
        record->taken[i] = i < 2 ? 0.06 : 0.05;
    }
    record->wanted_samples = 18;
    record->passes[0].ms = 1;
    record->passes[1].ms = 3;
    rg_record_settle(record);
    json_t *document = rg_result_json(&made);
    json_t *measured =
        json_object_get(json_array_get(json_object_get(document, "cells"), 0), "measured");
    assert_int_equal(json_unpack(measured, "{sF sF sF sF sF si si si s{sF sF}}", "fps", &fps, "ms",
                                 &ms, "ms_low", &low, "ms_high", &high, "noise", &noise,
                                 "disturbed", &disturbed, "retaken", &retaken, "samples_wanted",
                                 &wanted, "passes_share", "flow_move", &move, "flow_light", &light),
                     0);
    assert_equals(ms, 12.5);
    assert_equals(fps, 80);
    assert_equals(low, 10); // six samples: the interval is all of them
    assert_equals(high, 15);
    assert_below(fabs((1 + noise) * (1 + noise) - 1.5), 1e-12);
    assert_true(disturbed == 2 && retaken == 3 && wanted == 18);
    assert_true(move == 0.25 && light == 0.75);
    json_decref(document);
    made.left_out[1] = true; // so that the last row alone is missing
    rg_result_drop_row(&made, 3);
    document = rg_result_json(&made);
    assert_true(json_is_true(json_object_get(document, "interrupted")));
    json_decref(document);
    rg_result_free(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),   cmocka_unit_test(test_budget),
        cmocka_unit_test(test_quick_choice), cmocka_unit_test(test_each_field),
        cmocka_unit_test(test_bare),         cmocka_unit_test(test_derived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
