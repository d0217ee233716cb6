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
#include "harness/tables/launching/course.h"
#include "harness/tables/papers/papers.h"
#include "tests/tools/expect.h"

// A table on one device, with the cells that claims need and launches that all take `ms`.
static void make(struct rg_result *result, const char *id, int launches, double ms)
{
    static struct rg_device device = {.info = {.name = "cpu"}};
    const struct rg_devices devices = {.count = 1, .devices = {&device}};
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

static void rows_and_variants_that_claims_need(void **state)
{
    (void)state;
    struct rg_result result;
    make(&result, "ye-1", 0, 1);
    assert_int_equal(result.variant_count, 8); // neither the layers nor the city
    rg_result_free(&result);
    make(&result, "feng-2", 0, 1);
    assert_int_equal(rg_result_wants(&result, 4), true);
    assert_int_equal(rg_result_wants(&result, 5), false); // only the car's rows
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
    assert_int_equal(rg_launches_next(&result, rg_claims, 0, &cells), 1);
    assert_int_equal(cells.count, 5 * 8);
    assert_int_equal(cells.group_count, 2 * 5); // each row: with the heap, and the rest
    rg_result_free(&result);
    make(&result, "creus-5.3", 0, 1);
    assert_int_equal(rg_launches_next(&result, rg_claims, 0, &cells), 1);
    assert_int_equal(cells.count, 18);
    assert_int_equal(cells.group_count, 2); // one a camera
    assert_int_equal(size_of_group(&cells, 0), 9);
    rg_result_free(&result);
}

// A decided claim gets no more launches; otherwise the launches' numbers go on.
static void a_course_ends(void **state)
{
    (void)state;
    struct rg_launch_cells cells;
    struct rg_result result;
    make(&result, "chin-timing", 11, 10); // 100 frames a second
    assert_int_equal(rg_launches_next(&result, rg_claims, 0, &cells), 12);
    assert_true(rg_launches_are_due(&result, rg_claims));
    rg_result_free(&result);
    make(&result, "chin-timing", 192, 10);
    assert_int_equal(rg_launches_next(&result, rg_claims, 0, &cells), 0);
    assert_false(rg_launches_are_due(&result, rg_claims));
    // If most launches are disturbed, the course ends after 33 of them.
    struct rg_record *record = rg_result_at(&result, rg_result_start(&result));
    record = rg_result_at(&result, (struct rg_place){.row = 0});
    record->launch_count = 33;
    for (int i = 0; i < 33; i++)
        record->launches[i].others = 1;
    assert_int_equal(rg_launches_next(&result, rg_claims, 0, &cells), 0);
    record->launch_count = 32;
    assert_int_equal(rg_launches_next(&result, rg_claims, 0, &cells), 33);
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
        cmocka_unit_test(a_course_ends),
        cmocka_unit_test(kept_launches_beside_today),
        cmocka_unit_test(launches_are_stored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
