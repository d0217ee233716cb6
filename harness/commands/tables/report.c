// raingauge report: records as one page.
#include <stdio.h>
#include <stdlib.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/record/output.h"
#include "harness/report/report.h"

struct report_options {
    char *against; // NULL: nothing is compared
    char *output;  // NULL: report.html, or standard output for the short forms
    int format;    // index into `formats`
    int64_t memory_bytes;
};

#define AT(field) offsetof(struct report_options, field)

enum { FORMAT_HTML, FORMAT_MD, FORMAT_BADGE };
static const char *const formats[] = {"html", "md", "badge", NULL};

static const struct rg_option options[] = {
    RG_GROUP("What to show"),
    {RG_OPTION_OPERAND, .argument = "RECORDS...",
     .about = "files or folders of the JSON that commands wrote: tables, gates, baselines, diffs, "
              "verify, doctor, render; a text of Markdown gives the pictures that it shows",
     .names = RG_NAMES_FILE, .first = 1},
    {RG_OPTION_TEXT, "against", .argument = "RECORDS",
     .about = "a file or folder of earlier records: the page shows what changed since",
     .offset = AT(against), .names = RG_NAMES_FILE},
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_CHOICE, "format",
     .about = "a page; Markdown below 60 kB for a merge request; a badge as SVG",
     .offset = AT(format), .choices = formats, .initial = "html"},
    {RG_OPTION_TEXT, "output", .argument = "FILE",
     .about = "where to write it; without it a page is report.html, and the others are printed",
     .offset = AT(output), .letter = 'o', .names = RG_NAMES_FILE},
    {RG_OPTION_END},
};

static bool write_page(const struct rg_page *page, const struct rg_page *before, const char *path)
{
    const size_t count = json_array_size(page->records);
    return rg_page_write(page, before, path) && printf("%s: %zu record%s; open it in a browser\n",
                                                       path, count, count == 1 ? "" : "s") > 0;
}

// Writes or prints a short form.
static bool write_brief(const struct rg_page *page, const struct report_options *o)
{
    char *text = o->format == FORMAT_MD ? rg_page_markdown(page) : rg_page_badge(page);
    bool ok = text != NULL;
    if (ok && o->output)
        ok = rg_output_write_file(o->output, text);
    else if (ok)
        ok = fputs(text, stdout) >= 0;
    free(text);
    return ok;
}

static int report(const void *values, const struct rg_words *arguments)
{
    const struct report_options *o = values;
    struct rg_page page = {0}, before = {0};
    rg_memory_allow(o->memory_bytes);
    bool ok = arguments->count > 0 ||
              rg_error("report: names no records; name files or folders, such as results/tables");
    for (int i = 0; ok && i < arguments->count; i++)
        ok = rg_page_add(&page, arguments->items[i]);
    ok = ok && (!o->against || rg_page_add(&before, o->against));
    ok = ok && (o->format == FORMAT_HTML ? write_page(&page, o->against ? &before : NULL,
                                                      o->output ? o->output : "report.html")
                                         : write_brief(&page, o));
    const int exit = ok ? RG_EXIT_PASS : rg_exit_of_error();
    rg_page_free(&page);
    rg_page_free(&before);
    return exit;
}

const struct rg_command rg_command_report = {
    .name = "report",
    .usage = "RECORDS... [--against RECORDS] [--format html|md|badge] [-o FILE]",
    .about = "shows records as one page for people: tables, claims, gates, pictures",
    .options = options,
    .options_size = sizeof(struct report_options),
    .run = report,
};
