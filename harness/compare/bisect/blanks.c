#include "harness/compare/bisect/blanks.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

// In which quotes of the shell's a place of the line is.
enum quotes { NONE, SINGLE, DOUBLE };

// A line while it is filled.
struct filling {
    FILE *out;
    enum quotes quotes;
    const char *opened; // behind the quote that opened them; not NULL
    const char *doubt;  // NULL: none so far
};

static const struct blank {
    const char *blank, *variable;
    bool is_of_candidates;
} blanks[] = {{"{}", RG_VARIABLE_CANDIDATE, true},
              {"{good}", RG_VARIABLE_GOOD, true},
              {"{budget}", RG_VARIABLE_BUDGET, false}};

// The blank that begins here; NULL: none does.
static const struct blank *blank_at(const char *line, bool has_candidates)
{
    for (size_t i = 0; i < sizeof(blanks) / sizeof(blanks[0]); i++)
        if ((has_candidates || !blanks[i].is_of_candidates) &&
            !strncmp(line, blanks[i].blank, strlen(blanks[i].blank)))
            return &blanks[i];
    return NULL;
}

// A backslash before a line's end is nothing to the shell, in the middle of a mark too.
static const char *skip_joints(const char *line)
{
    while (line[0] == '\\' && line[1] == '\n')
        line += 2;
    return line;
}

// Whether a mark stands here, in which a space is a blank of any kind.
static bool has_mark(const char *line, const char *mark)
{
    for (; *mark; mark++, line = skip_joints(line + 1))
        if (*mark == ' ' ? !isspace((unsigned char)*line) : *line != *mark)
            return false;
    return true;
}

// What begins here and lets nobody tell, without all of the shell's grammar, whether a quote behind
// it is one, and whether a word is taken for code. NULL: nothing does.
static const char *doubt_at(const char *line, enum quotes quotes)
{
    static const char *const marks[] = {"`",  "$(", "${",    "$[", // in double quotes too
                                        "#",  "$'", "<<",    "((", // comments, here-documents
                                        "[[", "[{", "eval ", "-c ", "-ec ", "-lc "};
    enum { IN_QUOTES = 4, ALL = sizeof(marks) / sizeof(marks[0]) };
    const int count = quotes == NONE ? ALL : quotes == DOUBLE ? IN_QUOTES : 0;
    for (int i = 0; i < count; i++)
        if (has_mark(line, marks[i]))
            return marks[i];
    return NULL;
}

// Whether the quotes around hold more than one word: these are often code, for another shell.
static bool is_in_words(const struct filling *f)
{
    const size_t length = strcspn(f->opened, f->quotes == SINGLE ? "'" : "\"");
    return f->quotes != NONE && strcspn(f->opened, " \t\n\\") < length;
}

static bool put_blank(struct filling *f, const struct blank *blank, const char *line)
{
    static const char *const forms[] = {
        [NONE] = "\"$%s\"", [SINGLE] = "'\"$%s\"'", [DOUBLE] = "${%s}"};
    if (f->doubt || is_in_words(f))
        return rg_error("--run '%.200s': %s is not one word for certain %s%s; write \"$%s\", a "
                        "variable of the command",
                        line, blank->blank, f->doubt ? "behind " : "in quotes with others",
                        f->doubt ? f->doubt : "", blank->variable);
    fprintf(f->out, forms[f->quotes], blank->variable);
    return true;
}

static bool is_escape(const char *at, enum quotes quotes)
{
    return at[0] == '\\' && at[1] &&
           (quotes == NONE || (quotes == DOUBLE && strchr("$`\"\\\n", at[1])));
}

// Puts what is no blank. How many bytes that was.
static size_t put_other(struct filling *f, const char *at)
{
    const size_t length = is_escape(at, f->quotes) ? 2 : 1;
    const enum quotes own = *at == '\'' ? SINGLE : *at == '"' ? DOUBLE : NONE;
    f->doubt = f->doubt ? f->doubt : doubt_at(at, f->quotes);
    if (own != NONE && f->quotes == own) {
        f->quotes = NONE;
    } else if (own != NONE && f->quotes == NONE) {
        f->quotes = own;
        f->opened = at + 1;
    }
    fwrite(at, 1, length, f->out);
    return length;
}

static bool fill(struct filling *f, const char *line, bool has_candidates)
{
    bool ok = true;
    for (const char *at = line; ok && *at;) {
        const struct blank *blank = blank_at(at, has_candidates);
        if (blank)
            ok = put_blank(f, blank, line);
        at += blank ? strlen(blank->blank) : put_other(f, at);
    }
    return ok;
}

char *rg_blanks_fill(const char *line, bool has_candidates)
{
    enum { MOST_BYTES = 128 << 10 }; // of Linux, with the zero behind it: execve(2)
    char *text = NULL;
    size_t size = 0;
    struct filling filling = {.out = open_memstream(&text, &size), .opened = line};
    bool ok = filling.out && fill(&filling, line, has_candidates);
    if (!filling.out || fclose(filling.out))
        ok = rg_harness_error("bisect: no memory for the command; close other programs");
    else if (ok && size >= MOST_BYTES)
        ok = rg_error("bisect: the command has more than %d bytes; put it into a script",
                      MOST_BYTES - 1);
    if (ok)
        return text;
    free(text);
    return NULL;
}
