// Verdicts on results that are stored: what `claims` and `table --claims` print in each form, and
// the results that they do not judge together.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/console/exit.h"
#include "harness/record/schema/schema.h"
#include "harness/tables/claims/claim.h"
#include "tests/harness/cli/asked.h"
#include "tests/harness/record/made.h"

static const struct rg_claim own[] = {{.table = "test-1.2",
                                       .variant = "full",
                                       .where = "1.2",
                                       .words = "rows are alike",
                                       .test = RG_CLAIM_RATIO,
                                       .first = 2,
                                       .last = 4,
                                       .least = 1.5},
                                      {.table = "test-1.2",
                                       .variant = "bare",
                                       .source = RG_CLAIM_PRINTED,
                                       .where = "1.3",
                                       .words = "bare is fast",
                                       .test = RG_CLAIM_RATE,
                                       .first = 2,
                                       .last = 2,
                                       .least = 10},
                                      {.table = NULL}};

// Adds a result to a file: rows 2 and 4 of two works, variants and devices.
static void store(const char *path, const char *mode, const char *cpu, bool full)
{
    FILE *file = fopen(path, mode);
    struct rg_result made = make_result();
    assert_non_null(file);
    made.full = full;
    json_object_set_new(made.passport, "machine", json_pack("{ss}", "cpu", cpu));
    *made.quick = 0;
    for (struct rg_place at = rg_result_start(&made); rg_result_next(&made, &at);)
        rg_result_at(&made, at)->fact_count = 0; // it draws what is printed
    json_t *document = rg_result_json(&made);
    json_dumpf(document, file, RG_JSON_FLAGS);
    json_decref(document);
    rg_result_free(&made);
    assert_int_equal(fclose(file), 0);
}

static int begin(void **state)
{
    const int failed = asked_setup(state);
    rg_claims = own;
    store("a.json", "w", "Toy", true);
    return failed;
}

static const struct {
    const char *form, *printed;
} forms[] = {
    {"", ""},
    {" --wide", ""},
    {" --format csv", ""},
    {" --format tex", ""},
};

static void verdicts_are_printed(void **state)
{
    (void)state;
    static const char *const commands[] = {"claims --from a.json", "table --claims --from a.json"};
    char line[128];
    for (size_t i = 0; i < sizeof(forms) / sizeof(forms[0]); i++)
        for (int c = 0; c < 2; c++) {
            snprintf(line, sizeof(line), "%s%s", commands[c], forms[i].form);
            const int exit = asked_run(line);
            fprintf(stderr, "%s: %d %s\n%s", line, exit, asked_logged, asked_printed);
        }
    int exit = asked_run("claims --from a.json --json");
    fprintf(stderr, "%d %s\n%s", exit, asked_logged, asked_printed);
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, begin, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(verdicts_are_printed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
