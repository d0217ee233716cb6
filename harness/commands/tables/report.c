// raingauge report: records as one page.
#include <stdio.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/report/report.h"

struct report_options {
    char *output;
    int64_t memory_bytes;
};

#define AT(field) offsetof(struct report_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to show"),
    {RG_OPTION_OPERAND, .argument = "RECORDS...",
     .about =
         "files or folders of what commands wrote with --json or -o: tables, gates, baselines, "
         "diffs, verify, doctor, render; a text of Markdown gives the pictures that it shows",
     .names = RG_NAMES_FILE, .first = 1},
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_TEXT, "output", .argument = "FILE",
     .about = "the page, one file, which needs no other and no network", .offset = AT(output),
     .letter = 'o', .initial = "report.html", .names = RG_NAMES_FILE},
    {RG_OPTION_END},
};

static int report(const void *values, const struct rg_words *arguments)
{
    const struct report_options *o = values;
    struct rg_page page = {0};
    rg_memory_allow(o->memory_bytes);
    bool ok = arguments->count > 0 ||
              rg_error("report: names no records; name files or folders, such as results/tables");
    for (int i = 0; ok && i < arguments->count; i++)
        ok = rg_page_add(&page, arguments->items[i]);
    ok = ok && rg_page_write(&page, o->output);
    const int exit = ok ? RG_EXIT_PASS : rg_exit_of_error();
    if (ok)
        printf("%s: %zu records; open it in a browser\n", o->output, json_array_size(page.records));
    rg_page_free(&page);
    return exit;
}

const struct rg_command rg_command_report = {
    .name = "report",
    .usage = "RECORDS... [-o FILE]",
    .about = "shows records as one page for people: tables, claims, gates, pictures",
    .options = options,
    .options_size = sizeof(struct report_options),
    .run = report,
};
