#include "harness/commands/comparing/outputs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/files/file.h"
#include "core/base/log.h"
#include "harness/compare/gate/pictures/pictures.h"
#include "harness/compare/gate/run/keep.h"
#include "harness/compare/gate/run/kept.h"
#include "harness/record/output.h"

bool rg_gate_outputs_settle(const char *junit, const char *pictures,
                            const struct rg_gtest_asked *gtest, struct rg_gate_outputs *outputs)
{
    enum { ROOM = PATH_MAX - sizeof("-pictures") };
    outputs->prints_gtest = gtest->filter || gtest->output;
    if (!rg_gtest_output(gtest, outputs->junit))
        return false;
    if (junit)
        snprintf(outputs->junit, PATH_MAX, "%s", junit);
    const char *file = outputs->junit, *end = strrchr(file, '.');
    const size_t length = strlen(file);
    const size_t stem = end && !strcmp(end, ".xml") ? (size_t)(end - file) : length;
    if (length >= ROOM || (pictures && strlen(pictures) >= ROOM))
        return rg_error("%.80s...: is too long a path; choose a shorter one",
                        pictures ? pictures : file);
    if (pictures)
        snprintf(outputs->pictures, PATH_MAX, "%s", pictures);
    else if (length)
        snprintf(outputs->pictures, PATH_MAX, "%.*s-pictures", (int)stem, file);
    return true;
}

static bool spares(const char *report, const char *file)
{
    return !report || !*report || !file || !rg_file_is_same(report, file) ||
           rg_error("%s: would be overwritten with a report, and is named as '%s' as well; name "
                    "another file for the report",
                    report, file);
}

// Whether a file is not among those that the gate stores in its folder.
static bool spares_kept(const char *folder, const char *file)
{
    static const char *const names[] = {RG_GATE_JOURNAL, RG_GATE_LAUNCHES};
    bool ok = true;
    for (int i = 0; ok && *folder && i < 2; i++) {
        char path[PATH_MAX + 32];
        snprintf(path, sizeof(path), "%s/%s", folder, names[i]);
        ok = spares(path, file);
    }
    return ok;
}

// The file of GitHub's summary, NULL if there is none.
static const char *summary_path(const struct rg_gate_outputs *outputs)
{
    const char *path = outputs->github ? getenv("GITHUB_STEP_SUMMARY") : NULL;
    return path && *path ? path : NULL;
}

// The summary is appended to, which damages an input or output file just as much.
bool rg_gate_outputs_spare(const struct rg_gate_outputs *outputs, const char *file)
{
    return spares(outputs->junit, file) && spares(outputs->bmf, file) &&
           spares(summary_path(outputs), file) && spares_kept(outputs->pictures, file);
}

bool rg_gate_outputs_can_be_written(const struct rg_gate_outputs *outputs)
{
    enum { REPORT_BYTES = 1 << 20 };
    const char *summary = summary_path(outputs);
    return spares(outputs->junit, outputs->bmf) && spares(summary, outputs->bmf) &&
           (!*outputs->junit || spares(summary, outputs->junit)) &&
           spares_kept(outputs->pictures, summary) && (!summary || rg_report_can_append(summary)) &&
           (!*outputs->junit || rg_output_file_can_be_written(outputs->junit, REPORT_BYTES)) &&
           (!outputs->bmf || rg_output_file_can_be_written(outputs->bmf, REPORT_BYTES)) &&
           (!*outputs->pictures || rg_gate_pictures_can_be_written(outputs->pictures, 0));
}

// --- printing ---

// Prints the changes that would bring the expectation files up to date; the first file gets new
// failures.
static bool print_patches(const struct rg_known *known, const struct rg_gate *gate, int today)
{
    bool ok = true, adds_new = true;
    for (int file = 0; ok && file < known->file_count; file++) {
        const enum rg_known_form form = known->files[file].form;
        if (form != RG_FORM_OWN && form != RG_FORM_FAILS)
            continue;
        ok =
            rg_known_patch(known, file, gate->results, gate->result_count, today, adds_new, stdout);
        adds_new = false;
    }
    return ok;
}

static bool print_text(const struct rg_known *known, const struct rg_gate *gate, int today)
{
    fputs(gate->note ? gate->note : "", stdout);
    return rg_report_text(&gate->report, stdout) && print_patches(known, gate, today);
}

static bool print_github(const struct rg_gate_outputs *outputs, const struct rg_report *report)
{
    const char *summary = summary_path(outputs);
    return rg_report_annotations(report, stdout) &&
           (!summary || rg_report_append_markdown(report, summary));
}

bool rg_gate_outputs_print(const struct rg_gate_outputs *outputs, const struct rg_known *known,
                           const struct rg_gate *gate)
{
    const struct rg_report *report = &gate->report;
    bool ok = true;
    if (*outputs->junit)
        ok = rg_report_write(report, rg_report_junit, outputs->junit);
    if (outputs->bmf)
        ok = rg_report_write(report, rg_report_bmf, outputs->bmf) && ok;
    if (outputs->json)
        return rg_report_json(report, stdout) && ok;
    ok = (outputs->prints_gtest ? rg_gtest_print(report, stdout)
                                : print_text(known, gate, outputs->today)) &&
         ok;
    return (!outputs->github || print_github(outputs, report)) && ok;
}
