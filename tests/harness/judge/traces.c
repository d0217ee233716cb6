// Decisions on launches of real processes, which tests/harness/gate/selftest.py --traces wrote.
// They end as they did then, and the gate finds the promised changes in their noise.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "harness/judge/course.h"
#include "tests/tools/expect.h"

enum { MOST_GATES = 64, MOST_ROWS = 8, MOST_LAUNCHES = 1024 };

// A row's launches in their order; NAN: the launch was disturbed.
struct trace {
    char name[32], ending[16];
    int count, next;
    double logs[MOST_LAUNCHES];
};

struct gate {
    char device[64];
    bool is_same;
    int rows;
    struct trace of[MOST_ROWS];
    // A test's changes: B takes longer by this logarithm, and time is over after `over` launches.
    double added_log;
    int over, launches;
};

static const char *path;
static struct gate gates[MOST_GATES];
static int gate_count;

static void read_case(struct trace *trace, char *line)
{
    char *word = strtok(line, " \n");
    snprintf(trace->name, sizeof(trace->name), "%s", word);
    snprintf(trace->ending, sizeof(trace->ending), "%s", strtok(NULL, " \n"));
    while ((word = strtok(NULL, " \n"))) {
        assert_between(trace->count, 0, MOST_LAUNCHES - 1);
        trace->logs[trace->count++] = *word == 'x' ? NAN : strtod(word, NULL);
    }
    assert_at_least(trace->count, 16);
}

static int read_traces(void **state)
{
    (void)state;
    static char line[16 * MOST_LAUNCHES];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof(line), file)) {
        char kind[16];
        if (*line == '#')
            continue;
        if (!strncmp(line, "gate ", 5)) {
            assert_between(gate_count, 0, MOST_GATES - 1);
            assert_int_equal(sscanf(line, "gate %63s %15s", gates[gate_count].device, kind), 2);
            gates[gate_count++].is_same = !strcmp(kind, "same");
        } else {
            struct gate *gate = &gates[gate_count - 1];
            assert_between(gate->rows, 0, MOST_ROWS - 1);
            read_case(&gate->of[gate->rows++], line);
        }
    }
    fclose(file);
    return 0;
}

static bool launch(int number, void *user)
{
    struct gate *gate = user;
    assert_int_equal(number, gate->launches);
    gate->launches++;
    return true;
}

static bool take(int row, bool b_first, struct rg_quads *quads, void *user)
{
    struct gate *gate = user;
    struct trace *trace = &gate->of[row];
    (void)b_first;
    if (trace->next == trace->count)
        return false;
    const double found = trace->logs[trace->next++] + gate->added_log;
    *quads = (struct rg_quads){isnan(found) ? 0 : found, 10, isnan(found) ? 10 : 10 * exp(found),
                               isnan(found)};
    return true;
}

static bool is_over(void *user)
{
    const struct gate *gate = user;
    return gate->over && gate->launches >= gate->over;
}

// Decides by the rule for as many rows as the gate had then.
static void decide(struct gate *gate, struct rg_gate_row *found)
{
    const struct rg_gate_rule rule = rg_gate_rule_of(gate->rows);
    const struct rg_quad_source source = {launch, take, is_over, gate, NULL};
    gate->launches = 0;
    for (int row = 0; row < gate->rows; row++)
        gate->of[row].next = 0;
    assert_true(rg_course_run(&rule, &source, RG_COURSE_SEED, found));
}

// Each verdict is the same as then, after as many launches.
static void test_as_they_ended(void **state)
{
    (void)state;
    int same = 0, planted = 0;
    for (int i = 0; i < gate_count; i++) {
        struct gate gate = gates[i];
        struct rg_gate_row found[MOST_ROWS];
        decide(&gate, found);
        for (int row = 0; row < gate.rows; row++) {
            assert_string_equal(rg_two_name(found[row].decision.verdict), gate.of[row].ending);
            assert_int_equal(found[row].launches, gate.of[row].count);
            assert_string_equal(gate.of[row].ending, gate.is_same ? "pass" : "regressed");
            same += gate.is_same;
            planted += !gate.is_same;
        }
    }
    assert_at_least(same, 48);
    assert_at_least(planted, 18);
}

// A gate whose time is over before the first look finds nothing, and neither does one whose time is
// over before a regression was confirmed.
static void test_over(void **state)
{
    (void)state;
    for (int i = 0; i < gate_count; i++) {
        struct gate gate = gates[i];
        struct rg_gate_row found[MOST_ROWS];
        gate.over = gate.is_same ? 15 : 31;
        decide(&gate, found);
        assert_int_equal(gate.launches, gate.over);
        for (int row = 0; row < gate.rows; row++) {
            assert_int_equal(found[row].end, RG_END_OVER);
            assert_int_equal(found[row].decision.verdict, RG_TWO_INCONCLUSIVE);
        }
    }
}

// Joins the launches of a cell on a device in all gates on equal sides, one after the other.
static bool join(struct gate *joined, int first, int row)
{
    const struct trace *of = &gates[first].of[row];
    struct trace *trace = &joined->of[0];
    *joined = (struct gate){.rows = 1, .is_same = true};
    for (int i = 0; i < gate_count; i++) {
        if (!gates[i].is_same || strcmp(gates[i].device, gates[first].device))
            continue;
        if (i < first)
            return false; // an earlier call joined it
        const struct trace *next = &gates[i].of[row];
        assert_string_equal(next->name, of->name);
        memcpy(trace->logs + trace->count, next->logs, sizeof(double) * (size_t)next->count);
        trace->count += next->count;
    }
    return trace->count >= 32;
}

// In the noise of equal sides the gate finds 5 % more or less, from whichever launch on. It takes
// no change for one, and passes 1 %.
static void test_in_their_noise(void **state)
{
    (void)state;
    static const struct {
        double log;
        enum rg_verdict_of_two due;
    } cases[] = {{0.04879016417, RG_TWO_REGRESSED},
                 {-0.04879016417, RG_TWO_IMPROVED},
                 {0, RG_TWO_PASS},
                 {0.00995033085, RG_TWO_PASS}};
    int tried = 0;
    for (int i = 0; i < gate_count; i++) {
        for (int row = 0; gates[i].is_same && row < gates[i].rows; row++) {
            static struct gate joined, gate;
            if (!join(&joined, i, row))
                continue;
            for (int start = 0; start + 32 <= joined.of[0].count; start += 16) {
                for (size_t c = 0; c < sizeof(cases) / sizeof(cases[0]); c++) {
                    struct rg_gate_row found;
                    gate = joined;
                    gate.added_log = cases[c].log;
                    gate.of[0].count -= start;
                    memmove(gate.of[0].logs, joined.of[0].logs + start,
                            sizeof(double) * (size_t)gate.of[0].count);
                    decide(&gate, &found);
                    // A course that asks for more launches than there are is not decided.
                    if (found.end == RG_END_BROKEN)
                        continue;
                    assert_int_equal(found.decision.verdict, cases[c].due);
                    tried++;
                }
            }
        }
    }
    assert_at_least(tried, 100);
}

int main(int count, char **arguments)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_as_they_ended),
        cmocka_unit_test(test_over),
        cmocka_unit_test(test_in_their_noise),
    };
    if (count != 2) {
        fputs("gate_traces FILE\n", stderr);
        return 2;
    }
    path = arguments[1];
    return cmocka_run_group_tests(tests, read_traces, NULL);
}
