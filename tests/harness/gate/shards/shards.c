// Shards of a gate share its error, and their records make one report: what the command line cannot
// try with one machine.
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "harness/compare/gate/run/running.h"
#include "harness/compare/gate/shards/shards.h"
#include "harness/console/exit.h"

// A row's share of the error is that of a gate without shards, however few cells agree. Shards of
// googletest are gates of their own.
static void test_error(void **state)
{
    (void)state;
    static const struct {
        int count, family, shards;
        bool is_apart;
        double share;
    } rows[] = {{1, 10, 4, false, 0.001}, {3, 10, 4, false, 0.001}, {10, 10, 1, false, 0.001},
                {1, 10, 1, false, 0.01},  {2, 10, 4, true, 0.005},  {2, 20, 2, false, 0.0005}};
    const struct rg_gate_pairs pairs = {.count = 1};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_gate_request request = {.pairs = &pairs,
                                                .margin = 0.05,
                                                .shard = {1, rows[i].shards},
                                                .is_apart = rows[i].is_apart};
        const struct rg_running_gate run = {.asked = &request, .family = {rows[i].family}};
        const struct rg_gate_rule rule = rg_gate_rule_in(&run, 0, rows[i].count, false);
        assert_int_equal(rule.rows, rows[i].count);
        assert_true(rule.error / rule.rows > 0.999 * rows[i].share &&
                    rule.error / rule.rows < 1.001 * rows[i].share);
    }
}

// --- records ---

static json_t *case_json(const char *name, const char *device, const char *ending, bool compared)
{
    return json_pack("{ss ss s[ss] sf ss sb sb}", "name", name, "technique", "raster", "devices",
                     "cpu", device, "seconds", 1.5, "ending", ending, "compared", compared, "over",
                     0);
}

// The record of a shard with one case, at a place.
static json_t *record(int place, json_t *found, const char *driver, int exit)
{
    char passport[200];
    snprintf(passport, sizeof(passport), "{\"devices\": [{\"name\": \"gl\", \"driver\": \"%s\"}]}",
             driver);
    return json_pack("{ss s[o] s[i] s[] ss si}", "passport_text", passport, "gated", found,
                     "places", place, "results", "note", "A  cpu\n", "exit", exit);
}

static struct rg_parts parts_of(json_t *first, json_t *second, const char *require)
{
    struct rg_parts parts = {.count = 2, .documents = calloc(2, sizeof(json_t *))};
    json_object_set_new(first, "shard",
                        json_pack("{s{ss s[[ss]] s[ss]}}", "of", "require", require, "pairs", "cpu",
                                  "gl", "names", "one.gl", "two.gl"));
    parts.documents[0] = first;
    parts.documents[1] = second;
    parts.of = json_object_get(json_object_get(first, "shard"), "of");
    return parts;
}

// A device that no shard compared fails; one that another shard compared does not.
static void test_required(void **state)
{
    (void)state;
    for (int compared = 0; compared < 2; compared++) {
        struct rg_gate gate = {.case_count = 0};
        struct rg_parts parts = parts_of(
            record(0, case_json("one.gl", "gl", "skipped", false), "Mesa 22", RG_EXIT_PASS),
            record(1, case_json("two.gl", "gl", compared ? "pass" : "skipped", compared), "Mesa 22",
                   RG_EXIT_PASS),
            "gl");
        assert_true(rg_gate_merge(&parts, &gate));
        assert_int_equal(gate.report.case_count, compared ? 2 : 3);
        if (!compared)
            assert_string_equal(gate.report.cases[2].name, "required.gl");
        rg_gate_free(&gate);
        rg_parts_free(&parts);
    }
}

// Cases under one name must be of one driver.
static void test_drivers(void **state)
{
    (void)state;
    struct rg_gate gate = {.case_count = 0};
    struct rg_parts parts =
        parts_of(record(0, case_json("one.gl", "gl", "pass", true), "Mesa 22", RG_EXIT_PASS),
                 record(1, case_json("two.gl", "gl", "pass", true), "Mesa 25", RG_EXIT_PASS), "");
    assert_false(rg_gate_merge(&parts, &gate));
    assert_string_equal(rg_last_error(), "gate: shard 2 ran 'gl' with driver Mesa 25, and shard 1 "
                                         "with Mesa 22; run them with one driver");
    rg_gate_free(&gate);
    rg_parts_free(&parts);
}

// A case that is none is refused, and is no crash.
static void test_broken(void **state)
{
    (void)state;
    static const char *const broken[] = {"{}", "{\"name\": \"one.gl\"}",
                                         "{\"name\": \"one.gl\", \"ending\": \"gone\"}",
                                         "{\"name\": 7, \"ending\": \"pass\"}", "[]"};
    for (size_t i = 0; i < sizeof(broken) / sizeof(broken[0]); i++) {
        struct rg_gate gate = {.case_count = 0};
        struct rg_parts parts =
            parts_of(record(0, json_loads(broken[i], 0, NULL), "Mesa 22", RG_EXIT_PASS),
                     record(9, json_null(), "Mesa 22", RG_EXIT_PASS), "");
        assert_false(rg_gate_merge(&parts, &gate));
        assert_string_equal(rg_last_error(), "a gate's record has a case without a name or an "
                                             "ending; run its shard again");
        rg_gate_free(&gate);
        rg_parts_free(&parts);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_error),
        cmocka_unit_test(test_required),
        cmocka_unit_test(test_drivers),
        cmocka_unit_test(test_broken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
