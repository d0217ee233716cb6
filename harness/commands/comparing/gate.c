// raingauge gate: tells whether one device is worse than another, or than a baseline: other
// pictures, states or counters, or slower by a margin.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shard.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/comparing/outputs.h"
#include "harness/compare/gate/cells/unused.h"
#include "harness/compare/gate/report/gtest.h"
#include "harness/compare/gate/shards/shards.h"
#include "harness/console/duration.h"
#include "harness/console/started.h"
#include "harness/devices/drivers/side.h"
#include "harness/devices/names.h"
#include "harness/devices/workers/worker.h"
#include "harness/record/disk/hold.h"
#include "harness/record/output.h"

struct gate_options {
    char *against;                   // another build; NULL: two devices, or a baseline
    char *baseline;                  // a file; NULL: both sides run
    struct rg_devices_asked devices; // of both builds, or compared with the baseline
    char *cells;                     // a file; NULL: the built-in ones
    double margin_percent;           // 0: not given
    char *budget;                    // "2m"; NULL: none
    struct rg_words known[RG_FORMS]; // files of expectations, of Mesa's fails, flakes and skips
    struct rg_reports_asked reports;
    char *pictures; // a folder for those that differ; NULL: next to JUnit's file
    struct rg_gtest_asked gtest;
    int64_t memory_bytes;
    bool pictures_only, strict, fresh, update, partial;
    char *shard, *times, *from; // NULL: none
};

#define AT(field) offsetof(struct gate_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to compare"),
    {RG_OPTION_OPERAND, .argument = "A B",
     .about = "two devices; the gate judges B against A. A device may have its own environment "
              "variables or driver, such as 'new=vulkan@DRIVER=PREFIX'",
     .names = RG_NAMES_DEVICE, .first = 1, .last = 2},
    {RG_OPTION_TEXT, "against", .argument = "BINARY",
     .about = "judges this build's devices against the same devices under another raingauge build, "
              "instead of A and B",
     .offset = AT(against), .names = RG_NAMES_FILE},
    {RG_OPTION_TEXT, "baseline", .argument = "FILE",
     .about =
         "judges devices against a baseline that `raingauge baseline -o` wrote, instead of A and B",
     .offset = AT(baseline), .names = RG_NAMES_FILE, .excludes = "against"},
    RG_INCLUDE(rg_devices_option, AT(devices.names), NULL),
    RG_INCLUDE(rg_asked_options, AT(devices), NULL),
    {RG_OPTION_TEXT, "cells", .argument = "FILE",
     .about = "a file of cells to run, one a line (docs/expectations.md); without this option, the "
              "built-in cells",
     .offset = AT(cells), .names = RG_NAMES_FILE},
    {RG_OPTION_FACTOR, "margin", .argument = "PERCENT",
     .about = "the percentage by which B's frames may take longer. Default: 5, or 10 against a "
              "baseline, because whole runs differ in speed",
     .offset = AT(margin_percent), .most = 100},
    {RG_OPTION_FLAG, "pictures", .about = "compares pictures, states and counters, but no times",
     .offset = AT(pictures_only), .excludes = "margin budget"},
    {RG_OPTION_TEXT, "budget", .argument = "TIME",
     .about =
         "ends the gate this long after its start, such as 90s or 4m. Cells that are undecided by "
         "then are inconclusive; the gate refuses a time too short for any verdict",
     .offset = AT(budget)},
    {RG_OPTION_FLAG, "strict",
     .about = "also fails if a fixed function of B's driver differs from A's, or from the "
              "baseline's, within what the APIs allow (docs/native.md)",
     .offset = AT(strict), .excludes = "against"},
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Shards (docs/ci.md)"),
    RG_INCLUDE(rg_shard_option, AT(shard), NULL),
    {RG_OPTION_TEXT, "times", .argument = "FILE",
     .about = "divides the cells by how long each took in an earlier gate; FILE is that gate's "
              "--json output",
     .offset = AT(times), .names = RG_NAMES_FILE, .excludes = "from"},
    {RG_OPTION_TEXT, "from", .argument = "FILE|DIR",
     .about = "reports what all shards together found, instead of running cells; DIR is the folder "
              "of their -o",
     .offset = AT(from), .names = RG_NAMES_FILE,
     .excludes =
         "against baseline device require timeout cells margin pictures strict budget fresh shard "
         "gtest_filter gtest_list_tests"},
    {RG_OPTION_FLAG, "partial", .about = "reports even if shards are missing",
     .offset = AT(partial), .excludes = "update"},
    RG_GROUP("Known failures"),
    {RG_OPTION_TEXTS, "expectations", .argument = "FILE",
     .about = "a file of expected failures, flakes and skips (docs/expectations.md)",
     .offset = AT(known[RG_FORM_OWN]), .names = RG_NAMES_FILE},
    {RG_OPTION_TEXTS, "fails", .argument = "FILE",
     .about = "a file of expected failures, in the format of Mesa's *-fails.txt",
     .offset = AT(known[RG_FORM_FAILS]), .names = RG_NAMES_FILE},
    {RG_OPTION_TEXTS, "flakes", .argument = "FILE",
     .about = "a file of expected flakes, in the format of Mesa's *-flakes.txt",
     .offset = AT(known[RG_FORM_FLAKES]), .names = RG_NAMES_FILE},
    {RG_OPTION_TEXTS, "skips", .argument = "FILE",
     .about = "a file of cells to skip, in the format of Mesa's *-skips.txt",
     .offset = AT(known[RG_FORM_SKIPS]), .names = RG_NAMES_FILE},
    {RG_OPTION_FLAG, "update",
     .about = "rewrites the files of --expectations and --fails to match this run; `git diff` "
              "shows the changes",
     .offset = AT(update), .excludes = "gtest_filter gtest_list_tests"},
    RG_GROUP("Output"),
    {RG_OPTION_TEXT, "output", .argument = "DIR",
     .about = "writes differing pictures of A and B with heat maps, and every launch, into this "
              "folder. After Ctrl-C the same command continues from there. Without this option, "
              "--junit FILE puts pictures into FILE-pictures",
     .offset = AT(pictures), .letter = 'o', .names = RG_NAMES_FOLDER},
    {RG_OPTION_FLAG, "fresh",
     .about = "begins anew, and ignores the launches stored in the folder of -o",
     .offset = AT(fresh)},
    RG_INCLUDE(rg_report_options, AT(reports), NULL),
    RG_INCLUDE(rg_gtest_options, AT(gtest), NULL),
    {RG_OPTION_END},
};

// --- inputs ---

static bool read_known(const struct gate_options *o, struct rg_known *known)
{
    bool ok = true;
    for (int form = RG_FORM_OWN; form < RG_FORMS; form++)
        for (int i = 0; ok && i < o->known[form].count; i++)
            ok = rg_known_add(known, o->known[form].items[i], (enum rg_known_form)form);
    return ok;
}

static int today(void)
{
    return (int)(time(NULL) / (24 * 60 * 60));
}

// --- output ---

// The inputs: pairs of sides, or a baseline.
struct gate_input {
    struct rg_gate_pairs pairs;
    struct rg_baseline baseline;
    struct rg_gate_cells cells;
    struct rg_known known;
};

static int list_cases(const struct gate_options *o, const struct gate_input *in)
{
    const struct rg_gate_request request = {.cells = &in->cells,
                                            .pairs = &in->pairs,
                                            .baseline = o->baseline ? &in->baseline : NULL,
                                            .filter = o->gtest.filter,
                                            .shard = {1, 1}};
    struct rg_gate gate = {.case_count = 0};
    const bool ok = rg_gate_list(&request, &gate);
    rg_gtest_list(stdout, gate.names);
    rg_gate_free(&gate);
    return ok ? RG_EXIT_PASS : rg_exit_of_error();
}

// Whether no report replaces an input file of the gate.
static bool spares_inputs(const struct gate_options *o, const struct rg_gate_outputs *outputs)
{
    bool ok = rg_gate_outputs_spare(outputs, o->cells) &&
              rg_gate_outputs_spare(outputs, o->baseline) &&
              rg_gate_outputs_spare(outputs, o->times);
    for (int form = RG_FORM_OWN; form < RG_FORMS; form++)
        for (int i = 0; ok && i < o->known[form].count; i++)
            ok = rg_gate_outputs_spare(outputs, o->known[form].items[i]);
    return ok;
}

// Checks before any work that the files of expectations can be written anew.
static bool can_update(const struct gate_options *o, const struct rg_gate_request *request)
{
    enum { KNOWN_BYTES = 1 << 16 };
    bool ok = true, any = false;
    for (int form = RG_FORM_OWN; o->update && form <= RG_FORM_FAILS; form++)
        for (int i = 0; ok && i < o->known[form].count; i++, any = true)
            ok = rg_output_file_can_be_written(o->known[form].items[i], KNOWN_BYTES);
    if (!ok || !o->update)
        return ok;
    if (!any)
        return rg_error("--update: there is no file to write; name one by --expectations or "
                        "--fails");
    return (!request->filter && request->shard.count <= 1) ||
           rg_error("--update: a filter or a shard runs some of the cells, and the files are of "
                    "all; run the gate without it, or update by --from");
}

// --- the command ---

// The folder for launches: that of -o, or a shard's own one in it, for shards share that of -o. ""
// without any. False, with one logged line, if it cannot be made.
static bool folder_of(const struct gate_options *o, const struct rg_gate_request *request,
                      char folder[PATH_MAX])
{
    *folder = 0;
    if (!o->pictures)
        return true;
    if (o->shard)
        return rg_output_folder(o->pictures) &&
               (snprintf(folder, PATH_MAX, "%s/%d-of-%d", o->pictures, request->shard.number,
                         request->shard.count) < PATH_MAX ||
                rg_error("-o %.80s...: is too long a path; choose a shorter one", o->pictures));
    snprintf(folder, PATH_MAX, "%s", o->pictures);
    return true;
}

// Runs it in a folder that no other raingauge writes into meanwhile.
static int run_held(const struct gate_options *o, struct rg_gate_request *request,
                    struct rg_gate *gate)
{
    struct rg_hold hold = {.fd = -1};
    char folder[PATH_MAX];
    if (!folder_of(o, request, folder))
        return rg_exit_of_error();
    request->folder = *folder ? folder : NULL;
    request->fresh = o->fresh;
    if (*folder && !rg_hold_folder(folder, &hold)) {
        rg_error("%s: another raingauge writes into it; wait until it has ended, or name another "
                 "folder",
                 folder);
        return rg_exit_of_error();
    }
    const int exit = rg_gate_run(request, gate);
    rg_hold_release(&hold);
    return exit;
}

// The devices that this gate leaves out: their expectations may remain unused.
static struct rg_gate_left left_of(const struct gate_options *o, const struct gate_input *in)
{
    struct rg_gate_left left = {0};
    for (int i = 0; i < in->baseline.device_count; i++)
        if (!rg_baseline_asks(o->devices.names, in->baseline.devices[i].name))
            left.names[left.count++] = in->baseline.devices[i].name;
    if (o->against)
        rg_gate_pairs_left(&in->pairs, &left);
    return left;
}

// Which cases it has, in shards of this gate or of googletest.
static bool find_shard(const struct gate_options *o, struct rg_gate_request *request)
{
    struct rg_gtest_shards shards;
    if (o->shard)
        return rg_shard_read(o->shard, 0, &request->shard) &&
               (o->pictures ||
                rg_error("--shard: name the folder of its record, as -o gate, which all shards "
                         "share"));
    if (!rg_gtest_shards(&shards))
        return false;
    request->shard = (struct rg_shard){shards.index + 1, shards.total};
    request->is_apart = true;
    return true;
}

// Reads what divides the cells, and digests of what decides about them, in which all shards agree.
static bool read_inputs(const struct gate_options *o, const struct gate_input *in,
                        struct rg_gate_request *request, struct rg_gate_inputs *inputs)
{
    json_t *times = o->times ? rg_gate_times_read(o->times) : NULL;
    request->times = times;
    rg_gate_digest_known(&in->known, inputs->expectations);
    return (!o->times || (times && rg_gate_digest_file(o->times, inputs->times))) &&
           (!o->baseline || rg_gate_digest_file(o->baseline, inputs->baseline));
}

// Prints a gate's report, and leaves the record of a shard that came to its end. Returns the final
// enum rg_exit.
static int tell(const struct gate_options *o, const struct gate_input *in,
                const struct rg_gate_request *request, const struct rg_gate_inputs *inputs,
                const struct rg_gate_outputs *outputs, const struct rg_gate *gate, int exit)
{
    const bool is_done = exit < RG_EXIT_SIGNALLED && exit != RG_EXIT_USAGE;
    const int beyond = rg_exit_worse(gate->beyond, in->pairs.left_out);
    if (!gate->is_told)
        return exit;
    if (!rg_gate_outputs_print(outputs, &in->known, gate))
        exit = rg_exit_worse(exit, rg_exit_of_error()); // a full disk is no regression
    if (o->shard && is_done && !rg_gate_part_write(request, inputs, gate, beyond, o->pictures))
        exit = rg_exit_worse(exit, rg_exit_of_error());
    return exit;
}

static int run(const struct gate_options *o, const struct gate_input *in)
{
    struct rg_gate gate = {.case_count = 0};
    struct rg_gate_inputs inputs = {{0}, {0}, {0}};
    struct rg_gate_outputs outputs = {
        .updates = o->update, .is_part = o->shard != NULL, .today = today()};
    const double margin = o->baseline ? rg_gate_rule_apart(1).margin : rg_gate_rule_of(1).margin;
    struct rg_gate_request request = {.cells = &in->cells,
                                      .pairs = &in->pairs,
                                      .baseline = o->baseline ? &in->baseline : NULL,
                                      .known = &in->known,
                                      .require = o->devices.require,
                                      .left = left_of(o, in),
                                      .today = today(),
                                      .begin_ms = rg_started_ms(),
                                      .margin =
                                          o->margin_percent > 0 ? o->margin_percent / 100 : margin,
                                      .pictures_only = o->pictures_only,
                                      .strict = o->strict,
                                      .filter = o->gtest.filter};
    int exit;
    if (find_shard(o, &request) &&
        rg_gate_outputs_settle(&o->reports, o->pictures, &o->gtest,
                               request.is_apart && request.shard.count > 1, &outputs) &&
        spares_inputs(o, &outputs) &&
        (!o->budget || rg_duration_read(o->budget, "--budget", &request.budget_s)) &&
        rg_gate_outputs_can_be_written(&outputs) && can_update(o, &request) &&
        read_inputs(o, in, &request, &inputs)) {
        request.pictures = *outputs.pictures ? outputs.pictures : NULL;
        exit = run_held(o, &request, &gate);
        exit = tell(o, in, &request, &inputs, &outputs, &gate, exit);
    } else {
        exit = rg_exit_of_error();
    }
    json_decref((json_t *)request.times);
    rg_gate_free(&gate);
    return exit;
}

// Finds the pairs to compare. Returns an enum rg_exit, with one logged line unless it is pass.
static int find_pairs(const struct gate_options *o, const struct rg_words *sides,
                      struct rg_gate_pairs *pairs)
{
    if (o->against && !sides->count)
        return rg_gate_pairs_of_builds(o->against, o->devices.names ? o->devices.names : "all",
                                       pairs);
    if (o->baseline && !sides->count)
        return RG_EXIT_PASS;
    *pairs = (struct rg_gate_pairs){.count = 1};
    if (sides->count && (o->against || o->baseline))
        rg_error("gate: '%s' is a device of a pair, and --%s has pairs of its own; name devices "
                 "by --device",
                 sides->items[0], o->against ? "against" : "baseline");
    else if (o->devices.names && !o->against && !o->baseline)
        rg_error("gate: --device is of --against and --baseline; name two devices alone");
    else if (sides->count != 2)
        rg_error("gate: name two devices, the one that B is held against first, as in `raingauge "
                 "gate cpu cpu@OMP_NUM_THREADS=1`, or another build by --against, or a file by "
                 "--baseline");
    else if (rg_gate_pair_of(sides->items[0], sides->items[1], &pairs->all[0]))
        return RG_EXIT_PASS;
    return rg_exit_of_error();
}

// A gate that must compare times fails if the baseline has none.
static bool has_times(const struct gate_options *o, const struct rg_baseline *baseline)
{
    bool any = o->pictures_only || o->gtest.list;
    for (int i = 0; !any && i < baseline->count; i++)
        any = baseline->rows[i].launches.count > 0 &&
              rg_baseline_asks(o->devices.names, baseline->rows[i].device);
    return any || rg_error("%s: has no times of what is asked; give --pictures, or make it anew "
                           "without that",
                           o->baseline);
}

static bool can_search(const struct gate_input *in)
{
    bool ok = true;
    for (int64_t i = 0; ok && i < in->cells.count; i++)
        ok = rg_known_can_search(&in->known, in->cells.cells[i].name);
    return ok;
}

// Each device of the baseline that is asked for is a B without an A.
static void pair_devices(const struct gate_options *o, const struct rg_baseline *baseline,
                         struct rg_gate_pairs *pairs)
{
    for (int i = 0; i < baseline->device_count; i++) {
        const char *name = baseline->devices[i].name;
        if (rg_baseline_asks(o->devices.names, name))
            memcpy(pairs->all[pairs->count++].names[RG_SIDE_B], name, RG_DEVICE_NAME_SIZE);
    }
}

// A baseline keeps only the short name of a device; --device has to say what the name stands for.
static bool knows_devices(const char *path, const struct rg_gate_pairs *pairs)
{
    for (int i = 0; i < pairs->count; i++) {
        const char *name = pairs->all[i].names[RG_SIDE_B];
        if (!rg_backend_of(rg_device_name_full(name)))
            return rg_error("%s: its device '%s' is a short name, and the file does not say of "
                            "what; add --device %s=DEVICE with all that are to run",
                            path, name, name);
    }
    return true;
}

static bool read_baseline(const struct gate_options *o, struct gate_input *in)
{
    if (!rg_baseline_read(&in->baseline, o->baseline) ||
        !rg_baseline_fits(&in->baseline, o->baseline, &in->cells,
                          o->cells ? o->cells : "built-in cells", o->devices.names))
        return false;
    pair_devices(o, &in->baseline, &in->pairs);
    return knows_devices(o->baseline, &in->pairs) && has_times(o, &in->baseline);
}

static bool read_input(const struct gate_options *o, struct gate_input *in)
{
    const bool is_read =
        rg_gate_cells_read(o->cells, &in->cells) && read_known(o, &in->known) && can_search(in);
    if (is_read && !o->gtest.list) {
        rg_gate_warn_of_unused(&in->known, &in->cells);
        rg_gate_warn_of_days(&in->known, today());
    }
    return is_read && (!o->baseline || read_baseline(o, in));
}

// Whether no option is about what is not there.
static bool are_of_use(const struct gate_options *o)
{
    return (!o->partial || rg_error("--partial: is about the records of shards; name them by "
                                    "--from, or leave it out")) &&
           (!o->times || o->shard ||
            rg_error("--times: divides the cells among shards; add --shard, or leave it out"));
}

// A gate that compares no fixed functions cannot be strict about them.
static bool can_be_strict(const struct gate_options *o, const struct gate_input *in)
{
    bool any = !o->strict;
    for (int i = 0; !any && i < in->pairs.count; i++)
        any = rg_gate_has_fixed(o->baseline ? &in->baseline : NULL, &in->pairs.all[i]);
    return any || rg_error("--strict: is about fixed functions, and this gate compares none; name "
                           "two drivers of an API or a baseline with digests of them, or leave it "
                           "out");
}

// --- shards together ---

// Files of expectations are held against what the shards found only if they had the same
// (rg_gate_digest_known).
static bool had_known(const struct gate_options *o, const struct rg_known *known,
                      const struct rg_parts *parts)
{
    const char *had = rg_json_text_of(parts->of, "expectations");
    char digest[RG_DIGEST_SIZE];
    rg_gate_digest_known(known, digest);
    return !known->file_count || !strcmp(digest, had) ||
           rg_error("%s: its shards had other expectations; name those that they had, or none",
                    o->from);
}

static int report_parts(const struct gate_options *o, const struct rg_known *known,
                        const struct rg_parts *parts, const struct rg_gate_outputs *outputs)
{
    const struct rg_gate_request whole = {.shard = {1, 1}};
    struct rg_gate gate = {.case_count = 0};
    int exit = rg_shards_exit(parts, "gate", o->from, o->partial);
    if (exit == RG_EXIT_PASS && rg_gate_merge(parts, &gate)) {
        exit = rg_exit_worse(rg_gate_exit(&whole, &gate), gate.beyond);
        if (!rg_gate_outputs_print(outputs, known, &gate))
            exit = rg_exit_worse(exit, rg_exit_of_error());
    } else if (exit == RG_EXIT_PASS) {
        exit = rg_exit_of_error();
    }
    rg_gate_free(&gate);
    return exit;
}

// Reports what all shards found, from their records.
static int merge(const struct gate_options *o, const struct rg_words *sides)
{
    struct rg_gate_outputs outputs = {.updates = o->update, .today = today()};
    const struct rg_gate_request whole = {.shard = {1, 1}};
    struct rg_parts parts = {0};
    struct rg_known known = {.file_count = 0};
    const bool ok =
        (!sides->count ||
         rg_error("--from: the shards had their devices; leave out '%s'", sides->items[0])) &&
        read_known(o, &known) &&
        rg_gate_outputs_settle(&o->reports, o->pictures, &o->gtest, false, &outputs) &&
        spares_inputs(o, &outputs) && rg_gate_outputs_can_be_written(&outputs) &&
        can_update(o, &whole) && rg_parts_read(&parts, "gate", o->from) &&
        (!parts.count || had_known(o, &known, &parts));
    const int exit = ok ? report_parts(o, &known, &parts, &outputs) : rg_exit_of_error();
    rg_parts_free(&parts);
    rg_known_free(&known);
    return exit;
}

static int gate(const void *values, const struct rg_words *arguments)
{
    struct gate_options asked = *(const struct gate_options *)values;
    const struct gate_options *o = &asked;
    struct gate_input in = {.pairs = {.count = 0}};
    rg_gtest_inherit(&asked.gtest);
    rg_memory_allow(o->memory_bytes);
    if (o->from)
        return merge(o, arguments);
    rg_workers.timeout_s = o->devices.timeout_s;
    rg_sides_begin();
    int exit = find_pairs(o, arguments, &in.pairs);
    if (exit == RG_EXIT_PASS && (!are_of_use(o) || !read_input(o, &in) || !can_be_strict(o, &in)))
        exit = rg_exit_of_error();
    if (exit == RG_EXIT_PASS)
        exit = rg_exit_worse(o->gtest.list ? list_cases(o, &in) : run(o, &in), in.pairs.left_out);
    rg_baseline_free(&in.baseline);
    rg_known_free(&in.known);
    rg_gate_cells_free(&in.cells);
    return exit;
}

const struct rg_command rg_command_gate = {
    .name = "gate",
    .reader = RG_FOR_DRIVERS,
    .usage = "{A B | {--against BINARY | --baseline FILE} [--device D,...|all]} [--require D,...] "
             "[--cells FILE] [--margin PERCENT] [--budget TIME] [--pictures] [--strict] [--shard "
             "I/N|auto] "
             "[--expectations FILE]... [--update] [--junit FILE] [--bmf FILE] [--github] [--json]"
             "  |  --from FILE|DIR [--partial] [--junit FILE]...",
    .about =
        "tells whether device B draws different pictures from device A or a baseline, or is slower",
    .options = options,
    .options_size = sizeof(struct gate_options),
    .run = gate,
};
