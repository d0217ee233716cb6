// The rows, variants and sizes that a table cannot do without, by claims that are made up.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "harness/tables/claims/claim.h"
#include "harness/tables/runs/needed.h"
#include "harness/tables/runs/order.h"
#include "tests/tools/expect.h"

enum { MOST_DUE = 24, MOST_CLAIMS = 3 };

static const struct rg_claim *papers;

static int keep_claims(void **state)
{
    (void)state;
    papers = rg_claims;
    return 0;
}

static int restore_claims(void **state)
{
    (void)state;
    rg_claims = papers;
    return 0;
}

// A claim about rows, with a knee up to another row or without any.
#define ABOUT(of, from, to)                                                                        \
    {                                                                                              \
        .table = "t", .variant = "a", .test = of, .first = (from), .last = (to)                    \
    }
#define BENT(of, from, bend, end, to)                                                              \
    {                                                                                              \
        .table = "t", .variant = "a", .test = of, .first = (from), .knee = (bend), .until = (end), \
        .last = (to)                                                                               \
    }

// The claims about a table of so many rows, of which quick mode has the first; its needed rows.
static const struct {
    int rows, quick_rows;
    struct rg_claim claims[MOST_CLAIMS + 1];
    int due[MOST_DUE];
} cases[] = {
    {20, 0, {{0}}, {1, 10, 20}},
    {20, 9, {{0}}, {1, 5, 9}},
    {1, 0, {{0}}, {1}},
    {2, 0, {{0}}, {1, 2}},
    {3, 0, {{0}}, {1, 2, 3}},
    {64, 0, {{0}}, {1, 32, 64}},
    {20, 0, {ABOUT(RG_CLAIM_RATIO, 3, 4)}, {1, 3, 4, 20}},
    {20, 0, {ABOUT(RG_CLAIM_RATIO, 3, 8)}, {1, 3, 8, 20}},
    {20, 0, {ABOUT(RG_CLAIM_RATIO, 1, 20)}, {1, 10, 20}},
    {20, 0, {ABOUT(RG_CLAIM_FALLS, 10, 20)}, {1, 10, 15, 20}},
    {20, 0, {ABOUT(RG_CLAIM_FALLS, 10, 20), ABOUT(RG_CLAIM_RATIO, 12, 13)}, {1, 10, 12, 13, 20}},
    {20, 0, {BENT(RG_CLAIM_OPTIMUM, 5, 7, 9, 11)}, {1, 5, 7, 9, 11, 20}},
    {20, 0, {BENT(RG_CLAIM_SLOWEST, 5, 8, 8, 11)}, {1, 5, 8, 11, 20}},
    {20, 9, {ABOUT(RG_CLAIM_FASTER, 1, 20)}, {1, 5, 9}},
    {20, 9, {ABOUT(RG_CLAIM_RATE, 3, 20)}, {1, 3, 6, 9}},
    {20, 9, {ABOUT(RG_CLAIM_FALLS, 1, 20)}, {1, 5, 9, 20}},
    {20, 9, {{.table = "other", .variant = "a", .first = 12, .last = 13}}, {1, 5, 9}},
};

static void expect_rows(const bool rows[RG_TABLE_ROWS], int count, size_t number)
{
    int found = 0;
    for (int row = 1; row <= RG_TABLE_ROWS; row++) {
        if (!rows[row - 1])
            continue;
        if (found == MOST_DUE || cases[number].due[found] != row)
            fail_msg("case %zu: row %d is needed", number, row);
        found++;
    }
    assert_int_equal(found, count);
    if (found < MOST_DUE && cases[number].due[found])
        fail_msg("case %zu: row %d is not needed", number, cases[number].due[found]);
}

// Quick mode has the needed rows and all others of its own.
static void expect_quick(const struct rg_table *table, const bool needed[RG_TABLE_ROWS])
{
    bool quick[RG_TABLE_ROWS];
    const int own = table->quick_rows ? table->quick_rows : table->row_count;
    const int count = rg_quick_rows(table, quick);
    int found = 0;
    for (int row = 0; row < table->row_count; row++) {
        assert_int_equal(quick[row], needed[row] || row < own);
        found += quick[row];
    }
    assert_int_equal(count, found);
}

static void rows_are_the_ends_and_the_middles(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        const struct rg_table table = {
            .id = "t", .row_count = cases[i].rows, .quick_rows = cases[i].quick_rows};
        bool rows[RG_TABLE_ROWS];
        rg_claims = cases[i].claims;
        expect_rows(rows, rg_needed_rows(&table, rows), i);
        expect_quick(&table, rows);
        assert_int_equal(rg_has_claims(&table),
                         cases[i].claims[0].table && !strcmp(cases[i].claims[0].table, "t"));
    }
}

// A claim's variants are needed, both of them, unless it can wait.
static const struct rg_claim of_variants[] = {
    {.table = "t", .variant = "b", .other = "d", .test = RG_CLAIM_FASTER, .first = 1, .last = 2},
    {.table = "t",
     .variant = "c",
     .other = "a",
     .test = RG_CLAIM_FASTER,
     .first = 1,
     .last = 2,
     .can_wait = true},
    {.table = "other", .variant = "e", .first = 1, .last = 2},
    {.table = NULL}};

static void variants_are_those_of_claims(void **state)
{
    (void)state;
    const struct rg_table table = {
        .id = "t",
        .row_count = 2,
        .variants = {
            {"a", "", NULL}, {"b", "", NULL}, {"c", "", NULL}, {"d", "", NULL}, {"e", "", NULL}}};
    static const bool due[] = {true, true, false, true, false};
    bool variants[RG_TABLE_VARIANTS];
    rg_claims = of_variants;
    assert_int_equal(rg_needed_variants(&table, variants), 3);
    for (int v = 0; v < 5; v++)
        assert_int_equal(variants[v], due[v]);
}

// Pictures stay as large as they are if they are small, of textures, or if their rate is claimed at
// the paper's settings; errors are measured of whole pictures, or where a claim is about them.
static void sizes_follow_from_claims(void **state)
{
    (void)state;
    static const struct {
        struct rg_claim claim;
        int width, height;
        const char *quick, *truth;
        bool is_of_textures;
        int divisor;
        bool wants_whole, wants_small;
    } sizes[] = {
        {{0}, 1280, 720, NULL, NULL, false, 4, false, false},
        {{0}, 1280, 720, NULL, "a=1", false, 4, true, false},
        {{0}, 512, 512, NULL, "a=1", false, 1, true, false},
        {{0}, 513, 512, NULL, NULL, false, 4, false, false},
        {{0}, 1280, 720, NULL, NULL, true, 1, false, false},
        {ABOUT(RG_CLAIM_RATE, 1, 2), 1280, 720, NULL, NULL, false, 1, false, false},
        {ABOUT(RG_CLAIM_RATE, 1, 2), 1280, 720, "q=1", NULL, false, 4, false, false},
        {ABOUT(RG_CLAIM_RATIO, 1, 2), 1280, 720, NULL, "a=1", false, 4, true, false},
        {BENT(RG_CLAIM_FLATTENS, 1, 2, 2, 3), 1280, 720, "q=1", "a=1", false, 4, true, true},
    };
    for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
        const struct rg_claim claims[] = {sizes[i].claim, {.table = NULL}};
        const struct rg_table table = {.id = "t",
                                       .width = sizes[i].width,
                                       .height = sizes[i].height,
                                       .quick = sizes[i].quick,
                                       .truth = sizes[i].truth,
                                       .is_of_textures = sizes[i].is_of_textures};
        rg_claims = claims;
        assert_int_equal(rg_most_divisor(&table), sizes[i].divisor);
        assert_int_equal(rg_wants_truth(&table, 1), sizes[i].wants_whole);
        assert_int_equal(rg_wants_truth(&table, 4), sizes[i].wants_small);
        rg_claims = papers;
    }
}

// A table before it is measured. A table without works has cells of one kind, and textures have no
// samples.
static void a_table_begins_with_what_it_needs(void **state)
{
    (void)state;
    struct rg_table table = {
        .id = "t",
        .row_count = 20,
        .quick_rows = 9,
        .width = 1280,
        .height = 720,
        .variants = {{"a", "", NULL}, {"b", "", NULL}, {"c", "", NULL}, {"d", "", NULL}}};
    rg_claims = of_variants;
    struct rg_standing s = rg_standing_of(&table);
    assert_true(s.table == &table && s.has_claims);
    assert_int_equal(s.needed_rows, 3); // 1, 2 and 9
    assert_int_equal(s.quick_rows, 9);
    assert_int_equal(s.needed_variants, 3);
    assert_int_equal(s.variants, 4);
    assert_int_equal(s.works, 1);
    assert_int_equal(s.share.divisor, 4);
    assert_false(s.share.all_samples || s.share.all_variants || s.share.all_works);
    assert_int_equal(s.share.devices, 0);
    assert_int_equal(s.rows, 0);
    table.works[0].name = "paper";
    table.works[1].name = "ours";
    table.is_of_textures = true;
    table.id = "another";
    s = rg_standing_of(&table);
    assert_false(s.has_claims);
    assert_int_equal(s.works, 2);
    assert_int_equal(s.needed_rows, 20);
    assert_int_equal(s.share.divisor, 1);
    assert_true(s.share.all_samples);
}

// Seconds are shared by what the cells were expected to take, and evenly if nothing was known.
static void times_are_learnt(void **state)
{
    (void)state;
    const struct rg_table table = {.technique = "one"};
    struct rg_standing s = {.table = &table};
    struct rg_order order = {&s, 1, 7, 1, 4};
    const struct rg_step both = {.devices = 5}, second = {.devices = 2};
    rg_order_learn(&order, &both, 3, 12);
    assert_equals(s.cell_s[0], 2);
    assert_equals(s.cell_s[1], 0);
    assert_equals(s.cell_s[2], 2);
    rg_order_learn(&order, &second, 2, 12);
    assert_equals(s.cell_s[1], 6);
    s.cell_s[2] = 6;
    rg_order_learn(&order, &both, 3, 48);
    assert_equals(s.cell_s[0], 4);
    assert_equals(s.cell_s[1], 6);
    assert_equals(s.cell_s[2], 12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_the_ends_and_the_middles),
        cmocka_unit_test(variants_are_those_of_claims),
        cmocka_unit_test(sizes_follow_from_claims),
        cmocka_unit_test(a_table_begins_with_what_it_needs),
        cmocka_unit_test(times_are_learnt),
    };
    return cmocka_run_group_tests(tests, keep_claims, restore_claims);
}
