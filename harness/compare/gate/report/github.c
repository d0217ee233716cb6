// GitHub's workflow commands, and Markdown for a step's summary.
// https://docs.github.com/actions/reference/workflow-commands-for-github-actions
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/log.h"
#include "harness/compare/gate/report/report.h"
#include "harness/compare/gate/report/texts.h"

// --- annotations ---

// A property has more marks than the text behind it.
static void put_command_text(FILE *out, const char *text, bool is_property)
{
    for (; *text; text++) {
        const bool is_mark = *text == '%' || *text == '\n' || *text == '\r' ||
                             (is_property && (*text == ':' || *text == ','));
        fprintf(out, is_mark ? "%%%02X" : "%c", (unsigned char)*text);
    }
}

// The command that annotates an ending; NULL: none does.
static const char *command_of(enum rg_ending ending)
{
    const enum rg_ending_kind kind = rg_ending_kind(ending);
    if (kind == RG_KIND_FAILURE || kind == RG_KIND_ERROR)
        return "error";
    return ending == RG_ENDING_INCONCLUSIVE || ending == RG_ENDING_FLAKE ? "warning" : NULL;
}

bool rg_report_annotations(const struct rg_report *report, FILE *out)
{
    int *order = rg_report_worst_first(report);
    for (int i = 0, count = 0; order && i < report->case_count && count < RG_ANNOTATIONS; i++) {
        const struct rg_report_case *told = &report->cases[order[i]];
        const char *command = command_of(told->ending);
        char measured[RG_REPORT_MEASURED];
        rg_report_measured(told, measured, sizeof(measured));
        if (!command)
            continue;
        fprintf(out, "::%s title=", command);
        put_command_text(out, told->name, true);
        fprintf(out, "::%s: ", rg_ending_name(told->ending));
        put_command_text(out, told->message, false);
        fputs(*measured ? "%0A" : "", out);
        put_command_text(out, measured, false);
        fputc('\n', out);
        count++;
    }
    free(order);
    return order != NULL;
}

// --- Markdown ---

enum { LONGEST_DETAILS = 10000, NOTE = 200 };

static void put_escaped(FILE *out, const char *text)
{
    for (; *text; text++)
        fprintf(out, strchr("\\`*_{}[]<>()#|~&!$", *text) ? "\\%c" : "%c", *text);
}

static void make_head(FILE *out, const struct rg_report *report)
{
    char summary[RG_REPORT_SUMMARY];
    rg_report_summary(report, summary);
    fprintf(out, "## raingauge gate: %s\n\n", summary);
    if (rg_report_count(report, RG_ENDING_PASS) < report->case_count)
        fprintf(out, "| outcome | case | why | measured |\n|---|---|---|---|\n");
}

static void make_row(FILE *out, const struct rg_report_case *told)
{
    char measured[RG_REPORT_MEASURED];
    rg_report_measured(told, measured, sizeof(measured));
    fprintf(out, "| %s | ", rg_ending_name(told->ending));
    put_escaped(out, told->name);
    fprintf(out, " | ");
    put_escaped(out, told->message);
    fprintf(out, " | ");
    put_escaped(out, measured);
    fprintf(out, " |\n");
}

// The fence of a block is longer than any run of its marks in the text.
static int fence_of(const char *text)
{
    int longest = 2, run = 0;
    for (; *text; text++) {
        run = *text == '`' ? run + 1 : 0;
        longest = run > longest ? run : longest;
    }
    return longest + 1;
}

static void put_block(FILE *out, const char *text)
{
    const int fence = fence_of(text);
    const size_t fits = rg_texts_fit(text, LONGEST_DETAILS);
    for (int i = 0; i < fence; i++)
        fputc('`', out);
    fprintf(out, "text\n%.*s\n", (int)fits, text);
    if (text[fits])
        fprintf(out, "... (%zu bytes more)\n", strlen(text + fits));
    for (int i = 0; i < fence; i++)
        fputc('`', out);
    fprintf(out, "\n");
}

static void make_details(FILE *out, const struct rg_report_case *told)
{
    fprintf(out, "\n### ");
    put_escaped(out, told->name);
    fprintf(out, "\n\n");
    if (*told->details)
        put_block(out, told->details);
    for (int i = 0; i < told->attachment_count; i++) {
        fprintf(out, "- picture: ");
        put_escaped(out, told->attachments[i]);
        fprintf(out, "\n");
    }
}

// What is written so far, and the room that is left.
struct page {
    FILE *out;
    size_t room;
    bool is_broken; // without memory
};

// Writes one part if it fits.
static bool put_part(struct page *page, const struct rg_report *report,
                     const struct rg_report_case *told,
                     void (*make)(FILE *out, const struct rg_report_case *told))
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out && told)
        make(out, told);
    else if (out)
        make_head(out, report);
    const bool is_held = out && !ferror(out);
    page->is_broken = !(out && fclose(out) == 0 && is_held);
    const bool fits = !page->is_broken && size + NOTE <= page->room;
    if (fits)
        page->room -= fwrite(text, 1, size, page->out);
    free(text);
    return fits;
}

static bool has_details(const struct rg_report_case *told)
{
    return told->ending != RG_ENDING_PASS && (*told->details || told->attachment_count);
}

static bool has_row(const struct rg_report_case *told)
{
    return told->ending != RG_ENDING_PASS;
}

// Writes parts of those cases that have one, in order, as many as fit; how many do not.
static int put_parts(struct page *page, const struct rg_report *report, const int *order,
                     bool (*has)(const struct rg_report_case *told),
                     void (*make)(FILE *out, const struct rg_report_case *told))
{
    int left_out = 0;
    for (int i = 0; i < report->case_count; i++) {
        const struct rg_report_case *told = &report->cases[order[i]];
        if (has(told) && (left_out || !put_part(page, report, told, make)))
            left_out++;
    }
    return left_out;
}

// What the steps before have left of GitHub's limit.
static size_t room_of(FILE *out)
{
    struct stat st;
    return !fstat(fileno(out), &st) && st.st_size < RG_SUMMARY_LIMIT
               ? RG_SUMMARY_LIMIT - (size_t)st.st_size
               : 0;
}

bool rg_report_markdown(const struct rg_report *report, FILE *out)
{
    int *order = rg_report_worst_first(report);
    struct page page = {out, room_of(out), false};
    if (!order)
        return false;
    if (put_part(&page, report, NULL, NULL)) {
        const int rows = put_parts(&page, report, order, has_row, make_row);
        const int details = put_parts(&page, report, order, has_details, make_details);
        if (rows || details)
            fprintf(out, "\nLeft out, for GitHub takes no more: %d cases, and the details of %d.\n",
                    rows, details);
    } else if (!page.is_broken)
        rg_warning("the step's summary has no room left; write less to it before the gate");
    free(order);
    return !page.is_broken || rg_harness_error("a step's summary: no memory; close other programs");
}
