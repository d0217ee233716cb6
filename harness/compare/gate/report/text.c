// The text form, for terminals and CI logs.
#include <string.h>

#include "harness/console/terminal.h"
#include "harness/compare/gate/report/forms.h"
#include "harness/compare/gate/report/texts.h"

// --- lines of WIDTH characters ---

enum { WIDTH = 110 };

// The number of bytes of the text that go on a line of `room` characters: up to a line break, or
// the last space that fits, or the end of a word that is longer than a line.
static size_t line_of(const char *text, int room)
{
    const size_t whole = strcspn(text, "\n");
    size_t fits = 0, space = 0;
    for (int width = 0; fits < whole; fits++) {
        width += (text[fits] & 0xc0) != 0x80;
        if (width > room)
            break;
        space = text[fits] == ' ' && fits ? fits : space;
    }
    return fits == whole || text[fits] == ' ' ? fits : space ? space : fits;
}

// Replaces "##[", which GitHub takes for a command anywhere in a log's line.
static void put_bytes(FILE *out, const char *text, size_t bytes)
{
    for (size_t i = 0; i < bytes; i++) {
        const bool is_command = text[i] == '[' && i >= 2 && !strncmp(text + i - 2, "##", 2);
        fputc(is_command ? '(' : text[i] == '\t' ? ' ' : text[i], out);
    }
}

// Writes text from column `from` on. Each further line begins with a bar: at a line's start GitHub
// would read foreign text such as "::error::" as a command.
static void put_wrapped(FILE *out, const char *text, int from)
{
    static const char bar[] = "  | ";
    for (int room = WIDTH - from;; room = WIDTH - (int)strlen(bar)) {
        const size_t bytes = line_of(text, room);
        put_bytes(out, text, bytes);
        fputc('\n', out);
        text += bytes;
        text += *text == '\n' || *text == ' ';
        if (!*text)
            return;
        fputs(bar, out);
    }
}

static void put_below(FILE *out, const char *about, const char *text)
{
    if (!*text)
        return;
    const int from = fprintf(out, "  | %s", about);
    put_wrapped(out, text, from);
}

// --- a report ---

static const char *colour_of(enum rg_ending ending)
{
    return !rg_ending_element(ending) ? RG_GREEN : rg_ending_fails(ending) ? RG_RED : RG_YELLOW;
}

static void put_case(FILE *out, const struct rg_report_case *told, bool is_coloured)
{
    enum { ENDING = 18 };
    const char *ending = rg_ending_name(told->ending);
    if (is_coloured)
        fprintf(out, "%s%s" RG_PLAIN, colour_of(told->ending), ending);
    else
        fprintf(out, "%s", ending);
    fprintf(out, "%*s", ENDING - (int)strlen(ending), "");
    put_wrapped(out, told->name, ENDING);
    put_below(out, "", told->message);
    put_below(out, "", told->measured);
    put_below(out, "", told->details);
    for (int i = 0; i < told->attachment_count; i++)
        put_below(out, "picture: ", told->attachments[i]);
}

bool rg_report_text_coloured(const struct rg_report *report, FILE *out, bool is_coloured)
{
    char summary[RG_REPORT_SUMMARY];
    for (int i = 0; i < report->case_count; i++)
        put_case(out, &report->cases[report->order[i]], is_coloured);
    rg_report_summary(report, summary);
    put_wrapped(out, summary, 0);
    return true;
}

bool rg_report_text(const struct rg_report *report, FILE *out)
{
    return rg_report_text_coloured(report, out, rg_has_colours(out));
}
