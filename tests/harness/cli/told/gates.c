// The ends of a gate: its status from the run, the reports, the record of a shard and the folder
// that another gate holds; and of one that puts the records of shards together.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/commands/cli/shard.h"
#include "harness/commands/comparing/outputs.h"
#include "harness/compare/gate/shards/shards.h"
#include "harness/console/exit.h"
#include "harness/record/disk/hold.h"
#include "tests/harness/cli/asked.h"
#include "tests/harness/cli/told/parts.h"

// --- stand-ins ---

static int gate_ends, gate_beyond;
static bool is_told; // the report is complete

int rg_gate_run(const struct rg_gate_request *request, struct rg_gate *gate)
{
    asked_note("run %s%s; ", asked_text(request->folder), request->times ? " by times" : "");
    gate->is_told = is_told;
    gate->beyond = gate_beyond;
    return gate_ends;
}

bool rg_gate_outputs_print(const struct rg_gate_outputs *outputs, const struct rg_known *known,
                           const struct rg_gate *gate)
{
    (void)gate;
    asked_note("print %d files%s%s; ", known->file_count, outputs->is_part ? " of a part" : "",
               outputs->updates ? ", update" : "");
    return does("print");
}

bool rg_gate_part_write(const struct rg_gate_request *request, const struct rg_gate_inputs *inputs,
                        const struct rg_gate *gate, int beyond, const char *folder)
{
    (void)gate;
    asked_note("part %d/%d in %s, beyond %d, times %s, expectations %s; ", request->shard.number,
               request->shard.count, folder, beyond, asked_text(inputs->times),
               inputs->expectations);
    return does("part");
}

void rg_gate_digest_known(const struct rg_known *known, char digest[RG_DIGEST_SIZE])
{
    snprintf(digest, RG_DIGEST_SIZE, "k%d", known->file_count);
}

bool rg_gate_digest_file(const char *path, char digest[RG_DIGEST_SIZE])
{
    snprintf(digest, RG_DIGEST_SIZE, "of-%.10s", path);
    return does("digest");
}

json_t *rg_gate_times_read(const char *path)
{
    asked_note("times %s; ", path);
    return does("times") ? json_object() : NULL;
}

bool rg_hold_folder(const char *folder, struct rg_hold *hold)
{
    asked_note("hold %s; ", folder);
    hold->folder = folder;
    return !broken || strcmp(broken, "hold") != 0;
}

void rg_hold_release(struct rg_hold *hold)
{
    assert_int_equal(hold->fd, -1);
    asked_note(hold->folder ? "release; " : "");
}

int rg_shards_exit(const struct rg_parts *parts, const char *kind, const char *path, bool partial)
{
    (void)path;
    return parts->count ? RG_EXIT_PASS : partial ? RG_EXIT_NOTHING : strlen(kind) + 100;
}

bool rg_gate_merge(const struct rg_parts *parts, struct rg_gate *gate)
{
    asked_note("merge %d; ", parts->count);
    gate->beyond = gate_beyond;
    return does("merge");
}

int rg_gate_exit(const struct rg_gate_request *request, const struct rg_gate *gate)
{
    (void)gate;
    assert_true(request->shard.number == 1 && request->shard.count == 1);
    return gate_ends;
}

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static int begin(void **state)
{
    const int failed = asked_setup(state);
    gate_ends = gate_beyond = RG_EXIT_PASS;
    is_told = is_found = true;
    broken = NULL;
    write_file("cells.txt", "a raster 16x16 1\n");
    write_file(
        "known.txt",
        "fail a/*\n  outcome fail\n  reason it is known\n  link https://example.org/1\n  since "
        "2026-11-20\n  until 2026-11-21\n");
    write_file("fails.txt", "");
    return failed;
}

// --- a run ---

#define GATE  "gate cpu cpu:reference --cells cells.txt"
#define SHARD GATE " --shard 2/3 -o out"
#define PART                                                                                       \
    "memory 0; hold out/2-of-3; run out/2-of-3; release; print 0 files of a part; part 2/3 in "    \
    "out, beyond %d, times -, expectations k0; "

// The run's status is that of the gate, unless a report or a shard's record cannot be written.
static void a_gate_ends_as_it_was_found(void **state)
{
    (void)state;
    static const int ends[] = {RG_EXIT_PASS, RG_EXIT_FAIL, RG_EXIT_INCONCLUSIVE, RG_EXIT_NOTHING,
                               RG_EXIT_UNSUPPORTED};
    char seen[512];
    for (size_t i = 0; i < sizeof(ends) / sizeof(ends[0]); i++) {
        gate_ends = ends[i];
        asked_expect(GATE, "memory 0; run -; print 0 files; ", ends[i]);
        snprintf(seen, sizeof(seen), PART, RG_EXIT_PASS);
        asked_expect(SHARD, seen, ends[i]);
    }
    gate_ends = RG_EXIT_PASS;
    gate_beyond = RG_EXIT_FAIL;
    snprintf(seen, sizeof(seen), PART, RG_EXIT_FAIL);
    asked_expect(SHARD, seen, RG_EXIT_PASS);
    broken = "part";
    asked_expect(SHARD, seen, RG_EXIT_USAGE);
    broken = "print";
    asked_expect(GATE, "memory 0; run -; print 0 files; ", RG_EXIT_USAGE);
    gate_ends = RG_EXIT_FAIL;
    asked_expect(GATE, "memory 0; run -; print 0 files; ",
                 rg_exit_worse(RG_EXIT_FAIL, RG_EXIT_USAGE));
}

// A report that is not complete is not told, and a shard that is interrupted, or asked in a wrong
// way, leaves no record.
static void what_did_not_end_leaves_no_record(void **state)
{
    (void)state;
    static const char seen[] =
        "memory 0; hold out/2-of-3; run out/2-of-3; release; print 0 files of a part; ";
    gate_ends = RG_EXIT_SIGNALLED + 2;
    asked_expect(SHARD, seen, RG_EXIT_SIGNALLED + 2);
    gate_ends = RG_EXIT_USAGE;
    asked_expect(SHARD, seen, RG_EXIT_USAGE);
    is_told = false;
    gate_ends = RG_EXIT_FAIL;
    asked_expect(SHARD, "memory 0; hold out/2-of-3; run out/2-of-3; release; ", RG_EXIT_FAIL);
}

static void a_folder_is_held(void **state)
{
    (void)state;
    asked_expect(GATE " -o out", "memory 0; hold out; run out; release; print 0 files; ",
                 RG_EXIT_PASS);
    broken = "hold";
    is_told = false;
    asked_expect(GATE " -o out", "memory 0; hold out; ", RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "out: another raingauge writes into it; wait until it has "
                                      "ended, or name another folder");
}

static void times_divide_the_cells(void **state)
{
    (void)state;
    asked_expect(SHARD " --times t.json --expectations known.txt",
                 "memory 0; times t.json; hold out/2-of-3; run out/2-of-3 by times; release; print "
                 "1 files of a part; part 2/3 in out, beyond 0, times of-t.json, expectations k1; ",
                 RG_EXIT_PASS);
    broken = "times";
    asked_expect(SHARD " --times t.json", "memory 0; times t.json; ", RG_EXIT_USAGE);
    broken = "digest";
    asked_expect(SHARD " --times t.json", "memory 0; times t.json; ", RG_EXIT_USAGE);
}

// No report replaces an input, and only files that can be written are updated.
static void inputs_are_spared(void **state)
{
    (void)state;
    static const char *const lines[] = {
        GATE " --junit cells.txt", GATE " --expectations known.txt --junit known.txt",
        GATE " --fails fails.txt --junit fails.txt", SHARD " --times cells.txt --junit cells.txt"};
    for (size_t i = 0; i < sizeof(lines) / sizeof(lines[0]); i++) {
        asked_expect(lines[i], "memory 0; ", RG_EXIT_USAGE);
        assert_non_null(strstr(asked_logged, ".txt"));
    }
    asked_expect(GATE " --expectations known.txt --update",
                 "memory 0; run -; print 1 files, update; ", RG_EXIT_PASS);
    asked_expect(GATE " --fails fails.txt --update", "memory 0; run -; print 1 files, update; ",
                 RG_EXIT_PASS);
    asked_expect(GATE " --flakes fails.txt --update", "memory 0; ", RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "--update: there is no file to write; name one by "
                                      "--expectations or --fails");
    asked_expect(SHARD " --fails fails.txt --update", "memory 0; ", RG_EXIT_USAGE);
    assert_string_equal(asked_logged,
                        "--update: a filter or a shard runs some of the cells, and the files are "
                        "of all; run the gate without it, or update by --from");
    asked_expect(GATE " --budget x", "memory 0; ", RG_EXIT_USAGE);
    asked_expect(GATE " --fails none", "memory 0; ", RG_EXIT_USAGE);
    asked_expect("gate cpu cpu:reference --cells none", "memory 0; ", RG_EXIT_USAGE);
}

// --- shards together ---

#define FROM "memory 0; gate records of in; "

static void shards_are_reported_together(void **state)
{
    (void)state;
    asked_expect("gate --from in", FROM "merge 2; print 0 files; free 2", RG_EXIT_PASS);
    asked_expect("gate --from in --fails fails.txt --update",
                 FROM "merge 2; print 1 files, update; free 2", RG_EXIT_PASS);
    asked_expect("gate --from in --fails fails.txt --flakes known.txt", FROM "free 2",
                 RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "in: its shards had other expectations; name those that they "
                                      "had, or none");
    gate_ends = RG_EXIT_INCONCLUSIVE;
    asked_expect("gate --from in", FROM "merge 2; print 0 files; free 2", RG_EXIT_INCONCLUSIVE);
    gate_beyond = RG_EXIT_FAIL;
    asked_expect("gate --from in", FROM "merge 2; print 0 files; free 2", RG_EXIT_FAIL);
    gate_beyond = gate_ends = RG_EXIT_PASS;
    broken = "print";
    asked_expect("gate --from in", FROM "merge 2; print 0 files; free 2", RG_EXIT_USAGE);
    broken = "merge";
    asked_expect("gate --from in", FROM "merge 2; free 2", RG_EXIT_USAGE);
    broken = "parts";
    asked_expect("gate --from in", FROM "free 2", RG_EXIT_USAGE);
    broken = NULL;
    is_found = false;
    asked_expect("gate --from in --fails fails.txt", FROM "free 0", 104);
    asked_expect("gate --from in --partial", FROM "free 0", RG_EXIT_NOTHING);
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, begin, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(a_gate_ends_as_it_was_found),
        ASKED(what_did_not_end_leaves_no_record),
        ASKED(a_folder_is_held),
        ASKED(times_divide_the_cells),
        ASKED(inputs_are_spared),
        ASKED(shards_are_reported_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
