// raingauge report: records as one page.
#include <stdio.h>
#include <stdlib.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/record/disk/stored.h"
#include "harness/record/output.h"
#include "harness/report/page.h"

struct report_options {
    char *against; // NULL: nothing is compared
    char *kept;    // a folder of launches; NULL: none
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
     .about = "JSON files, or folders of these, that commands wrote: tables, gates, baselines, "
              "diffs, verify, doctor, render. A Markdown file adds its pictures to the page",
     .names = RG_NAMES_FILE, .first = 1},
    {RG_OPTION_TEXT, "against", .argument = "RECORDS",
     .about = "a file or folder of earlier records: the page shows what has changed since",
     .offset = AT(against), .names = RG_NAMES_FILE},
    {RG_OPTION_TEXT, "kept", .argument = "DIR",
     .about =
         "takes verdicts on claims from launches that `raingauge claims -o` wrote into this folder",
     .offset = AT(kept), .names = RG_NAMES_FOLDER},
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_CHOICE, "format",
     .about =
         "the output's format: a page; Markdown below 60 kB for a merge request; a badge as SVG",
     .offset = AT(format), .choices = formats, .initial = "html"},
    {RG_OPTION_TEXT, "output", .argument = "FILE",
     .about = "output file; without this option, a page goes to report.html, and the other formats "
              "to stdout",
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
    struct rg_stored kept = {0};
    struct rg_page page = {.kept = &kept}, before = {0};
    rg_memory_allow(o->memory_bytes);
    bool ok = arguments->count > 0 ||
              rg_error("report: names no records; name files or folders, such as results/tables");
    ok = ok && (!o->kept || rg_stored_read(&kept, o->kept));
    for (int i = 0; ok && i < arguments->count; i++)
        ok = rg_page_add(&page, arguments->items[i]);
    ok = ok && (!o->against || rg_page_add(&before, o->against));
    ok = ok && (o->format == FORMAT_HTML ? write_page(&page, o->against ? &before : NULL,
                                                      o->output ? o->output : "report.html")
                                         : write_brief(&page, o));
    const int exit = ok ? RG_EXIT_PASS : rg_exit_of_error();
    rg_page_free(&page);
    rg_page_free(&before);
    rg_stored_free(&kept);
    return exit;
}

const struct rg_command rg_command_report = {
    .name = "report",
    .reader = RG_FOR_ALL,
    .usage = "RECORDS... [--against RECORDS] [--kept DIR] [--format html|md|badge] [-o FILE]",
    .about = "turns records (tables, claims, gates, pictures) into one page for people",
    .options = options,
    .options_size = sizeof(struct report_options),
    .run = report,
};
