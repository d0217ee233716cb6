// The last line of a command that measures tables: the cells with a number, and those without.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/tables/runs/closing.h"
#include "tests/tools/expect.h"

static char told[256];

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    assert_int_equal(level, RG_LOG_INFO);
    snprintf(told, sizeof(told), "%s", line);
}

static void the_line_tells_what_has_no_number(void **state)
{
    (void)state;
    static const struct {
        struct rg_closing closing;
        int devices;
        const char *line;
    } cases[] = {{{12, 0, 0}, 2, "12 cells measured on 2 devices"},
                 {{1, 0, 0}, 1, "1 cell measured on 1 device"},
                 {{1, 1, 0}, 1, "0 of 1 cell measured on 1 device; 1 failed"},
                 {{10, 1, 0}, 2, "9 of 10 cells measured on 2 devices; 1 failed"},
                 {{10, 0, 3}, 1, "7 of 10 cells measured on 1 device; 3 unsupported"},
                 {{10, 2, 3}, 2, "5 of 10 cells measured on 2 devices; 2 failed, 3 unsupported"},
                 {{0, 0, 0}, 2, "0 cells measured on 2 devices"}};
    rg_log_listen(hear, NULL);
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        rg_closing_tell(&cases[i].closing, cases[i].devices);
        assert_string_equal(told, cases[i].line);
    }
    rg_log_listen(NULL, NULL);
}

// A row of each outcome, and one that is missing: whatever is neither ok nor unsupported failed.
static void cells_of_several_tables_add_up(void **state)
{
    (void)state;
    struct rg_result result = {.last_row = RG_OUTCOME_COUNT, .variant_count = 1, .device_count = 2};
    struct rg_closing closing = {0};
    for (int row = 0; row < RG_OUTCOME_COUNT; row++) {
        assert_true(rg_result_add_row(&result, row));
        rg_result_at(&result, (struct rg_place){.row = row})->outcome = (enum rg_outcome)row;
        rg_result_at(&result, (struct rg_place){.row = row, .device = 1})->outcome = RG_OK;
    }
    for (int tables = 1; tables <= 2; tables++) {
        rg_closing_add(&closing, &result);
        assert_int_equal(closing.cells, tables * 2 * RG_OUTCOME_COUNT);
        assert_int_equal(closing.unsupported, tables);
        assert_int_equal(closing.failed, tables * (RG_OUTCOME_COUNT - 2));
        assert_int_equal(rg_closing_measured(&closing), tables * (RG_OUTCOME_COUNT + 1));
    }
    rg_result_free(&result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_line_tells_what_has_no_number),
        cmocka_unit_test(cells_of_several_tables_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
