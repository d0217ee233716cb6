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

// Whether a file still has the bytes that were read.
static bool is_unchanged(const struct rg_lines *lines)
{
    struct rg_lines now;
    const bool is_read = rg_lines_read(lines->name, &now);
    const bool is_same =
        is_read && now.size == lines->size && !memcmp(now.raw, lines->raw, now.size);
    rg_lines_free(&now);
    if (is_read && !is_same)
        rg_error("%s: was changed while the gate ran, and stays; run it again", lines->name);
    return is_same;
}

static bool mend_file(const struct rg_gate_outputs *outputs, const char *text,
                      const struct rg_lines *lines)
{
    if (!outputs->updates)
        return printf("%s: is not true of this run; --update writes it anew\n", lines->name) > 0;
    if (!is_unchanged(lines) || !rg_output_write_file(lines->name, text))
        return false;
    rg_info("%s: written anew; `git diff` shows what changed", lines->name);
    return true;
}

// What would make the files of expected failures true; the first gets failures that are new.
static bool mend_files(const struct rg_gate_outputs *outputs, const struct rg_known *known,
                       const struct rg_gate *gate)
{
    bool ok = true, adds_new = true;
    for (int file = 0; ok && file < known->file_count; file++) {
        char *text;
        ok = rg_known_mend(known, file, gate->results, gate->result_count, outputs->today, adds_new,
                           &text);
        if (text)
            ok = mend_file(outputs, text, &known->files[file].lines);
        free(text);
        adds_new = false;
    }
    return ok;
}

static bool print_text(const struct rg_gate *gate)
{
    fputs(gate->note ? gate->note : "", stdout);
    return rg_report_text(&gate->report, stdout);
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
        ok = rg_report_json(report, stdout) && ok;
    else if (outputs->prints_gtest)
        ok = rg_gtest_print(report, stdout) && ok;
    else
        ok = print_text(gate) && ok;
    if (outputs->updates || (!outputs->json && !outputs->prints_gtest))
        ok = mend_files(outputs, known, gate) && ok;
    return (!outputs->github || print_github(outputs, report)) && ok;
}
