// GitHub's workflow commands, and Markdown for a step's summary.
// https://docs.github.com/actions/reference/workflow-commands-for-github-actions
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/log.h"
#include "harness/compare/gate/report/forms.h"
#include "harness/compare/gate/report/texts.h"

// --- annotations ---

enum { MOST_ANNOTATIONS = 3 };

// A property needs more characters escaped than the text after it.
static void put_command_text(FILE *out, const char *text, bool is_property)
{
    for (; *text; text++) {
        const bool is_mark = *text == '%' || *text == '\n' || *text == '\r' ||
                             (is_property && (*text == ':' || *text == ','));
        fprintf(out, is_mark ? "%%%02X" : "%c", (unsigned char)*text);
    }
}

// The command that annotates an ending; NULL: no annotation.
static const char *command_of(enum rg_ending ending)
{
    if (rg_ending_fails(ending))
        return "error";
    return ending == RG_ENDING_INCONCLUSIVE || ending == RG_ENDING_FLAKE ? "warning" : NULL;
}

// Annotates the worst cases.
bool rg_report_annotations(const struct rg_report *report, FILE *out)
{
    for (int i = 0, count = 0; i < report->case_count && count < MOST_ANNOTATIONS; i++) {
        const struct rg_report_case *told = &report->cases[report->order[i]];
        const char *command = command_of(told->ending);
        if (!command)
            continue;
        fprintf(out, "::%s title=", command);
        put_command_text(out, told->name, true);
        fprintf(out, "::%s: ", rg_ending_name(told->ending));
        put_command_text(out, told->message, false);
        fputs(*told->measured ? "%0A" : "", out);
        put_command_text(out, told->measured, false);
        fputc('\n', out);
        count++;
    }
    return true;
}

// --- Markdown ---

// All commands of a step share the summary's file, and GitHub's limit of its size.
enum { MOST_BYTES = 1024 * 1024, LONGEST_DETAILS = 10000, NOTE = 200 };

static void put_escaped(FILE *out, const char *text)
{
    for (; *text; text++)
        fprintf(out, strchr("\\`*_{}[]<>()#|~&!$", *text) ? "\\%c" : "%c", *text);
}

// A block's fence must be longer than any run of backquotes in its text.
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
    const bool ends_line = fits && text[fits - 1] == '\n';
    fprintf(out, "text\n%.*s%s", (int)fits, text, ends_line ? "" : "\n");
    if (text[fits])
        fprintf(out, "... (%zu bytes more)\n", strlen(text + fits));
    for (int i = 0; i < fence; i++)
        fputc('`', out);
    fprintf(out, "\n");
}

static void make_head(FILE *out, const struct rg_report *report, int number)
{
    (void)number;
    char summary[RG_REPORT_SUMMARY];
    rg_report_summary(report, summary);
    fprintf(out, "## raingauge gate: %s\n\n", summary);
    if (report->drivers && *report->drivers) {
        put_block(out, report->drivers);
        fputc('\n', out);
    }
    if (rg_report_count(report, RG_ENDING_PASS) < report->case_count)
        fprintf(out, "| outcome | case | why | measured |\n|---|---|---|---|\n");
}

static void make_row(FILE *out, const struct rg_report *report, int number)
{
    const struct rg_report_case *told = &report->cases[number];
    if (told->ending == RG_ENDING_PASS)
        return;
    fprintf(out, "| %s | ", rg_ending_name(told->ending));
    put_escaped(out, told->name);
    fprintf(out, " | ");
    put_escaped(out, told->message);
    fprintf(out, " | ");
    put_escaped(out, told->measured);
    fprintf(out, " |\n");
}

static void make_details(FILE *out, const struct rg_report *report, int number)
{
    const struct rg_report_case *told = &report->cases[number];
    if (told->ending == RG_ENDING_PASS || (!*told->details && !told->attachment_count))
        return;
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

// The page written so far, and the space left on it.
struct page {
    FILE *out;
    size_t room;
    int left_out;   // number of parts left out of the current list
    bool is_broken; // out of memory
};

// Writes a part if it fits and no earlier part was left out.
static void put_part(struct page *page, char *text, size_t size)
{
    const bool fits = !page->left_out && size + NOTE <= page->room;
    if (size && fits)
        page->room -= fwrite(text, 1, size, page->out);
    page->left_out += size && !fits;
}

// Writes the cases of `order` as parts, in this order; returns how many were left out.
static int put_parts(struct page *page, const struct rg_report *report, const int *order, int count,
                     void (*make)(FILE *out, const struct rg_report *report, int number))
{
    page->left_out = 0;
    for (int i = 0; i < count && !page->is_broken; i++) {
        char *text = NULL;
        size_t size = 0;
        FILE *out = open_memstream(&text, &size);
        if (out)
            make(out, report, order[i]);
        const bool is_held = out && !ferror(out);
        page->is_broken = !(out && fclose(out) == 0 && is_held);
        if (!page->is_broken)
            put_part(page, text, size);
        free(text);
    }
    return page->left_out;
}

// How much of GitHub's limit earlier commands of the step have left.
static size_t room_of(FILE *out)
{
    struct stat st;
    return !fstat(fileno(out), &st) && st.st_size < MOST_BYTES ? MOST_BYTES - (size_t)st.st_size
                                                               : 0;
}

bool rg_report_markdown(const struct rg_report *report, FILE *out)
{
    const int count = report->case_count;
    struct page page = {out, room_of(out), 0, false};
    if (!put_parts(&page, report, &(int){0}, 1, make_head)) {
        const int rows = put_parts(&page, report, report->order, count, make_row);
        const int details = put_parts(&page, report, report->order, count, make_details);
        if ((rows || details) && !page.is_broken)
            fprintf(out, "\nLeft out, for GitHub takes no more: %d cases, and the details of %d.\n",
                    rows, details);
    } else if (!page.is_broken) {
        rg_warning("the step's summary has no room left; write less to it before the gate");
    }
    return !page.is_broken || rg_harness_error("a step's summary: no memory; close other programs");
}
