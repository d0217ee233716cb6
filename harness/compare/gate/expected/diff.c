// A unified diff of edits that are known: nothing needs to be searched for.
#include <errno.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/expected/inside.h"

enum { CONTEXT = 3 };

static int64_t lines_of(const char *text)
{
    int64_t count = 0;
    for (; *text; text++)
        count += *text == '\n';
    return count;
}

static bool is_unended(const struct rg_lines *lines, int64_t line)
{
    const struct rg_line *l = &lines->lines[line];
    return lines->raw[l->at + l->length - 1] != '\n';
}

static void print_old(const struct rg_lines *lines, char sign, int64_t line, FILE *out)
{
    const struct rg_line *l = &lines->lines[line];
    fputc(sign, out);
    fwrite(lines->raw + l->at, 1, l->length, out);
    if (is_unended(lines, line))
        fputs("\n\\ No newline at end of file\n", out);
}

static void print_new(const char *text, FILE *out)
{
    while (*text) {
        const size_t length = strcspn(text, "\n") + 1;
        fputc('+', out);
        fwrite(text, 1, length, out);
        text += length;
    }
}

static int64_t least(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

// How many of the edits belong to one hunk: their contexts touch.
static int64_t in_hunk(const struct rg_line_edit *edits, int64_t count)
{
    int64_t n = 1;
    while (n < count && edits[n].line - edits[n - 1].line <= 2 * CONTEXT)
        n++;
    return n;
}

static void print_hunk(const struct rg_lines *lines, const struct rg_line_edit *edits,
                       int64_t count, int64_t *moved, FILE *out)
{
    const int64_t first = edits[0].line > CONTEXT ? edits[0].line - CONTEXT : 0;
    const int64_t end = least(edits[count - 1].line + 1 + CONTEXT, lines->count);
    int64_t added = 0;
    for (int64_t i = 0; i < count; i++)
        added += lines_of(edits[i].text) - (edits[i].line < lines->count);
    const int64_t before = end - first, after = before + added;
    // A side without lines is named by the line before it.
    fprintf(out, "@@ -%lld,%lld +%lld,%lld @@\n", (long long)(first + (before > 0)),
            (long long)before, (long long)(first + *moved + (after > 0)), (long long)after);
    *moved += added;
    int64_t next = 0;
    for (int64_t line = first; line < end; line++) {
        const bool is_edited = next < count && edits[next].line == line;
        print_old(lines, is_edited ? '-' : ' ', line, out);
        if (is_edited)
            print_new(edits[next++].text, out);
    }
    if (next < count)
        print_new(edits[next].text, out);
}

bool rg_lines_diff(const struct rg_lines *lines, const struct rg_line_edit *edits, int64_t count,
                   FILE *out)
{
    if (!count)
        return true;
    // patch takes a name's end for its first blank, if there is no tab.
    const char *end = strchr(lines->name, ' ') ? "\t" : "";
    fprintf(out, "--- %s%s\n+++ %s%s\n", lines->name, end, lines->name, end);
    int64_t moved = 0;
    for (int64_t i = 0, n; i < count; i += n) {
        n = in_hunk(edits + i, count - i);
        print_hunk(lines, edits + i, n, &moved, out);
    }
    return !ferror(out) || rg_system_error(errno, "%s: its patch cannot be written: %s; make room",
                                           lines->name, strerror(errno));
}
