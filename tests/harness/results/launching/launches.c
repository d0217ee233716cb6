// The launches that claims need, and how stored ones compare with figures of today, from records
// alone.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/tables/claims/outcomes.h"
#include "harness/tables/launching/launches.h"
#include "harness/tables/papers/papers.h"
#include "tests/tools/expect.h"

// A table on devices, with the cells that claims need and launches that all take `ms`.
static void make_on(struct rg_result *result, const char *id, int count, int launches, double ms)
{
    static struct rg_device cpu = {.info = {.name = "cpu"}}, gl = {.info = {.name = "gl"}};
    const struct rg_devices devices = {.count = count, .devices = {&cpu, &gl}};
    const struct rg_table *table = rg_table_find(id);
    const struct rg_table_part part = {
        .last_row = table->row_count - 1, .full = true, .work = table->works[0].name};
    uint32_t x = 1;
    *result = (struct rg_result){0};
    rg_table_begin(result, table, &part, &devices);
    assert_true(rg_launches_choose(result, table));
    for (int row = 0; row < table->row_count; row++)
        if (rg_result_wants(result, row))
            assert_true(rg_table_add_row(result, table, row));
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        struct rg_record *record = rg_result_at(result, at);
        record->sample_count = record->wanted_samples = record->pass_frames = 1;
        record->frames_a_sample = 1;
        record->samples_ms[0] = ms;
        record->launch_count = launches;
        for (int i = 0; i < launches; i++) {
            x = x * 1664525u + 1013904223u;
            record->launches[i] =
                (struct rg_launch){.number = i + 1, .ms = ms * (1 + 1e-12 * x), .seconds = 1};
        }
        rg_record_settle(record);
    }
}

static void make(struct rg_result *result, const char *id, int launches, double ms)
{
    make_on(result, id, 1, launches, ms);
}

static int next_of(const struct rg_result *result, const struct rg_claim *claims, int device,
                   struct rg_launch_cells *cells)
{
    const struct rg_launches_wanted wanted = {.claims = claims};
    return rg_launches_next(result, &wanted, device, cells);
}

static bool are_due(const struct rg_result *result)
{
    const struct rg_launches_wanted wanted = {.claims = rg_claims};
    return rg_launches_are_due(result, &wanted);
}

// Another machine's.
static void make_there(struct rg_result *result, const char *id, int launches, double ms)
{
    make(result, id, launches, ms);
    json_object_set_new(json_object_get(result->passport, "machine"), "cpu",
                        json_string("CPU there"));
}

static void rows_and_variants_that_claims_need(void **state)
{
    (void)state;
    struct rg_result result;
    make(&result, "ye-1", 0, 1);
    assert_int_equal(result.variant_count, 8); // neither the layers nor the city
    assert_string_equal(result.variants[0], "traditional");
    assert_string_equal(result.variants[6], "promotion");
    assert_string_equal(result.variants[7], "improved");
    rg_result_free(&result);
    make(&result, "feng-2", 0, 1);
    assert_int_equal(rg_result_wants(&result, 4), true);
    assert_int_equal(rg_result_wants(&result, 5), false); // only the car's rows
    rg_result_free(&result);
    const struct rg_table *raster = rg_table_find("raster-1");
    const struct rg_devices none = {0};
    result = (struct rg_result){0};
    rg_table_begin(&result, raster, &(struct rg_table_part){.last_row = 3}, &none);
    assert_false(rg_launches_choose(&result, raster)); // nobody claims anything of it
    assert_int_equal(result.variant_count, 0);
    rg_result_free(&result);
}

static int size_of_group(const struct rg_launch_cells *cells, int group)
{
    int size = 0;
    for (int i = 0; i < cells->count; i++)
        size += cells->cells[i].group == group;
    return size;
}

// Cells that a claim compares are open together; others are not.
static void groups(void **state)
{
    (void)state;
    struct rg_launch_cells cells;
    struct rg_result result;
    make(&result, "ye-1", 0, 1);
    assert_int_equal(next_of(&result, rg_claims, 0, &cells), 1);
    assert_int_equal(cells.count, 5 * 8);
    assert_int_equal(cells.group_count, 2 * 5); // each row: with the heap, and the rest
    rg_result_free(&result);
    make(&result, "creus-5.3", 0, 1);
    assert_int_equal(next_of(&result, rg_claims, 0, &cells), 1);
    assert_int_equal(cells.count, 18);
    assert_int_equal(cells.group_count, 2); // one a camera
    assert_int_equal(size_of_group(&cells, 0), 9);
    rg_result_free(&result);
}

#define OF(test_, first_, last_)                                                                   \
    {                                                                                              \
        .table = "creus-5.6", .variant = "full", .test = test_, .first = first_, .last = last_,    \
        .knee = 2, .least = 1, .most = 2                                                           \
    }
#define BOTH(test_, last_)                                                                         \
    {                                                                                              \
        .table = "creus-5.6", .variant = "full", .other = "no_geometry", .test = test_,            \
        .first = 1, .last = last_, .knee = 2, .least = 1                                           \
    }

// Rows that a claim compares are one group, and so are the variants of a row; groups with a cell in
// common are one.
static void cells_of_tests(void **state)
{
    (void)state;
    static const struct {
        struct rg_claim claims[4];
        int cells, groups;
    } cases[] = {
        {{OF(RG_CLAIM_FALLS, 1, 4)}, 4, 1},
        {{OF(RG_CLAIM_RATIO, 1, 4)}, 2, 1},
        {{OF(RG_CLAIM_RATIO, 4, 2)}, 2, 1},
        {{OF(RG_CLAIM_SLOWEST, 2, 4)}, 3, 1},
        {{OF(RG_CLAIM_RATE, 2, 5)}, 4, 4},
        {{BOTH(RG_CLAIM_FASTER, 3)}, 6, 3},
        {{BOTH(RG_CLAIM_CROSSES, 5)}, 10, 5},
        {{OF(RG_CLAIM_FALLS, 1, 2), OF(RG_CLAIM_FALLS, 4, 5)}, 4, 2},
        {{OF(RG_CLAIM_FALLS, 1, 3), OF(RG_CLAIM_FALLS, 3, 5)}, 5, 1},
        {{OF(RG_CLAIM_FALLS, 1, 2), OF(RG_CLAIM_FALLS, 3, 4), OF(RG_CLAIM_RATIO, 2, 3)}, 4, 1},
        {{OF(RG_CLAIM_FALLS, 1, 2), BOTH(RG_CLAIM_FASTER, 1)}, 3, 1}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_launch_cells cells;
        struct rg_result result;
        make(&result, "creus-5.6", 0, 10);
        assert_int_equal(next_of(&result, cases[i].claims, 0, &cells), 1);
        assert_int_equal(cells.count, cases[i].cells);
        assert_int_equal(cells.group_count, cases[i].groups);
        for (int c = 0; c < cells.count; c++)
            assert_between(cells.cells[c].group, 0, cells.group_count - 1);
        rg_result_free(&result);
    }
}

// A decided claim gets no more launches; otherwise the launches' numbers go on.
static void a_course_ends(void **state)
{
    (void)state;
    struct rg_launch_cells cells;
    struct rg_result result;
    make(&result, "chin-timing", 11, 10); // 100 frames a second
    assert_int_equal(next_of(&result, rg_claims, 0, &cells), 12);
    assert_true(are_due(&result));
    rg_result_free(&result);
    make(&result, "chin-timing", 192, 10);
    assert_int_equal(next_of(&result, rg_claims, 0, &cells), 0);
    assert_false(are_due(&result));
    // If most launches are disturbed, the course ends after 33 of them.
    struct rg_record *record = rg_result_at(&result, rg_result_start(&result));
    record = rg_result_at(&result, (struct rg_place){.row = 0});
    record->launch_count = 33;
    for (int i = 0; i < 33; i++)
        record->launches[i].others = 1;
    assert_int_equal(next_of(&result, rg_claims, 0, &cells), 0);
    record->launch_count = 32;
    assert_int_equal(next_of(&result, rg_claims, 0, &cells), 33);
    // Three quarters of them are not yet most.
    record->launch_count = 44;
    for (int i = 0; i < 44; i++)
        record->launches[i].others = i < 33;
    assert_int_equal(next_of(&result, rg_claims, 0, &cells), 45);
    record->launch_count = 45;
    record->launches[44].others = 1;
    assert_int_equal(next_of(&result, rg_claims, 0, &cells), 0);
    rg_result_free(&result);
}

// A limit ends it before a look.
static void no_more_launches_than_allowed(void **state)
{
    (void)state;
    const struct rg_launches_wanted wanted = {.claims = rg_claims, .most = 6};
    struct rg_launch_cells cells;
    struct rg_result result;
    for (int launches = 5; launches <= 6; launches++) {
        make(&result, "creus-5.3", launches, 10);
        assert_int_equal(rg_launches_next(&result, &wanted, 0, &cells), launches < 6 ? 6 : 0);
        rg_result_free(&result);
    }
    make(&result, "creus-5.3", 6, 10); // a disturbed launch does not count
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);)
        rg_result_at(&result, at)->launches[2].others = 1;
    assert_int_equal(rg_launches_next(&result, &wanted, 0, &cells), 7);
    rg_result_free(&result);
}

// Each device has its own course, with its own numbers.
static void devices_have_their_own_courses(void **state)
{
    (void)state;
    struct rg_launch_cells cells;
    struct rg_result result;
    make_on(&result, "chin-timing", 2, 24, 10);
    struct rg_record *gl = rg_result_at(&result, (struct rg_place){.device = 1});
    gl->launch_count = 5;
    assert_int_equal(next_of(&result, rg_claims, 0, &cells), 0);
    assert_int_equal(next_of(&result, rg_claims, 1, &cells), 6);
    assert_int_equal(cells.count, 1);
    assert_int_equal(cells.cells[0].at.device, 1);
    assert_true(are_due(&result));
    gl->launch_count = 24;
    assert_false(are_due(&result));
    rg_result_free(&result);
}

// Stored launches give the verdict. Today's figures agree with it, even near the bound, or differ,
// or are missing.
static void kept_launches_beside_today(void **state)
{
    (void)state;
    static const struct {
        double ms;
        enum rg_claim_agreement agreement;
    } cases[] = {{10, RG_AGREEMENT_AGREES}, {33, RG_AGREEMENT_AGREES}, {50, RG_AGREEMENT_DIFFERS}};
    const struct rg_claims_shown shown = {.variant = NULL};
    struct rg_result kept, today;
    make(&kept, "chin-timing", 192, 10);
    const struct rg_stored stored = {.count = 1, .results = &kept};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_claim_outcomes outcomes = {0};
        make(&today, "chin-timing", 0, cases[i].ms);
        assert_true(rg_claims_add(&outcomes, &today, &stored, &shown));
        assert_int_equal(outcomes.outcomes[0].judgement.verdict, RG_CLAIM_REPRODUCED);
        assert_true(outcomes.outcomes[0].is_kept);
        assert_int_equal(outcomes.outcomes[0].agreement, cases[i].agreement);
        rg_claims_free(&outcomes);
        rg_result_free(&today);
    }
    struct rg_claim_outcomes outcomes = {0};
    make(&today, "chin-timing", 0, 10);
    rg_result_drop_row(&today, 0);
    assert_true(rg_claims_add(&outcomes, &today, &stored, &shown));
    assert_int_equal(outcomes.outcomes[0].agreement, RG_AGREEMENT_NOT_SEEN);
    rg_claims_free(&outcomes);
    rg_result_free(&today);
    // A result with its own launches is judged by these.
    outcomes = (struct rg_claim_outcomes){0};
    make(&today, "chin-timing", 192, 50);
    assert_true(rg_claims_add(&outcomes, &today, &stored, &shown));
    assert_int_equal(outcomes.outcomes[0].judgement.verdict, RG_CLAIM_NOT_REPRODUCED);
    assert_false(outcomes.outcomes[0].is_kept);
    rg_claims_free(&outcomes);
    rg_result_free(&today);
    rg_result_free(&kept);
}

// The verdict of stored launches on a result of today, whose frames take `ms`.
static struct rg_claim_outcome with_kept(struct rg_result *kept, int count, double ms)
{
    const struct rg_stored stored = {.count = count, .results = kept};
    struct rg_claim_outcomes outcomes = {0};
    struct rg_result today;
    make(&today, "chin-timing", 0, ms);
    assert_true(rg_claims_add(&outcomes, &today, &stored, &(struct rg_claims_shown){0}));
    const struct rg_claim_outcome outcome = outcomes.outcomes[0];
    rg_claims_free(&outcomes);
    rg_result_free(&today);
    return outcome;
}

// At the bound, figures must be near it as well: 33.3 ms are 30 frames a second.
static void kept_launches_at_the_bound(void **state)
{
    (void)state;
    static const struct {
        double ms;
        enum rg_claim_agreement agreement;
    } cases[] = {
        {10, RG_AGREEMENT_DIFFERS}, {33.3, RG_AGREEMENT_AGREES}, {50, RG_AGREEMENT_DIFFERS}};
    struct rg_result kept;
    make(&kept, "chin-timing", 192, 33.26); // up to 0.4 % more
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        const struct rg_claim_outcome outcome = with_kept(&kept, 1, cases[i].ms);
        assert_int_equal(outcome.judgement.verdict, RG_CLAIM_AT_BOUND);
        assert_int_equal(outcome.agreement, cases[i].agreement);
    }
    rg_result_free(&kept);
    make(&kept, "chin-timing", 192, 50);
    assert_int_equal(with_kept(&kept, 1, 50).agreement, RG_AGREEMENT_AGREES);
    assert_int_equal(with_kept(&kept, 1, 10).agreement, RG_AGREEMENT_DIFFERS);
    rg_result_free(&kept);
    make(&kept, "chin-timing", 6, 10); // they do not decide
    assert_int_equal(with_kept(&kept, 1, 10).judgement.verdict, RG_CLAIM_UNDECIDED);
    assert_int_equal(with_kept(&kept, 1, 10).agreement, RG_AGREEMENT_NONE);
    rg_result_free(&kept);
}

// The own machine's launches come before those of another one, which is named.
static void kept_launches_of_machines(void **state)
{
    (void)state;
    struct rg_result kept[3];
    make_there(&kept[0], "chin-timing", 192, 50);
    make(&kept[1], "chin-timing", 192, 10);
    make_there(&kept[2], "chin-timing", 192, 50);
    kept[1].full = false;
    for (int first = 0; first < 2; first++) {
        const struct rg_claim_outcome own = with_kept(kept + first, 2, 10);
        assert_int_equal(own.judgement.verdict, RG_CLAIM_REPRODUCED);
        assert_string_not_equal(own.machine, "CPU there");
        assert_string_equal(own.length, "quick"); // of the launches
    }
    const struct rg_claim_outcome other = with_kept(kept, 1, 10);
    assert_int_equal(other.judgement.verdict, RG_CLAIM_NOT_REPRODUCED);
    assert_true(other.is_kept);
    assert_string_equal(other.machine, "CPU there");
    for (int i = 0; i < 3; i++)
        rg_result_free(&kept[i]);
}

// Records without launches or rows, of another device or of another table give no verdict.
static void kept_records_that_tell_nothing(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        struct rg_result kept;
        make(&kept, "chin-timing", i == 0 ? 0 : 192, 10);
        if (i == 3)
            rg_result_drop_row(&kept, 0);
        if (i == 1)
            snprintf(kept.devices[0].name, sizeof(kept.devices[0].name), "gl");
        if (i == 2)
            snprintf(kept.table, sizeof(kept.table), "chin-grid");
        const struct rg_claim_outcome outcome = with_kept(&kept, 1, 10);
        assert_int_equal(outcome.judgement.verdict, RG_CLAIM_ONE_LAUNCH);
        assert_false(outcome.is_kept);
        assert_int_equal(outcome.agreement, RG_AGREEMENT_NONE);
        rg_result_free(&kept);
    }
}

// --- the claims that are shown ---

// Of table 5.3 rows 1 to 9 and 10 to 18 have two claims each, and all but the last of them one
// more.
static void claims_about_some_rows_and_variants(void **state)
{
    (void)state;
    static const struct {
        const char *table;
        struct rg_claims_shown shown;
        int count;
    } cases[] = {{"creus-5.3", {NULL, 0, 0}, 6},          {"creus-5.3", {NULL, 8, 8}, 3},
                 {"creus-5.3", {NULL, 9, 9}, 2},          {"creus-5.3", {NULL, 9, 10}, 5},
                 {"creus-5.3", {NULL, 10, 10}, 3},        {"creus-5.3", {NULL, 18, 18}, 2},
                 {"creus-5.3", {"full", 18, 18}, 2},      {"creus-5.3", {"no_geometry", 0, 0}, 0},
                 {"creus-5.6", {"no_geometry", 0, 0}, 1}, {"creus-5.6", {"full", 0, 0}, 3},
                 {"creus-5.6", {"bare", 0, 0}, 0}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_claim_outcomes outcomes = {0};
        struct rg_result result;
        make(&result, cases[i].table, 0, 10);
        assert_true(rg_claims_add(&outcomes, &result, NULL, &cases[i].shown));
        assert_int_equal(outcomes.count, cases[i].count);
        assert_int_equal(json_array_size(outcomes.tables), cases[i].count > 0);
        rg_claims_free(&outcomes);
        rg_result_free(&result);
    }
}

// A claim whose faster row stands below the slower one is about both, and those between.
static void claims_whose_rows_are_turned(void **state)
{
    (void)state;
    static const struct rg_claim turned[] = {
        {.table = "creus-5.6", .variant = "full", .test = RG_CLAIM_RATIO, .first = 5, .last = 2},
        {.table = NULL}};
    const struct rg_claim *all = rg_claims;
    rg_claims = turned;
    for (int row = 1; row <= 6; row++) {
        struct rg_claim_outcomes outcomes = {0};
        struct rg_result result;
        make(&result, "creus-5.6", 0, 10);
        assert_true(
            rg_claims_add(&outcomes, &result, NULL, &(struct rg_claims_shown){NULL, row, row}));
        assert_int_equal(outcomes.count, row >= 2 && row <= 5);
        rg_claims_free(&outcomes);
        rg_result_free(&result);
    }
    rg_claims = all;
}

// The document of a judged table, without its passport.
static void expect_table(const json_t *table, const json_t *passport, const char *due)
{
    json_t *told = json_copy((json_t *)table);
    assert_ptr_equal(json_object_get(told, "passport"), passport);
    json_object_del(told, "passport");
    char *text = json_dumps(told, JSON_COMPACT);
    assert_string_equal(text, due);
    free(text);
    json_decref(told);
}

// A claim's outcomes stand together, machine by machine and in each by device.
static void outcomes_stand_by_claim(void **state)
{
    (void)state;
    static const char *const due[] = {
        "{\"table\":\"creus-5.6\",\"machine\":\"A\",\"length\":\"full\",\"quick\":\"atlas=small "
        "city=small depth_map_px=2048\",\"size_divisor\":1}",
        "{\"table\":\"creus-5.6\",\"machine\":\"B\",\"length\":\"quick\",\"quick\":\"atlas=small "
        "city=small depth_map_px=2048\",\"size_divisor\":4,\"changed\":\"seed=2\"}"};
    static const char *const lengths[] = {
        "full",
        "quick (atlas=small city=small depth_map_px=2048), with 1/4 of the width and height"};
    struct rg_claim_outcomes o = {0};
    struct rg_result results[2];
    make_on(&results[0], "creus-5.6", 2, 0, 10);
    make_on(&results[1], "creus-5.6", 2, 0, 10);
    json_object_set_new(json_object_get(results[1].passport, "machine"), "cpu",
                        json_string("CPU there"));
    results[1].full = false;
    results[1].size_divisor = 4;
    snprintf(results[1].changed, RG_SET_SIZE, "seed=2");
    for (int i = 0; i < 2; i++)
        assert_true(rg_claims_add(&o, &results[i], NULL, &(struct rg_claims_shown){0}));
    assert_int_equal(o.count, 3 * 2 * 2);
    for (int i = 0; i < o.count; i++) {
        assert_ptr_equal(o.outcomes[i].claim, o.outcomes[i / 4 * 4].claim);
        assert_int_equal(o.outcomes[i].origin, i % 4 / 2);
        assert_string_equal(o.outcomes[i].device, i % 2 ? "gl" : "cpu");
        assert_string_equal(o.outcomes[i].length, lengths[i % 4 / 2]);
        assert_int_equal(strcmp(o.outcomes[i].machine, "CPU there") == 0, i % 4 / 2);
    }
    assert_ptr_not_equal(o.outcomes[0].claim, o.outcomes[4].claim);
    for (int i = 0; i < 2; i++) {
        expect_table(json_array_get(o.tables, (size_t)i), results[i].passport, due[i]);
        rg_result_free(&results[i]);
    }
    rg_claims_free(&o);
}

static void lengths_are_told(void **state)
{
    (void)state;
    static const struct {
        bool full;
        const char *quick;
        int divisor;
        const char *text;
    } cases[] = {{true, "", 0, "full"},
                 {true, "atlas=small", 1, "full"},
                 {false, "", 1, "quick"},
                 {false, "atlas=small", 0, "quick (atlas=small)"},
                 {false, "atlas=small", 4, "quick (atlas=small), with 1/4 of the width and height"},
                 {false, "", 2, "quick, with 1/2 of the width and height"}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_result result = {.full = cases[i].full, .size_divisor = cases[i].divisor};
        char text[RG_CLAIMS_LENGTH];
        snprintf(result.quick, sizeof(result.quick), "%s", cases[i].quick);
        rg_claims_length(&result, text, sizeof(text));
        assert_string_equal(text, cases[i].text);
    }
}

// Launches are written and read with the rest of a record.
static void launches_are_stored(void **state)
{
    (void)state;
    char why[RG_WHY_SIZE];
    struct rg_result result, read = {0};
    make(&result, "chin-timing", 3, 10);
    json_t *document = rg_result_json(&result);
    assert_true(rg_result_from_json(document, "made-up", &read, why));
    const struct rg_record *a = rg_result_at(&result, (struct rg_place){.row = 0});
    const struct rg_record *b = rg_result_at(&read, (struct rg_place){.row = 0});
    assert_int_equal(b->launch_count, 3);
    assert_memory_equal(a->launches, b->launches, 3 * sizeof(a->launches[0]));
    rg_result_free(&read);
    json_t *cell = json_array_get(json_object_get(document, "cells"), 0);
    json_t *launches = json_object_get(json_object_get(cell, "measured"), "launches");
    json_array_set_new(json_array_get(launches, 2), 0, json_integer(2)); // the same number twice
    assert_false(rg_result_from_json(document, "made-up", &read, why));
    assert_non_null(strstr(why, "made-up: cells[0].measured.launches has an element"));
    json_decref(document);
    rg_result_free(&result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_and_variants_that_claims_need),
        cmocka_unit_test(groups),
        cmocka_unit_test(cells_of_tests),
        cmocka_unit_test(a_course_ends),
        cmocka_unit_test(no_more_launches_than_allowed),
        cmocka_unit_test(devices_have_their_own_courses),
        cmocka_unit_test(kept_launches_beside_today),
        cmocka_unit_test(kept_launches_at_the_bound),
        cmocka_unit_test(kept_launches_of_machines),
        cmocka_unit_test(kept_records_that_tell_nothing),
        cmocka_unit_test(claims_about_some_rows_and_variants),
        cmocka_unit_test(claims_whose_rows_are_turned),
        cmocka_unit_test(outcomes_stand_by_claim),
        cmocka_unit_test(lengths_are_told),
        cmocka_unit_test(launches_are_stored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
