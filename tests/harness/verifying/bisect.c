// A bisect's search over every short list: the first bad candidate, and candidates that cannot be
// judged. Then the list itself, and what is told of a command's verdicts.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <jansson.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"

#include "harness/compare/bisect/bisect.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"
#include "tests/tools/process/printed.h"

enum { LONGEST = 11 };

// Searches a list in which `first_bad` and all after it are bad, and the set bits of `skipped`
// cannot be judged.
static struct rg_search search(int count, int first_bad, uint64_t skipped, int *judged)
{
    enum rg_judgement verdicts[64] = {[0] = RG_JUDGED_GOOD};
    verdicts[count - 1] = RG_JUDGED_BAD;
    *judged = 0;
    for (;;) {
        const struct rg_search found = rg_search_of(verdicts, count);
        const int64_t next = found.next;
        if (next < 0)
            return found;
        assert_between(next, found.good + 1, found.bad - 1);
        assert_int_equal(verdicts[next], RG_JUDGED_NONE);
        verdicts[next] = skipped >> next & 1 ? RG_JUDGED_SKIP
                         : next >= first_bad ? RG_JUDGED_BAD
                                             : RG_JUDGED_GOOD;
        ++*judged;
    }
}

static void finds_what_can_be_known(void **state)
{
    (void)state;
    for (int count = 2; count <= LONGEST; count++)
        for (int first_bad = 1; first_bad < count; first_bad++)
            for (unsigned skipped = 0; skipped < 1u << count; skipped += 2) {
                int judged, good = first_bad - 1, bad = first_bad;
                if (skipped >> (count - 1) & 1)
                    continue; // the ends can be judged
                while (good > 0 && skipped >> good & 1)
                    good--;
                while (bad < count - 1 && skipped >> bad & 1)
                    bad++;
                const struct rg_search found = search(count, first_bad, skipped, &judged);
                assert_int_equal(found.good, good);
                assert_int_equal(found.bad, bad);
                assert_int_equal(found.left, 0);
            }
}

static void halves(void **state)
{
    (void)state;
    for (int count = 2; count <= 63; count++)
        for (int first_bad = 1; first_bad < count; first_bad++) {
            int judged;
            const struct rg_search whole = rg_search_of((enum rg_judgement[64]){0}, count);
            search(count, first_bad, 0, &judged);
            assert_at_most(judged, whole.steps);
            assert_at_most(1 << whole.steps, 2 * (count - 1));
        }
}

// The middle 20 of 60 cannot be judged: the search leaves them in leaps.
static void leaves_a_stretch_in_leaps(void **state)
{
    (void)state;
    enum rg_judgement verdicts[62] = {RG_JUDGED_GOOD, [61] = RG_JUDGED_BAD};
    int judged = 0;
    for (int64_t next = 0; next >= 0; judged++) {
        const struct rg_search found = rg_search_of(verdicts, 62);
        next = found.next;
        if (next < 21 || next > 40)
            break;
        verdicts[next] = RG_JUDGED_SKIP;
    }
    assert_int_equal(judged, 1);
}

// The next candidate by what is known: G good, B bad, S skipped, a point where nothing is.
static void the_middle_of_the_longest_stretch_is_next(void **state)
{
    (void)state;
    static const struct {
        const char *verdicts;
        int good, bad, left, next, steps;
    } cases[] = {
        {"GB", 0, 1, 0, -1, 0},       {"G.B", 0, 2, 1, 1, 1},        {"G......B", 0, 7, 6, 3, 3},
        {"G..G..B.B", 3, 6, 2, 4, 2}, {"G.SB..B", 0, 3, 1, 1, 1},    {"GSGSB", 2, 4, 0, -1, 0},
        {"GS.S..SB", 0, 7, 3, 4, 2},  {"G.SSS.S.SB", 0, 9, 3, 5, 2}, // nearest to the centre
        {"G.S.S.SSB", 0, 8, 3, 3, 2},                                // of two as near the first
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        enum rg_judgement verdicts[16];
        const int count = (int)strlen(cases[i].verdicts);
        for (int k = 0; k < count; k++)
            verdicts[k] = cases[i].verdicts[k] == 'G'   ? RG_JUDGED_GOOD
                          : cases[i].verdicts[k] == 'B' ? RG_JUDGED_BAD
                          : cases[i].verdicts[k] == 'S' ? RG_JUDGED_SKIP
                                                        : RG_JUDGED_NONE;
        const struct rg_search found = rg_search_of(verdicts, count);
        assert_int_equal(found.good, cases[i].good);
        assert_int_equal(found.bad, cases[i].bad);
        assert_int_equal(found.left, cases[i].left);
        assert_int_equal(found.next, cases[i].next);
        assert_int_equal(found.steps, cases[i].steps);
    }
}

// --- lists ---

static void add(const char *names, struct rg_candidates *candidates)
{
    static const char *const all[] = {"a", "b", "c", "d", "e"};
    for (; *names; names++)
        assert_true(rg_candidates_add(*names == 'x' ? "x" : all[*names - 'a'], candidates));
}

static void check_list(const char *names, const char *good, const char *bad, const char *wanted)
{
    struct rg_candidates c = {.count = 0};
    add(good, &c);
    add(names, &c);
    add(bad, &c);
    assert_int_equal(rg_candidates_between(&c), wanted != NULL);
    for (int64_t i = 0; wanted && i < c.count; i++)
        assert_int_equal(*c.names[i], wanted[i]);
    if (wanted)
        assert_int_equal(c.count, strlen(wanted));
    rg_candidates_free(&c);
}

static void lists_go_from_good_to_bad(void **state)
{
    (void)state;
    rg_log_hold(true);
    check_list("abcde", "b", "d", "bcd");
    check_list("abcde", "e", "a", "edcba");
    check_list("bcd", "a", "e", "abcde");
    check_list("", "a", "e", "ae");
    check_list("abcde", "a", "x", NULL);
    assert_non_null(strstr(rg_last_error(), "--bad 'x' is not among the candidates"));
    check_list("abcde", "x", "a", NULL);
    assert_non_null(strstr(rg_last_error(), "--good 'x' is not among the candidates"));
    check_list("abc", "a", "a", NULL);
    assert_string_equal(rg_last_error(), "--good and --bad are both 'a'; name two candidates");
    check_list("abcb", "a", "c", NULL);
    assert_string_equal(rg_last_error(),
                        "bisect: the candidate 'b' is there twice; name each once");
    rg_log_hold(false);
}

// A variable of the environment can hold 65536 bytes.
static void names_fit_into_a_variable(void **state)
{
    (void)state;
    struct rg_candidates c = {.count = 0};
    char *name = calloc(1, (1 << 16) + 2);
    assert_non_null(name);
    memset(name, 'x', 1 << 16);
    rg_log_hold(true);
    assert_true(rg_candidates_add(name, &c));
    name[1 << 16] = 'x';
    assert_false(rg_candidates_add(name, &c));
    assert_string_equal(rg_last_error(), "bisect: the candidate "
                                         "'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...' has more "
                                         "than 65536 bytes; rename it");
    assert_false(rg_candidates_add("", &c));
    assert_string_equal(rg_last_error(), "bisect: a candidate has no name; leave it out");
    assert_false(rg_candidates_add("a\tb", &c));
    assert_string_equal(rg_last_error(),
                        "bisect: a candidate has a control character 0x09; rename it");
    rg_log_hold(false);
    assert_int_equal(c.count, 1);
    rg_candidates_free(&c);
    free(name);
}

// --- commands ---

// Stands before the library's: it is a quarter of a second later each time that somebody looks.
double rg_now_ms(void)
{
    static double now_ms;
    return now_ms += 250;
}

// They stand before the library's, too: a command asks for an interruption by making this file.
static char asked[64];

bool rg_interrupted(void)
{
    return *asked && !access(asked, F_OK);
}

int rg_interrupt_signal(void)
{
    return rg_interrupted() ? SIGTERM : 0;
}

// Each exit status has its meaning; one that says "again" is tried with twice the time.
static void statuses_are_verdicts(void **state)
{
    (void)state;
    static const struct {
        const char *line;
        enum rg_judgement verdict;
        int status, tries;
    } cases[] = {
        {"test \"${RG_GOOD-none}\" = none", RG_JUDGED_GOOD, 0, 1}, // it was not handed over
        {"exit 1", RG_JUDGED_BAD, 1, 1},
        {"exit 2", RG_JUDGED_STOP, 2, 1},
        {"exit 3", RG_JUDGED_SKIP, 3, 4},
        {"test $RG_BUDGET = 6s && exit 1; exit 3", RG_JUDGED_BAD, 1, 3},
        {"exit 4", RG_JUDGED_SKIP, 4, 1},
        {"exit 71", RG_JUDGED_STOP, 71, 1},
        {"exit 77", RG_JUDGED_SKIP, 77, 1},
        {"exit 125", RG_JUDGED_SKIP, 125, 1},
        {"exit 128", RG_JUDGED_STOP, 128, 1},
        {"exit 129", RG_JUDGED_STOP, 129, 1},
        {"exit 130", RG_JUDGED_STOP, 130, 1},
        {"exit 143", RG_JUDGED_STOP, 143, 1},
        {"kill -TERM $$", RG_JUDGED_STOP, 143, 1},
        {"exit 134", RG_JUDGED_SKIP, 134, 1},
        {"kill -SEGV $$", RG_JUDGED_SKIP, 139, 1},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_judging judging = {.line = cases[i].line, .budget_s = 1.5, .tries = 4};
        struct rg_judged judged = rg_judge(&judging, "a", NULL);
        assert_int_equal(judged.verdict, cases[i].verdict);
        assert_int_equal(judged.status, cases[i].status);
        assert_int_equal(judged.tries, cases[i].tries);
        assert_equals(judged.seconds, 0.25);
        judging.crash_is_bad = true;
        judged = rg_judge(&judging, "a", NULL);
        const bool is_crash = cases[i].status == 134 || cases[i].status == 139;
        assert_int_equal(judged.verdict, is_crash ? RG_JUDGED_BAD : cases[i].verdict);
    }
}

static void verdicts_have_names_and_a_status_for_git(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        int git;
    } due[] = {[RG_JUDGED_NONE] = {"none", 128},   [RG_JUDGED_GOOD] = {"good", 0},
               [RG_JUDGED_BAD] = {"bad", 1},       [RG_JUDGED_SKIP] = {"skip", 125},
               [RG_JUDGED_AGAIN] = {"again", 128}, [RG_JUDGED_STOP] = {"stop", 128}};
    for (int i = 0; i < 6; i++) {
        assert_string_equal(rg_judgement_name((enum rg_judgement)i), due[i].name);
        assert_int_equal(rg_judgement_git((enum rg_judgement)i), due[i].git);
    }
}

// --- whole bisects ---

// Bisects the numbers from 1 to 6. Returns what it prints, and then its JSON; the caller frees
// both.
static const char *bisect(const char *line, int *exit, json_t **json)
{
    static const char *const names[] = {"1", "2", "3", "4", "5", "6"};
    struct rg_candidates candidates = {.count = 0};
    for (int i = 0; i < 6; i++)
        assert_true(rg_candidates_add(names[i], &candidates));
    const struct rg_judging judging = {.line = line, .budget_s = 1, .tries = 2};
    struct rg_bisect b = {.candidates = &candidates, .judging = &judging, .prints = true};
    *logged = 0;
    rg_log_listen(log_all, NULL);
    printed_begin();
    *exit = rg_bisect_run(&b);
    const char *text = printed_end();
    rg_log_listen(NULL, NULL);
    FILE *out = tmpfile();
    assert_non_null(out);
    assert_true(rg_bisect_print_json(&b, out));
    rewind(out);
    *json = json_loadf(out, 0, NULL);
    assert_non_null(*json);
    fclose(out);
    rg_bisect_free(&b);
    rg_candidates_free(&candidates);
    return text;
}

static void the_first_bad_one_is_told(void **state)
{
    (void)state;
    static const char line[] = "test \"$RG_GOOD\" = 1 && test $RG_CANDIDATE -lt 5";
    int exit;
    json_t *json;
    const char *text = bisect(line, &exit, &json);
    assert_int_equal(exit, RG_EXIT_PASS);
    assert_string_equal(text, "good  1  (exit status 0, 0.25 s)\n"
                              "bad   6  (exit status 1, 0.25 s)\n"
                              "good  3  (exit status 0, 0.25 s)\n"
                              "good  4  (exit status 0, 0.25 s)\n"
                              "bad   5  (exit status 1, 0.25 s)\n"
                              "the first bad one is 5; 4 before it is good\n");
    assert_string_equal(logged, "4 candidates left, about 3 more to judge\n"
                                "2 candidates left, about 2 more to judge\n"
                                "1 candidate left, about 1 more to judge\n");
    json_t *due =
        json_pack("{si ss ss ss si ss s[s] s[{ss ss si si sf} {ss ss si si sf} {ss ss si si sf}"
                  "{ss ss si si sf} {ss ss si si sf}]}",
                  "format", 1, "command", line, "good", "1", "bad", "6", "candidates", 6, "end",
                  "found", "first_bad", "5", "judged",                                           //
                  "candidate", "1", "verdict", "good", "status", 0, "tries", 1, "seconds", 0.25, //
                  "candidate", "6", "verdict", "bad", "status", 1, "tries", 1, "seconds", 0.25,  //
                  "candidate", "3", "verdict", "good", "status", 0, "tries", 1, "seconds", 0.25, //
                  "candidate", "4", "verdict", "good", "status", 0, "tries", 1, "seconds", 0.25, //
                  "candidate", "5", "verdict", "bad", "status", 1, "tries", 1, "seconds", 0.25);
    assert_non_null(due);
    assert_true(json_equal(json, due));
    json_decref(due);
    json_decref(json);
}

// The third can never be judged, and the fourth not by this command.
static void several_are_told(void **state)
{
    (void)state;
    int exit;
    json_t *json;
    const char *text =
        bisect("case $RG_CANDIDATE in 3) exit 3;; 4) exit 77;; *) test $RG_CANDIDATE -lt 5; esac",
               &exit, &json);
    assert_int_equal(exit, RG_EXIT_INCONCLUSIVE);
    assert_string_equal(
        text, "good  1  (exit status 0, 0.25 s)\n"
              "bad   6  (exit status 1, 0.25 s)\n"
              "skip  3  (exit status 3, 0.25 s, 2 tries)\n"
              "skip  4  (exit status 77, 0.25 s)\n"
              "good  2  (exit status 0, 0.25 s)\n"
              "bad   5  (exit status 1, 0.25 s)\n"
              "2 is good; the first bad one is one of these, of which the last alone was judged:\n"
              "  3\n  4\n  5\n");
    json_t *due = json_pack("[sss]", "3", "4", "5");
    assert_true(json_equal(json_object_get(json, "first_bad"), due));
    assert_string_equal(json_string_value(json_object_get(json, "end")), "one of several");
    json_decref(due);
    json_decref(json);
}

// An end that is not what it is called, or that cannot be judged, and a command that judges
// nothing.
static void ends_that_are_wrong_are_told(void **state)
{
    (void)state;
    static const struct {
        const char *line;
        int exit, judged;
        const char *end, *says;
    } cases[] = {
        {"exit 1", RG_EXIT_FAIL, 1, "good is not good",
         "--good 1: is bad; name an end that is good, or a command that tells the two apart\n"},
        {"exit 0", RG_EXIT_FAIL, 2, "bad is not bad",
         "--bad 6: is good; name an end that is bad, or a command that tells the two apart\n"},
        {"exit 77", RG_EXIT_NOTHING, 1, "good is not good",
         "--good 1: cannot be judged, for the command ended with 77; name an end that can be\n"},
        {"test $RG_CANDIDATE = 1 || exit 4", RG_EXIT_NOTHING, 2, "bad is not bad",
         "--bad 6: cannot be judged, for the command ended with 4; name an end that can be\n"},
        {"test $RG_CANDIDATE = 1 || exit 5", RG_EXIT_USAGE, 1, "stopped",
         "6: the command ended with 5, which is no verdict (0 good, 1 bad, 3 again, 4, 77 and 125 "
         "skip); see what it printed\n"},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        int exit;
        json_t *json;
        bisect(cases[i].line, &exit, &json);
        assert_int_equal(exit, cases[i].exit);
        assert_string_equal(logged, cases[i].says);
        assert_string_equal(json_string_value(json_object_get(json, "end")), cases[i].end);
        assert_int_equal(json_array_size(json_object_get(json, "judged")), cases[i].judged);
        assert_int_equal(json_array_size(json_object_get(json, "first_bad")), 0);
        json_decref(json);
    }
}

// An interruption ends the command that judges, and says with which ends a bisect goes on.
static void an_interruption_says_how_it_goes_on(void **state)
{
    (void)state;
    int exit;
    json_t *json;
    char line[256];
    strcpy(asked, "/tmp/raingauge-asked-XXXXXX");
    const int file = mkstemp(asked);
    assert_true(file >= 0 && !close(file) && !unlink(asked));
    assert_int_equal(rg_judgement_git(RG_JUDGED_STOP), 128);
    snprintf(line, sizeof(line),
             "test $RG_CANDIDATE = 4 && { : > %s; exec sleep 60; }; test $RG_CANDIDATE -lt 5",
             asked);
    const char *text = bisect(line, &exit, &json);
    assert_int_equal(exit, RG_EXIT_SIGNALLED + SIGTERM);
    assert_string_equal(text, "good  1  (exit status 0, 0.25 s)\n"
                              "bad   6  (exit status 1, 0.25 s)\n"
                              "good  3  (exit status 0, 0.25 s)\n");
    assert_string_equal(logged, "4 candidates left, about 3 more to judge\n"
                                "2 candidates left, about 2 more to judge\n"
                                "interrupted; --good '3' --bad '6' go on from here\n");
    assert_string_equal(json_string_value(json_object_get(json, "end")), "stopped");
    assert_int_equal(json_array_size(json_object_get(json, "judged")), 3);
    assert_int_equal(json_array_size(json_object_get(json, "first_bad")), 0);
    assert_int_equal(rg_judgement_git(RG_JUDGED_STOP), 128 + SIGTERM);
    assert_int_equal(rg_judgement_git(RG_JUDGED_GOOD), 0);
    unlink(asked);
    *asked = 0;
    json_decref(json);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_what_can_be_known),
        cmocka_unit_test(halves),
        cmocka_unit_test(leaves_a_stretch_in_leaps),
        cmocka_unit_test(the_middle_of_the_longest_stretch_is_next),
        cmocka_unit_test(lists_go_from_good_to_bad),
        cmocka_unit_test(names_fit_into_a_variable),
        cmocka_unit_test(statuses_are_verdicts),
        cmocka_unit_test(verdicts_have_names_and_a_status_for_git),
        cmocka_unit_test(the_first_bad_one_is_told),
        cmocka_unit_test(several_are_told),
        cmocka_unit_test(ends_that_are_wrong_are_told),
        cmocka_unit_test(an_interruption_says_how_it_goes_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
