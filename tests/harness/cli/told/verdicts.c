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

#define LEAD                                                                                       \
    "2 claims on 2 devices: 0 hold, 0 do not, 0 are open, 0 at the bound; 1 are not judged."
#define ONE_LAUNCH                                                                                 \
    "One launch, no verdict: 1 fit the claim, 2 do not, 0 lie near the bound; `raingauge claims` " \
    "decides."

static const struct {
    const char *form;
    bool is_whole; // else the parts stand somewhere in what is printed
    const char *parts[4];
} forms[] = {
    {"",
     true,
     {"## claims\n\n- " LEAD "\n- Holds: 0.\n- Does not hold: 0.\n- Open: 0.\n- " ONE_LAUNCH "\n\n"
      "|    table |            claim |   ref |     gl |\n"
      "|---------:|-----------------:|------:|-------:|\n"
      "| test-1.2 | \"rows are alike\" |  (no) |   (no) |\n"
      "| test-1.2 |     bare is fast | (yes) | unseen |\n\n"
      "- unseen: not seen; in (): one launch; why: `--wide`.\n- full: test-1.2.\n"
      "- The paper's own table contradicts: test-1.2, \"rows are alike\"; test-1.2, bare is "
      "fast.\n"}},
    {" --format csv",
     true,
     {"table,section,claim,cpu:reference,gl\n"
      "test-1.2,1.2,\"\"\"rows are alike\"\"\",one launch: misses,one launch: misses\n"
      "test-1.2,1.3,bare is fast,one launch: fits,not seen\n"}},
    {" --wide",
     false,
     {"| test-1.2 |      1.3 |     bare is fast |         one launch: fits |                 not "
      "seen |\n",
      "\n- test-1.2, bare is fast, one launch: fits on cpu:reference: a \"b\", c, height_m 3.5: "
      "41.1 "
      "fps, needed: at least 10; one launch, which decides nothing.\n",
      "\n- test-1.2, bare is fast, not seen on gl: row 2 has no number: the driver's process "
      "ended.\n"}},
    {" --format tex",
     false,
     {"\\begin{table}", "\n\\caption{claims}\n",
      "\ntest-1.2 & 1.3 & bare is fast & one launch: fits & not seen \\\\\n",
      "\n\n\\noindent " LEAD "\n\n"}},
};

// Both commands print the same; but the status of a table tells of its failed cells.
static void verdicts_are_printed(void **state)
{
    (void)state;
    char line[128];
    for (size_t i = 0; i < sizeof(forms) / sizeof(forms[0]); i++)
        for (int is_table = 0; is_table < 2; is_table++) {
            snprintf(line, sizeof(line), "%s --from a.json%s",
                     is_table ? "table --claims" : "claims", forms[i].form);
            asked_expect(line, "memory 0; ", is_table ? RG_EXIT_FAIL : RG_EXIT_PASS);
            assert_string_equal(asked_logged, "");
            if (forms[i].is_whole)
                assert_string_equal(asked_printed, forms[i].parts[0]);
            for (int k = 0; k < 4 && forms[i].parts[k]; k++)
                if (!strstr(asked_printed, forms[i].parts[k]))
                    fail_msg("no %s in %s", forms[i].parts[k], asked_printed);
        }
}

static void verdicts_are_printed_for_programs(void **state)
{
    (void)state;
    asked_expect("claims --from a.json --json", "memory 0; ", RG_EXIT_PASS);
    assert_string_equal(asked_printed + strlen(asked_printed) - 3, "\n}\n");
    json_t *json = json_loads(asked_printed, 0, NULL);
    const json_t *claims = json_object_get(json, "claims");
    const json_t *verdicts = json_object_get(json_array_get(claims, 1), "verdicts");
    assert_int_equal(json_object_size(json), 4);
    assert_int_equal(json_array_size(claims), 2);
    assert_int_equal(json_array_size(verdicts), 2);
    const json_t *verdict = json_object_get(json_array_get(verdicts, 1), "verdict");
    assert_string_equal(json_string_value(verdict), "not seen");
    json_decref(json);
}

// Rows and variants choose among claims, and do not change their verdicts.
static void claims_are_shown_in_part(void **state)
{
    (void)state;
    static const char *const rows[][2] = {
        {"table --claims --from a.json --format csv --rows 3-9",
         "test-1.2,1.2,\"\"\"rows are alike\"\"\",one launch: misses,one launch: misses\n"},
        {"table --claims --from a.json --format csv --variant bare",
         "test-1.2,1.3,bare is fast,one launch: fits,not seen\n"}};
    for (int i = 0; i < 2; i++) {
        asked_run(rows[i][0]);
        assert_string_equal(strchr(asked_printed, '\n') + 1, rows[i][1]);
    }
}

// A table is judged once on each machine, and at one length.
static void results_that_no_verdict_mixes_are_refused(void **state)
{
    (void)state;
    store("b.json", "w", "Toy", true);
    store("b.json", "a", "Toy", false);
    store("c.json", "w", "Toy", true);
    store("c.json", "a", "Toy", true);
    store("d.json", "w", "Toy", true);
    store("d.json", "a", "Other", true);
    static const char *const commands[] = {"claims --from", "table --claims --from"};
    static const char *const rows[][2] = {
        {"b.json", "b.json: holds table 'test-1.2' measured full, and quick, which no verdict "
                   "mixes; name the file of one of them"},
        {"c.json", "c.json: holds table 'test-1.2' twice, as results do that lie beside a journal; "
                   "name the file of one of them"}};
    char line[128];
    for (int i = 0; i < 2; i++)
        for (int c = 0; c < 2; c++) {
            snprintf(line, sizeof(line), "%s %s", commands[c], rows[i][0]);
            asked_expect(line, "memory 0; ", RG_EXIT_USAGE);
            assert_string_equal(asked_logged, rows[i][1]);
            assert_string_equal(asked_printed, "");
        }
    asked_expect("claims --from d.json --format csv", "memory 0; ", RG_EXIT_PASS);
    assert_string_equal(asked_printed,
                        "table,section,claim,on,cpu:reference,gl\n"
                        "test-1.2,1.2,\"\"\"rows are alike\"\"\",A,one launch: misses,one launch: "
                        "misses\n"
                        "test-1.2,1.2,\"\"\"rows are alike\"\"\",B,one launch: misses,one launch: "
                        "misses\n"
                        "test-1.2,1.3,bare is fast,A,one launch: fits,not seen\n"
                        "test-1.2,1.3,bare is fast,B,one launch: fits,not seen\n");
    // Another table of the file is no reason to refuse one.
    asked_expect("claims other --from b.json", "memory 0; ", RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "b.json: holds no table of these about which a paper claims "
                                      "something; name another folder");
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, begin, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(verdicts_are_printed),
        ASKED(verdicts_are_printed_for_programs),
        ASKED(claims_are_shown_in_part),
        ASKED(results_that_no_verdict_mixes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
