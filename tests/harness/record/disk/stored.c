// Results on disk are read back as they were written. A file that is no result is refused in one
// line that says where.
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

// --- refusals ---

static json_t *document_of_test(void)
{
    struct rg_result made = make_result();
    json_t *document = rg_result_json(&made);
    rg_result_free(&made);
    return document;
}

// The object or array that holds the last name of a path such as "cells.3.status".
static json_t *holder_of(json_t *document, const char *path, const char **last)
{
    json_t *at = document;
    static char copy[128];
    snprintf(copy, sizeof(copy), "%s", path);
    char *rest = NULL, *name = strtok_r(copy, ".", &rest);
    for (char *next; (next = strtok_r(NULL, ".", &rest)); name = next)
        at = json_is_array(at) ? json_array_get(at, (size_t)atoi(name)) : json_object_get(at, name);
    *last = name;
    return at;
}

static void expect_refusal(const char *path, json_t *value, const char *says)
{
    char why[RG_WHY_SIZE];
    const char *last;
    struct rg_result result = {0};
    json_t *document = document_of_test(), *holder = holder_of(document, path, &last);
    assert_non_null(json_is_object(holder) ? json_object_get(holder, last)
                                           : json_array_get(holder, (size_t)atoi(last)));
    if (json_is_array(holder))
        json_array_set_new(holder, (size_t)atoi(last), value);
    else if (value)
        json_object_set_new(holder, last, value);
    else
        json_object_del(holder, last);
    if (rg_result_from_json(document, "f", &result, why) || !strstr(why, says))
        fail_msg("%s: '%s' instead of '%s'", path, why, says);
    json_decref(document);
}

static void test_refusals(void **state)
{
    (void)state;
    expect_refusal("format", json_integer(2), "f: format is 2, and this raingauge reads 1; ");
    expect_refusal("format", json_string("1"), "f: format is no whole number");
    expect_refusal("table", NULL, "f: is no table's result; ");
    expect_refusal("table", json_string("../x"), "f: table is no name");
    expect_refusal("rows", json_pack("[ii]", 4, 2), "f: rows is no range");
    expect_refusal("rows", json_pack("[iii]", 1, 2, 3), "f: rows is no pair");
    expect_refusal("variants", json_array(), "f: variants has not 1 to 10 elements");
    expect_refusal("passport.devices.1.name", json_integer(1),
                   "f: passport.devices[1].name is no text");
    expect_refusal("passport.devices.0.software", json_null(),
                   "f: passport.devices[0].software is neither true nor false");
    expect_refusal("works.1.saves", NULL, "f: works[1].saves is missing");
    expect_refusal("cells.3.status", json_string("good"), "f: cells[3].status is no outcome");
    expect_refusal("cells.3.detail", NULL, "f: cells[3].detail is missing");
    expect_refusal("cells.3.device", json_string("vulkan"), "f: cells[3].device is 'vulkan'");
    expect_refusal("cells.1.row_number", json_integer(5), "f: cells[1].row_number is no whole");
    expect_refusal("cells.1.row_number", json_integer(3), "f: cells[");
    expect_refusal("cells.0.device", json_string("gl"), "f: cells[1] stands there twice");
    expect_refusal("cells.0.measured.samples_ms.2", json_real(-1),
                   "f: cells[0].measured.samples_ms has an element");
    expect_refusal("cells.0.measured.samples_ms.6", json_integer(0),
                   "f: cells[0].measured.samples_ms has an element that is no number above 0");
    expect_refusal("cells.0.measured.passes_ms.flow_move", json_string("x"),
                   "f: cells[0].measured.passes_ms has 'flow_move'");
    expect_refusal("cells.0.counters.drops", json_real(1.5), "f: cells[0].counters has 'drops'");
    expect_refusal("cells.0.tally.runs", json_integer(-1), "f: cells[0].tally.runs is no whole");
    expect_refusal("cells.0.tally.items", NULL, "f: cells[0].tally.items is missing");
    expect_refusal("cells.0.tally", NULL, "f: cells[0].tally is missing");
    expect_refusal("cells.0.error.max", json_integer(256), "f: cells[0].error.max is no whole");
    expect_refusal("cells.0.set", json_array(), "f: cells[0].set is no text");
}

// Numbers have bounds, and names and words are among those that are known.
static void test_bounds(void **state)
{
    (void)state;
    expect_refusal("size_px", json_pack("[ii]", 640, 0),
                   "f: size_px is no pair of whole numbers "
                   "from 1 to 1048576");
    expect_refusal("size_px", json_pack("[ii]", 1 << 21, 480), "f: size_px is no pair");
    expect_refusal("size_px", json_pack("[ii]", 640, 1 << 21), "f: size_px is no pair");
    expect_refusal("rows", json_pack("[ii]", 2, 258), "f: rows is no range of 1 to 256 rows; ");
    expect_refusal("length", json_string("long"), "f: length is neither quick nor full");
    expect_refusal("check_frames", json_integer(0), "f: check_frames is no whole number from 1 on");
    expect_refusal("resumed_rows", json_integer(257),
                   "f: resumed_rows is no whole number from 0 "
                   "to 256");
    expect_refusal("works.0.name", json_null(), "f: works[0].name is no text");
    expect_refusal("missing.0", json_integer(1), "f: missing has an element that is no line");
    expect_refusal("cells.0.variant", json_string("none"),
                   "f: cells[0].variant is 'none', which "
                   "'variants' does not name");
    expect_refusal("cells.0.work", json_string("none"),
                   "f: cells[0].work is 'none', which 'works' "
                   "does not name");
    expect_refusal("cells.0.row_number", json_integer(1),
                   "f: cells[0].row_number is no whole "
                   "number from 2 to 4");
    expect_refusal("cells.15", json_null(), "f: cells[15].row_number is missing");
    expect_refusal("cells.0.measured.taken.1", json_real(1.01),
                   "f: cells[0].measured.taken has an element that is no number from 0 to 1");
    expect_refusal("cells.0.measured.taken", json_pack("[f]", 0.5),
                   "f: cells[0].measured.taken has not a number for each sample");
    expect_refusal("cells.0.measured.pass_frames", json_integer(0),
                   "f: cells[0].measured.pass_frames is no whole number from 1 on");
    expect_refusal("cells.0.measured.create_ms", json_real(-0.5),
                   "f: cells[0].measured.create_ms is no number from 0 on");
    expect_refusal("cells.0.error.status", json_string("?"),
                   "f: cells[0].error.status is no "
                   "outcome");
}

// Names and texts fit where they are kept, and lists have room for so many.
static void test_limits(void **state)
{
    (void)state;
    char text[201];
    memset(text, 'x', 200);
    text[200] = 0;
    expect_refusal("cells.3.detail", json_string(text),
                   "f: cells[3].detail is no text of less than "
                   "200 bytes");
    text[48] = 0;
    expect_refusal("technique", json_string(text), "f: technique is no text of less than 48 bytes");
    expect_refusal("variants.1", json_string(text), "f: variants has an element that is no short");
    expect_refusal("cells.0.facts", json_pack("{si}", text, 1),
                   "f: cells[0].facts has a field whose name has not 1 to 47 bytes");
    expect_refusal("cells.0.facts", json_pack("{ss}", "model", ""),
                   "f: cells[0].facts has 'model', which is of another kind");
    json_t *row = json_object(), *works = json_array();
    for (int i = 0; i < 11; i++) {
        char name[8];
        snprintf(name, sizeof(name), "k%d", i);
        json_object_set_new(row, name, json_integer(i));
    }
    expect_refusal("cells.0.row", row, "f: cells[0].row has more than 10 fields");
    for (int i = 0; i < 5; i++)
        json_array_append_new(works, json_pack("{ss ss}", "name", "a", "saves", ""));
    expect_refusal("works", works, "f: works has not 1 to 4 elements");
}

// Launches have rising numbers, each with a time above 0 and three numbers that are not negative.
static void test_launches(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "[[0, 2, 0, 0, 1]]",                  // numbers count from 1
        "[[1, 2, 0, 0, 1], [1, 2, 0, 0, 1]]", // and rise
        "[[1, 0, 0, 0, 1]]",                  // no time
        "[[1, 2, -0.1, 0, 1]]",               // a negative share
        "[[1, 2, 0, -0.1, 1]]",
        "[[1, 2, 0, 0, -1]]",
        "[[1, 2, 0, 0]]",
        "[[1, 2, 0, 0, 1, 1]]",
        "[[1.5, 2, 0, 0, 1]]",
        "[[1, 2, 0, 0, \"1\"]]",
        "[]",
    };
    char why[RG_WHY_SIZE];
    for (size_t i = 0; i <= sizeof(wrong) / sizeof(wrong[0]); i++) {
        const bool is_right = i == sizeof(wrong) / sizeof(wrong[0]);
        struct rg_result result = {0};
        json_t *document = document_of_test();
        json_t *cell = json_array_get(json_object_get(document, "cells"), 0);
        json_t *launches =
            json_loads(is_right ? "[[1, 2, 0, 0, 0], [4, 3, 0.5, 1, 9]]" : wrong[i], 0, NULL);
        json_object_set_new(json_object_get(cell, "measured"), "launches", launches);
        assert_int_equal(rg_result_from_json(document, "f", &result, why), is_right);
        assert_true(is_right || strstr(why, "f: cells[0].measured.launches has "));
        json_decref(document);
        rg_result_free(&result);
    }
}

static char path[64];

static void write_text(const char *text, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    fclose(file);
}

static void count_lines(enum rg_log_level level, const char *line, void *count)
{
    (void)level;
    if (strncmp(line, "raingauge: ", 11) == 0 || strstr(line, path))
        ++*(int *)count;
}

// Whether a file is taken; if not, one line names it.
static bool read_path(int expected_results)
{
    struct rg_stored stored = {0};
    int lines = 0;
    rg_log_listen(count_lines, &lines);
    const bool ok = rg_stored_read(&stored, path);
    rg_log_listen(NULL, NULL);
    assert_int_equal(lines, !ok);
    assert_true(!ok || !expected_results || stored.count == expected_results);
    rg_stored_free(&stored);
    return ok;
}

// A file may hold several results, one after the other. A file that is no result, or is missing, is
// reported.
static void test_files(void **state)
{
    (void)state;
    struct rg_result made = make_result();
    char *text = print_result(&made, RG_RESULT_JSON), twice[65536];
    snprintf(twice, sizeof(twice), "%s\n%s\n", text, text);
    write_text(twice, strlen(twice));
    assert_true(read_path(2));
    snprintf(twice, sizeof(twice), "%s\nand more", text);
    write_text(twice, strlen(twice));
    assert_false(read_path(0));
    write_text("", 0);
    assert_false(read_path(0));
    write_text("{\"format\": 1, \"pairs\": []}", 26);
    assert_false(read_path(0));
    unlink(path);
    assert_false(read_path(0));
    free(text);
    rg_result_free(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),   cmocka_unit_test(test_budget),
        cmocka_unit_test(test_quick_choice), cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_bounds),       cmocka_unit_test(test_each_field),
        cmocka_unit_test(test_bare),         cmocka_unit_test(test_limits),
        cmocka_unit_test(test_derived),      cmocka_unit_test(test_launches),
        cmocka_unit_test(test_files),
    };
    snprintf(path, sizeof(path), "/tmp/raingauge-test-stored-%d.json", (int)getpid());
    return cmocka_run_group_tests(tests, NULL, NULL);
}
