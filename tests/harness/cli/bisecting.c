// What bisect and shrink ask for, by each of their options.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/compare/bisect/bisect.h"
#include "harness/compare/bisect/verdict.h"
#include "harness/compare/shrink/folder.h"
#include "harness/compare/shrink/shrink.h"
#include "harness/console/exit.h"
#include "tests/harness/cli/asked.h"
#include "tests/tools/expect.h"

// --- stand-ins ---

static void note_judging(const struct rg_judging *judging)
{
    asked_note("'%s' %d times, %g s%s%s", judging->line, judging->tries, judging->budget_s,
               judging->crash_is_bad ? ", crashes are bad" : "",
               judging->prints_here ? ", here" : "");
}

int rg_bisect_run(struct rg_bisect *bisect)
{
    for (int64_t i = 0; i < bisect->candidates->count; i++)
        asked_note("%s ", bisect->candidates->names[i]);
    note_judging(bisect->judging);
    asked_note("%s", bisect->prints ? ", in lines" : "");
    return RG_EXIT_INCONCLUSIVE;
}

bool rg_bisect_print_json(const struct rg_bisect *bisect, FILE *out)
{
    (void)bisect;
    (void)out;
    asked_note(", json");
    return true;
}

static enum rg_judgement verdict;

struct rg_judged rg_judge(const struct rg_judging *judging, const char *candidate, const char *good)
{
    assert_true(!candidate && !good);
    note_judging(judging);
    return (struct rg_judged){.verdict = verdict, .status = 77, .tries = 2};
}

static int shrunk;    // the status of shrinking
static bool is_found; // a kernel alone differs
static const struct rg_kernel kernel = {.name = "flow_move"};

int rg_shrink_case(const struct rg_shrink_request *r, struct rg_case *found, struct rg_blame *blame,
                   int *tried)
{
    asked_note_subject(&r->run.subject);
    asked_note(", %d frames on %s, truth %s, %d s; ", r->run.frames, r->device->info.name,
               r->truth->info.name, r->seconds);
    char path[600];
    snprintf(path, sizeof(path), "%s/reduced.json", r->folder);
    FILE *file = fopen(path, "w"); // which the command removes
    assert_non_null(file);
    fclose(file);
    memset(found, 0, sizeof(*found));
    *blame = (struct rg_blame){.found = true, .text = "it differs"};
    *tried = 12;
    return shrunk;
}

bool rg_culprit_find(const struct rg_digest_run *run, const struct rg_blame *blame,
                     const struct rg_fall *fall, struct rg_device *device, struct rg_device *truth,
                     double end_ms, struct rg_culprit *culprit)
{
    (void)run;
    (void)fall;
    (void)end_ms;
    asked_note("culprit of %s, %s and %s; ", blame->text, device->info.name, truth->info.name);
    memset(culprit, 0, sizeof(*culprit));
    culprit->found = is_found;
    culprit->due.kernel = &kernel;
    culprit->items = 3;
    culprit->of_items = 4096;
    snprintf(culprit->why_not, sizeof(culprit->why_not), "all are the same");
    return true;
}

void rg_culprit_free(struct rg_culprit *culprit)
{
    (void)culprit;
}

bool rg_case_write(const struct rg_case *found, const char *note, const char *path)
{
    (void)found;
    asked_note("case %s: %s; ", path, note);
    return true;
}

bool rg_kernel_folder_write(const char *path, const struct rg_culprit *culprit, const char *note,
                            struct rg_device *device, const struct rg_device *truth)
{
    (void)culprit;
    asked_note("kernel %s: %s, of %s and %s; ", path, note, device->info.name, truth->info.name);
    return true;
}

void rg_kernel_folder_remove(const char *path)
{
    asked_note("no kernel %s; ", path);
}

// --- bisect ---

static void bisects_are_asked_for(void **state)
{
    (void)state;
    FILE *file = fopen("list.txt", "w");
    assert_non_null(file);
    fputs("# versions\n22\n\n 23 \n", file);
    assert_int_equal(fclose(file), 0);
    static const struct {
        const char *line, *seen;
    } rows[] = {
        {"bisect --good a --bad z --run true b c", "a b c z 'true' 3 times, 120 s, in lines"},
        {"bisect --good a --bad z --run true --list list.txt --tries 5 --budget 30s --crash bad",
         "a 22 23 z 'true' 5 times, 30 s, crashes are bad, in lines"},
        {"bisect --good a --bad z --run true b --json", "a b z 'true' 3 times, 120 s, json"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        asked_expect(rows[i].line, rows[i].seen, RG_EXIT_INCONCLUSIVE);
    verdict = RG_JUDGED_SKIP;
    asked_expect("bisect --run true --crash skip", "'true' 3 times, 120 s, here", RG_EXIT_GIT_SKIP);
    assert_string_equal(asked_logged, "skip (exit status 77, 2 tries)");
    verdict = RG_JUDGED_BAD;
    asked_expect("bisect --run true", "'true' 3 times, 120 s, here", RG_EXIT_FAIL);
}

// Names that a line cannot have, each with what to write instead.
static void lines_with_blanks_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *line, *logged;
    } rows[] = {
        {"bisect --good a --bad z b --run x{}", "--run 'x{}': {} stands for nothing; write "
                                                "\"$RG_CANDIDATE\", or put the line into a script"},
        {"bisect --good a --bad z b --run {good}",
         "--run '{good}': {good} stands for nothing; write "
         "\"$RG_GOOD\", or put the line into a script"},
        {"bisect --run {budget}", "--run '{budget}': {budget} stands for nothing; write "
                                  "\"$RG_BUDGET\", or put the line into a script"},
        {"bisect --good a b --run x",
         "bisect: --good and --bad name the two ends; --bad is missing"},
        {"bisect --bad a b --run x",
         "bisect: --good and --bad name the two ends; --good is missing"},
        {"bisect --good a --bad z --list c b --run x",
         "--list c and 'b': name candidates in one of the two"},
        {"bisect --run x --json", "bisect: inside `git bisect run` there are no candidates; leave "
                                  "out --json"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        assert_int_equal(asked_run(rows[i].line), RG_EXIT_USAGE);
        assert_string_equal(asked_logged, rows[i].logged);
    }
    verdict = RG_JUDGED_GOOD;
    asked_expect("bisect --run {}", "'{}' 3 times, 120 s, here", RG_EXIT_PASS); // git's own
}

// --- shrink ---

static void shrinking_is_asked_for(void **state)
{
    (void)state;
    shrunk = RG_EXIT_FAIL;
    asked_expect(
        "shrink flow --set seed=2 --frame 0 --size 8x4 --seconds 7 --device a,b --require gl "
        "--timeout 4",
        "memory 0; open a,b, require gl, 4 s; flow seed 2, 8x4, 1 frames on first, truth "
        "second, 7 s; close 2",
        RG_EXIT_FAIL);
    shrunk = RG_EXIT_PASS;
    is_found = false;
    asked_expect("shrink flow",
                 "memory 0; open vulkan,cpu:reference, require -, 120 s; flow seed 1, 512x512, 5 "
                 "frames on first, truth second, 45 s; culprit of it differs, first and second; "
                 "case case.txt: it differs; no kernel case.txt; close 2",
                 RG_EXIT_PASS);
    assert_string_equal(asked_printed, "it differs\n12 runs tried\nthe case is in case.txt\nno "
                                       "kernel alone: all are the same\n");
    is_found = true;
    asked_expect("shrink flow -o out",
                 "memory 0; open vulkan,cpu:reference, require -, 120 s; flow seed 1, 512x512, 5 "
                 "frames on first, truth second, 45 s; culprit of it differs, first and second; "
                 "case out: it differs; kernel out: it differs, of first and second; close 2",
                 RG_EXIT_PASS);
    assert_string_equal(asked_printed,
                        "it differs\n12 runs tried\nthe case is in out\nflow_move alone, 3 of its "
                        "4096 items, is in out.kernel: cc run.c -lvulkan -o run && ./run\n");
    asked_left_out = RG_EXIT_UNSUPPORTED;
    asked_expect("shrink flow", "memory 0; open vulkan,cpu:reference, require -, 120 s; close 2",
                 RG_EXIT_UNSUPPORTED);
}

// Files of the search lie in a folder of their own, which goes with them.
static void shrinking_leaves_nothing(void **state)
{
    (void)state;
    assert_int_equal(mkdir("temporary", 0777), 0);
    setenv("TMPDIR", "temporary", 1);
    shrunk = RG_EXIT_FAIL;
    assert_int_equal(asked_run("shrink flow"), RG_EXIT_FAIL);
    assert_int_equal(rmdir("temporary"), 0); // it is empty
    assert_int_equal(asked_run("shrink flow"), RG_EXIT_USAGE);
    assert_non_null(strstr(asked_logged, "temporary/raingauge-"));
    assert_non_null(
        strstr(asked_logged, ": cannot be made: No such file or directory; set TMPDIR"));
    unsetenv("TMPDIR");
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, asked_setup, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(bisects_are_asked_for),
        ASKED(lines_with_blanks_are_refused),
        ASKED(shrinking_is_asked_for),
        ASKED(shrinking_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
