// The ends of `shrink`: what it looks for, the files that it writes and prints, and its status.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/compare/shrink/case.h"
#include "harness/compare/shrink/culprit.h"
#include "harness/compare/shrink/folder.h"
#include "harness/compare/shrink/shrink.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "tests/harness/cli/asked.h"
#include "tests/harness/cli/told/steps.h"

// --- stand-ins ---

static int search_ends, signal_number;
static bool has_culprit;
static char folder[600]; // for files that are tried

bool rg_interrupted(void)
{
    return signal_number != 0;
}

int rg_interrupt_signal(void)
{
    return signal_number;
}

// A file that was tried is left behind.
int rg_shrink_case(const struct rg_shrink_request *request, struct rg_case *found,
                   struct rg_blame *blame, int *tried)
{
    char path[700];
    assert_string_equal(request->device->info.name, "first");
    assert_string_equal(request->truth->info.name, "second");
    asked_note_subject(&request->run.subject);
    asked_note(", %d frames, %d s; ", request->run.frames, request->seconds);
    *found = (struct rg_case){.run = request->run};
    snprintf(folder, sizeof(folder), "%s", request->folder);
    snprintf(path, sizeof(path), "%s/tried.obj", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fclose(file);
    *blame = (struct rg_blame){.text = "frame 1, stage rain"};
    *tried = 7;
    return search_ends;
}

bool rg_culprit_find(const struct rg_digest_run *run, const struct rg_blame *blame,
                     const struct rg_fall *fall, struct rg_device *device, struct rg_device *truth,
                     double end_ms, struct rg_culprit *culprit)
{
    static const struct rg_kernel kernel = {.name = "flow_move"};
    (void)run;
    (void)fall;
    assert_true(end_ms > 0 && !strcmp(blame->text, "frame 1, stage rain"));
    assert_true(!strcmp(device->info.name, "first") && !strcmp(truth->info.name, "second"));
    *culprit = (struct rg_culprit){.found = has_culprit,
                                   .due.kernel = &kernel,
                                   .items = 8,
                                   .of_items = 512,
                                   .why_not = "they differ in order"};
    return does("culprit");
}

void rg_culprit_free(struct rg_culprit *culprit)
{
    assert_int_equal(culprit->items, 8);
    asked_note("free; ");
}

bool rg_case_write(const struct rg_case *found, const char *note, const char *path)
{
    (void)found;
    asked_note("write %s: %s; ", path, note);
    return does("case");
}

void rg_case_free(struct rg_case *found)
{
    asked_note(found->run.subject.technique ? "end; " : "");
}

bool rg_kernel_folder_write(const char *path, const struct rg_culprit *culprit, const char *note,
                            struct rg_device *device, const struct rg_device *truth)
{
    assert_true(culprit->found && !strcmp(device->info.name, "first") && truth);
    asked_note("kernel of %s: %s; ", path, note);
    return does("kernel");
}

void rg_kernel_folder_remove(const char *path)
{
    asked_note("no kernel of %s; ", path);
}

static int begin(void **state)
{
    search_ends = RG_EXIT_PASS;
    signal_number = 0;
    has_culprit = true;
    broken = NULL;
    *folder = 0;
    return asked_setup(state);
}

// --- tests ---

#define OPENED "memory 0; open first,second, require -, 120 s; "
#define LINE   "shrink flow --device first,second -o a\x1b.txt"
#define FOUND  "flow seed 1, 512x512, 5 frames, 45 s; "

static void what_is_found_is_written_and_told(void **state)
{
    (void)state;
    asked_expect(LINE,
                 OPENED FOUND "write a\x1b.txt: frame 1, stage rain; kernel of a\x1b.txt: frame 1, "
                              "stage rain; free; end; close 2",
                 RG_EXIT_PASS);
    assert_string_equal(asked_printed,
                        "frame 1, stage rain\n7 runs tried\nthe case is in a?.txt\nflow_move "
                        "alone, 8 of its 512 items, is in a?.txt.kernel: cc run.c -lvulkan -o run "
                        "&& ./run\n");
    assert_int_equal(access(folder, F_OK), -1); // nothing is left
    has_culprit = false;
    asked_expect(LINE,
                 OPENED FOUND "write a\x1b.txt: frame 1, stage rain; no kernel of a\x1b.txt; free; "
                              "end; close 2",
                 RG_EXIT_PASS);
    assert_string_equal(asked_printed, "frame 1, stage rain\n7 runs tried\nthe case is in a?.txt\n"
                                       "no kernel alone: they differ in order\n");
}

// A file that cannot be written, or an interruption, counts more than what was found.
static void what_was_found_may_be_lost(void **state)
{
    (void)state;
    static const struct {
        const char *broken, *seen;
    } rows[] = {{"culprit", OPENED FOUND "free; end; close 2"},
                {"case", OPENED FOUND "write a\x1b.txt: frame 1, stage rain; free; end; close 2"},
                {"kernel", OPENED FOUND "write a\x1b.txt: frame 1, stage rain; kernel of "
                                        "a\x1b.txt: frame 1, stage rain; free; end; close 2"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        broken = rows[i].broken;
        asked_expect(LINE, rows[i].seen, RG_EXIT_USAGE);
        assert_string_equal(asked_printed, "frame 1, stage rain\n7 runs tried\n");
    }
    broken = NULL;
    signal_number = 2;
    asked_expect(LINE, OPENED FOUND "end; close 2", RG_EXIT_SIGNALLED + 2);
    assert_string_equal(asked_printed, "");
    signal_number = 0;
    search_ends = RG_EXIT_FAIL;
    asked_expect(LINE, OPENED FOUND "end; close 2", RG_EXIT_FAIL);
    assert_string_equal(asked_printed, "");
    assert_int_equal(access(folder, F_OK), -1);
    setenv("TMPDIR", "/nonexistent", 1);
    asked_expect(LINE, OPENED "close 2", RG_EXIT_USAGE);
    unsetenv("TMPDIR");
    assert_int_equal(strncmp(asked_logged, "/nonexistent/raingauge-", 23), 0);
    assert_string_equal(strchr(asked_logged, ':'), ": cannot be made: No such file or directory; "
                                                   "set TMPDIR to a folder that takes files");
}

static void devices_decide_whether_it_begins(void **state)
{
    (void)state;
    asked_left_out = RG_EXIT_UNSUPPORTED;
    asked_expect(LINE, OPENED "close 2", RG_EXIT_UNSUPPORTED);
    asked_left_out = RG_EXIT_PASS;
    asked_opening = RG_EXIT_HARNESS;
    asked_expect(LINE, OPENED "close 2", RG_EXIT_HARNESS);
    asked_opening = RG_EXIT_PASS;
    asked_closing = RG_EXIT_HARNESS;
    assert_int_equal(asked_run(LINE), RG_EXIT_HARNESS);
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, begin, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(what_is_found_is_written_and_told),
        ASKED(what_was_found_may_be_lost),
        ASKED(devices_decide_whether_it_begins),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
