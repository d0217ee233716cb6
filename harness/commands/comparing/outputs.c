#include "harness/commands/comparing/outputs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/files/file.h"
#include "core/base/log.h"
#include "harness/compare/gate/pictures/pictures.h"
#include "harness/compare/gate/sides/journal.h"
#include "harness/record/output.h"
#include "harness/report/page.h"

#define AT_FILE(id) offsetof(struct rg_reports_asked, files[RG_AS_##id])
#define AT_FLAG(id) offsetof(struct rg_reports_asked, flags[RG_AS_##id])

// The option of a form, by its destination.
#define OPTION(id, where, ...) OPTION_##where(id, __VA_ARGS__)
#define OPTION_FILE(id, text, says, without, write)                                                \
    {RG_OPTION_TEXT,        text,                                                                  \
     .argument = "FILE",    .about = says,                                                         \
     .offset = AT_FILE(id), .names = RG_NAMES_FILE,                                                \
     .excludes = without},
#define OPTION_INSTEAD(id, text, says, without, write)                                             \
    {RG_OPTION_FLAG, text, .about = says, .offset = AT_FLAG(id), .excludes = without},
#define OPTION_BELOW OPTION_INSTEAD
#define OPTION_DEFAULT(...)
#define OPTION_APPENDED(...)

const struct rg_option rg_report_options[] = {RG_REPORT_FORMS(OPTION){RG_OPTION_END}};

// Chooses the forms to write, and their destinations.
static void choose(const struct rg_reports_asked *asked, bool prints_gtest,
                   struct rg_gate_outputs *outputs)
{
    bool is_printed = false;
    for (int i = 0; i < RG_REPORT_FORM_COUNT; i++) {
        const struct rg_report_form *form = &rg_report_forms[i];
        bool *is_written = &outputs->are_written[i];
        const char **file = &outputs->files[i];
        if (form->where == RG_WHERE_FILE)
            *file = i == RG_AS_JUNIT && *outputs->junit ? outputs->junit : asked->files[i];
        if (i > 0 && form->where == RG_WHERE_APPENDED && outputs->are_written[i - 1])
            *file = getenv(form->name);
        if (*file && !**file)
            *file = NULL;
        *is_written =
            *file || asked->flags[i] ||
            (form->where == RG_WHERE_DEFAULT && !is_printed && (i != RG_AS_GTEST || prints_gtest));
        is_printed |= *is_written && !*file;
    }
}

bool rg_gate_outputs_settle(const struct rg_reports_asked *asked, const char *pictures,
                            const struct rg_gtest_asked *gtest, bool is_sharded,
                            struct rg_gate_outputs *outputs)
{
    enum { ROOM = PATH_MAX - sizeof("-pictures") };
    if (!rg_gtest_output(gtest, outputs->junit))
        return false;
    if (asked->files[RG_AS_JUNIT])
        snprintf(outputs->junit, PATH_MAX, "%s", asked->files[RG_AS_JUNIT]);
    choose(asked, gtest->filter || gtest->output || is_sharded, outputs);
    const char *file = outputs->junit, *end = strrchr(file, '.');
    const size_t length = strlen(file);
    const size_t stem = end && !strcmp(end, ".xml") ? (size_t)(end - file) : length;
    if (length >= ROOM || (pictures && strlen(pictures) >= ROOM))
        return rg_error("%.80s...: is too long a path; choose a shorter one",
                        pictures ? pictures : file);
    outputs->is_folder_asked = pictures != NULL;
    if (pictures)
        snprintf(outputs->pictures, PATH_MAX, "%s", pictures);
    else if (length)
        snprintf(outputs->pictures, PATH_MAX, "%.*s-pictures", (int)stem, file);
    return true;
}

static bool spares(const char *report, const char *file)
{
    return !report || !file || !rg_file_is_same(report, file) ||
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

// A form that is appended to the file would damage it as well.
bool rg_gate_outputs_spare(const struct rg_gate_outputs *outputs, const char *file)
{
    bool ok = spares_kept(outputs->pictures, file);
    for (int i = 0; ok && i < RG_REPORT_FORM_COUNT; i++)
        ok = spares(outputs->files[i], file);
    return ok;
}

static bool can_be_written(const struct rg_report_form *form, const char *file)
{
    enum { REPORT_BYTES = 1 << 20 };
    return form->where == RG_WHERE_APPENDED ? rg_report_can_append(file, form->name)
                                            : rg_output_file_can_be_written(file, REPORT_BYTES);
}

bool rg_gate_outputs_can_be_written(const struct rg_gate_outputs *outputs)
{
    bool ok = true;
    for (int i = 0; ok && i < RG_REPORT_FORM_COUNT; i++) {
        const char *file = outputs->files[i];
        for (int other = 0; ok && file && other < i; other++)
            ok = spares(file, outputs->files[other]);
        ok = ok && spares_kept(outputs->pictures, file);
    }
    for (int i = 0; ok && i < RG_REPORT_FORM_COUNT; i++)
        ok = !outputs->files[i] || can_be_written(&rg_report_forms[i], outputs->files[i]);
    return ok && (!*outputs->pictures || rg_gate_pictures_can_be_written(outputs->pictures, 0));
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

// Writes the files of expected failures anew so that they are true, or tells how; the first file
// gets new failures.
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

static bool put(const struct rg_gate *gate, int number, const char *file)
{
    const struct rg_report_form *form = &rg_report_forms[number];
    if (form->where == RG_WHERE_FILE)
        return rg_report_write(&gate->report, form->write, file);
    if (form->where == RG_WHERE_APPENDED)
        return rg_report_append(&gate->report, form, file);
    fputs(number == RG_AS_TEXT && gate->note ? gate->note : "", stdout);
    return form->write(&gate->report, stdout);
}

// Whether the folder gets a page: if it exists, because it has pictures or launches, or if it was
// asked for and something failed.
static bool has_page(const struct rg_gate_outputs *outputs, const struct rg_report *report)
{
    struct stat found;
    int failures = 0;
    for (int i = 0; i < RG_ENDING_COUNT; i++)
        if (rg_ending_fails((enum rg_ending)i))
            failures += rg_report_count(report, (enum rg_ending)i);
    return *outputs->pictures &&
           (!stat(outputs->pictures, &found) || (outputs->is_folder_asked && failures));
}

// Writes the page next to the pictures and launches that it shows, into their folder.
static bool write_page(const struct rg_gate_outputs *outputs, const struct rg_gate *gate)
{
    char path[PATH_MAX + 32], *text = NULL;
    struct rg_page page = {0};
    size_t size;
    if (!has_page(outputs, &gate->report))
        return true;
    snprintf(path, sizeof(path), "%s/page.html", outputs->pictures);
    FILE *out = open_memstream(&text, &size);
    bool ok = (out && rg_report_json(&gate->report, out)) || rg_page_lacks_memory(path);
    ok = (!out || !fclose(out)) && ok && rg_page_add_text(&page, path, text) &&
         rg_page_write(&page, NULL, path);
    if (ok && outputs->are_written[RG_AS_TEXT] && !outputs->files[RG_AS_TEXT])
        printf("%s: the same, to look at in a browser\n", path);
    rg_page_free(&page);
    free(text);
    return ok;
}

bool rg_gate_outputs_print(const struct rg_gate_outputs *outputs, const struct rg_known *known,
                           const struct rg_gate *gate)
{
    bool ok = true;
    for (int i = 0; i < RG_REPORT_FORM_COUNT; i++)
        ok = (!outputs->are_written[i] || put(gate, i, outputs->files[i])) && ok;
    if (outputs->is_part)
        return ok;
    ok = write_page(outputs, gate) && ok;
    return (!(outputs->updates || outputs->are_written[RG_AS_TEXT]) ||
            mend_files(outputs, known, gate)) &&
           ok;
}
