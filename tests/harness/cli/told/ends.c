// The ends of `trace`, which may be interrupted, and of `verify --from`, which puts the records of
// shards together.
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/commands/cli/shard.h"
#include "harness/compare/verify/checks.h"
#include "harness/compare/verify/shards.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/devices/frames/trace.h"
#include "harness/record/output.h"
#include "tests/harness/cli/asked.h"
#include "tests/harness/cli/told/parts.h"

// --- stand-ins ---

static bool is_interrupted;
static int checks_end;

bool rg_interrupted(void)
{
    return is_interrupted;
}

int rg_interrupt_signal(void)
{
    return is_interrupted ? SIGINT : 0;
}

// The first device's trace is interrupted where one is asked for.
bool rg_trace_device(struct rg_trace *trace, struct rg_device *device,
                     const struct rg_subject *subject, int frames)
{
    asked_note_subject(subject);
    asked_note(", %d frames on %s; ", frames, device->info.name);
    trace->devices++;
    is_interrupted = broken && !strcmp(broken, "interrupted");
    return does(device->info.name);
}

char *rg_trace_end(struct rg_trace *trace, const struct rg_device_info *infos, int count)
{
    asked_note("trace of %d, %s to %s; ", trace->devices, infos[0].name, infos[count - 1].name);
    json_decref(trace->events);
    return strdup("{}");
}

bool rg_output_write_file(const char *path, const char *text)
{
    asked_note("write %s: %s; ", path, text);
    return does("write");
}

int rg_shards_exit(const struct rg_parts *parts, const char *kind, const char *path, bool partial)
{
    assert_string_equal(kind, "verify");
    assert_string_equal(path, "in");
    return parts->count ? RG_EXIT_PASS : partial ? RG_EXIT_NOTHING : RG_EXIT_INCONCLUSIVE;
}

bool rg_checks_merge(const struct rg_parts *parts, struct rg_checks *checks)
{
    (void)checks;
    asked_note("merge %d; ", parts->count);
    return does("merge");
}

json_t *rg_checks_merge_devices(const struct rg_parts *parts)
{
    return json_integer(parts->count);
}

char *rg_parts_texts(const struct rg_parts *parts, const char *name, bool by_lines)
{
    (void)parts;
    asked_note("%s%s; ", name, by_lines ? " by lines" : "");
    return does("note") ? strdup("first: 1.0\n") : NULL;
}

void rg_checks_print(const struct rg_checks *checks, const char *note, json_t *devices, bool json)
{
    (void)checks;
    asked_note("print %lld%s; ", (long long)json_integer_value(devices), json ? " as json" : "");
    assert_string_equal(note, "first: 1.0\n");
    json_decref(devices);
}

int rg_checks_exit(const struct rg_checks *checks)
{
    (void)checks;
    return checks_end;
}

static int begin(void **state)
{
    broken = NULL;
    is_interrupted = false;
    is_found = true;
    checks_end = RG_EXIT_PASS;
    return asked_setup(state);
}

// --- trace ---

#define LINE   "trace flow --count 4 --size 8x4 -o t.json"
#define OPENED "memory 0; open all, require -, 120 s; "
#define FIRST  "flow seed 1, 8x4, 4 frames on first; "
#define SECOND "flow seed 1, 8x4, 4 frames on second; "
#define WRITE  "write t.json: {}; close 2"
#define TOLD   "t.json: 4 frames, and as many by pass, on 2 devices\n"

// A device that fails takes no other with it. After an interruption what was traced is written.
static void traces_end_as_their_devices(void **state)
{
    (void)state;
    static const struct {
        const char *broken, *seen, *printed;
        int exit;
    } rows[] = {
        {NULL, OPENED FIRST SECOND "trace of 2, first to second; " WRITE, TOLD, RG_EXIT_PASS},
        {"first", OPENED FIRST SECOND "trace of 2, first to second; " WRITE, TOLD, RG_EXIT_USAGE},
        {"second", OPENED FIRST SECOND "trace of 2, first to second; " WRITE, TOLD, RG_EXIT_USAGE},
        {"write", OPENED FIRST SECOND "trace of 2, first to second; " WRITE, "", RG_EXIT_USAGE},
        {"interrupted", OPENED FIRST "trace of 1, first to first; " WRITE,
         "t.json: 4 frames, and as many by pass, on 1 device\n", RG_EXIT_SIGNALLED + SIGINT},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        broken = rows[i].broken;
        is_interrupted = false;
        asked_expect(LINE, rows[i].seen, rows[i].exit);
        assert_string_equal(asked_printed, rows[i].printed);
    }
    broken = NULL;
    is_interrupted = false;
    asked_opening = RG_EXIT_UNSUPPORTED;
    asked_expect(LINE, OPENED, RG_EXIT_UNSUPPORTED);
}

// --- verify ---

#define FROM "memory 0; verify records of in; "

static void shards_are_verified_together(void **state)
{
    (void)state;
    static const struct {
        const char *line, *broken;
        int checks_end;
        const char *seen;
        int exit;
    } rows[] = {
        {"verify --from in", NULL, RG_EXIT_PASS, "merge 2; note by lines; print 2; free 2", 0},
        {"verify --from in --json", NULL, RG_EXIT_FAIL,
         "merge 2; note by lines; print 2 as json; free 2", RG_EXIT_FAIL},
        {"verify --from in", "merge", RG_EXIT_PASS, "merge 2; free 2", RG_EXIT_USAGE},
        {"verify --from in", "note", RG_EXIT_PASS, "merge 2; note by lines; free 2", RG_EXIT_USAGE},
        {"verify --from in", "parts", RG_EXIT_PASS, "free 2", RG_EXIT_USAGE},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char seen[256];
        broken = rows[i].broken;
        checks_end = rows[i].checks_end;
        snprintf(seen, sizeof(seen), FROM "%s", rows[i].seen);
        asked_expect(rows[i].line, seen, rows[i].exit);
    }
    broken = NULL;
    is_found = false;
    asked_expect("verify --from in", FROM "free 0", RG_EXIT_INCONCLUSIVE);
    asked_expect("verify --from in --partial", FROM "free 0", RG_EXIT_NOTHING);
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, begin, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(traces_end_as_their_devices),
        ASKED(shards_are_verified_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
