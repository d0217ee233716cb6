// Claims compared with print: each is about existing rows and variants, and print itself confirms
// or contradicts it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/tables/claims/evidence.h"
#include "harness/tables/papers/papers.h"
#include "harness/tables/table.h"
#include "tests/tools/expect.h"

// Each claim names an existing table, its rows and its variants.
static void test_claims_are_about_tables(void **state)
{
    (void)state;
    for (const struct rg_claim *claim = rg_claims; claim->table; claim++) {
        const struct rg_table *table = rg_table_find(claim->table);
        bool has = false, has_other = !claim->other;
        assert_non_null(table);
        assert_at_most(abs(claim->last - claim->first), RG_CLAIM_ROWS - 1);
        assert_between(claim->first, 1, table->row_count);
        assert_between(claim->last, 1, table->row_count);
        assert_true(claim->test != RG_CLAIM_RATIO || claim->first != claim->last);
        assert_true(!claim->knee || (claim->knee >= claim->first && claim->knee <= claim->last));
        assert_true(!claim->until || (claim->until > claim->knee && claim->until <= claim->last));
        for (int i = 0; table->variants[i].name; i++) {
            has |= !strcmp(table->variants[i].name, claim->variant);
            has_other |= claim->other && !strcmp(table->variants[i].name, claim->other);
        }
        assert_true(has && has_other && *claim->words && *claim->where);
    }
}

// --- claims and print ---

enum { LAUNCHES = 192 };

// A random number from 0 to 1.
static double noise(uint32_t *x)
{
    *x = *x * 1664525u + 1013904223u;
    return (*x >> 8) * 0x1p-24;
}

// Results of a device that is as fast as print.
static void make_as_printed(const struct rg_table *table, struct rg_result *result)
{
    static struct rg_device device = {.info = {.name = "cpu"}};
    const struct rg_devices devices = {.count = 1, .devices = {&device}};
    const struct rg_table_part part = {.last_row = table->row_count - 1, .full = true};
    uint32_t x = 1;
    *result = (struct rg_result){0};
    rg_table_begin(result, table, &part, &devices);
    for (int row = 0; row < table->row_count; row++)
        assert_true(rg_table_add_row(result, table, row));
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        struct rg_record *record = rg_result_at(result, at);
        record->outcome = RG_OK;
        record->sample_count = record->wanted_samples = 1;
        record->samples_ms[0] = 1000 / rg_record_published_fps(record);
        record->launch_count = LAUNCHES;
        for (int i = 0; i < record->launch_count; i++)
            record->launches[i] = (struct rg_launch){.number = i + 1,
                                                     .ms = 1000 / rg_record_published_fps(record) *
                                                           (1 + 1e-7 * noise(&x))};
    }
}

static bool is_of_printed_rates(const struct rg_claim *claim, const struct rg_result *result)
{
    const struct rg_place first = {.row = result->first_row};
    return claim->test != RG_CLAIM_FLATTENS &&
           isfinite(rg_record_published_fps(rg_result_at(result, first)));
}

// The verdict that print gives its own claims. The paper contradicts itself in one: it says that
// rates vary with the scene, and prints 1.03 times.
static enum rg_claim_verdict verdict_of_print(const struct rg_claim *claim)
{
    return !strcmp(claim->table, "feng-1") && claim->test == RG_CLAIM_APART
               ? RG_CLAIM_NOT_REPRODUCED
               : RG_CLAIM_REPRODUCED;
}

// A claim about the wrong rows, variant or number would not be confirmed.
static void test_print_bears_out_claims(void **state)
{
    (void)state;
    int judged = 0, borne_out = 0;
    for (const struct rg_claim *claim = rg_claims; claim->table; claim++) {
        struct rg_result result;
        make_as_printed(rg_table_find(claim->table), &result);
        if (is_of_printed_rates(claim, &result)) {
            const struct rg_judgement j = rg_claim_judge(claim, &result, 0);
            if (j.verdict != verdict_of_print(claim))
                fail_msg("%s, %s: print is %s, %s", claim->table, claim->words,
                         rg_claim_verdict_text(j.verdict), j.why);
            assert_int_equal(j.print_contradicts, j.verdict == RG_CLAIM_NOT_REPRODUCED);
            judged++;
            borne_out += j.verdict == RG_CLAIM_REPRODUCED;
        }
        rg_result_free(&result);
    }
    assert_int_equal(judged, 29);
    assert_int_equal(borne_out, 28);
}
int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_claims_are_about_tables),
        cmocka_unit_test(test_print_bears_out_claims),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
