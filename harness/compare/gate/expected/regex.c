// Regular expressions in Rust's syntax, which deqp-runner has, by those of POSIX, which the C
// library has. What the two write differently is translated, and what POSIX has not is refused:
// nothing is taken for something else. Only whether there is a match matters, so that lazy and
// greedy are one.
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/compare/gate/expected/inside.h"

// The C library writes counted repetitions out, takes memory for each pair of what may be left out,
// and goes into groups by recursion: a few bytes could take all of it.
enum { MOST_BYTES = 4096, MOST_ATOMS = 4096, MOST_DEPTH = 250 };
// A search takes time with the square of its repetitions and more: with 3,600 of them ten seconds a
// name, with 100 a fifth of a second.
enum { MOST_REPETITIONS = 100 };

struct translation {
    const char *place;
    const char *at;   // what comes next
    char *to;         // where it goes to: at most 6 bytes for each of the text's
    bool is_repeated; // what stands last is a repetition, which a ? would make lazy
    int depth;        // of the group that it is in
    struct extent {
        double atoms, repetitions;  // with counts written out
    } groups[MOST_DEPTH + 1], last; // of each group around, and of what stands last
};

static void put(struct translation *t, const char *text)
{
    const size_t length = strlen(text);
    memcpy(t->to, text, length);
    t->to += length;
}

static bool refuse(const struct translation *t, const char *what)
{
    return rg_error("%s: regular expression: %s at '%.40s' is not known here; write it without "
                    "(docs/expectations.md)",
                    t->place, what, t->at);
}

static void add(struct translation *t, struct extent extent)
{
    t->last = extent;
    t->groups[t->depth].atoms += extent.atoms;
    t->groups[t->depth].repetitions += extent.repetitions;
}

// What stands last is there so many times.
static bool repeat(struct translation *t, double times)
{
    struct extent *group = &t->groups[t->depth];
    const double within = t->last.repetitions > 1 ? t->last.repetitions : 1;
    const struct extent last = {t->last.atoms * times, within * times};
    group->atoms += last.atoms - t->last.atoms;
    group->repetitions += last.repetitions - t->last.repetitions;
    t->last = last;
    return (group->atoms <= MOST_ATOMS && group->repetitions <= MOST_REPETITIONS) ||
           refuse(t, "a count that comes to so much");
}

static bool open_group(struct translation *t)
{
    if (t->depth == MOST_DEPTH)
        return refuse(t, "so deep a group");
    t->groups[++t->depth] = (struct extent){0};
    return true;
}

static void close_group(struct translation *t)
{
    if (t->depth > 0) {
        struct extent inside = t->groups[t->depth--];
        inside.atoms += 2; // the group itself
        add(t, inside);
    }
}

// {3}, {3,} or {3,5} behind what stands last: it is there so many times.
static bool take_count(struct translation *t)
{
    char *end;
    const char *from = t->at + 1;
    double most = strtod(from, &end);
    if (*end == ',' && isdigit((unsigned char)end[1]))
        most = strtod(end + 1, &end);
    else
        end += *end == ',';
    const size_t length = (size_t)(end - t->at) + 1;
    if (!isdigit((unsigned char)*from) || *end != '}' || strspn(from, "0123456789,") + 2 != length)
        return refuse(t, "this count");
    if (!repeat(t, most > 1 ? most : 1))
        return false;
    memcpy(t->to, t->at, length);
    t->to += length;
    t->at += length;
    t->is_repeated = true;
    return true;
}

static bool take_escape(struct translation *t)
{
    const char c = t->at[1];
    if (c == 'd')
        put(t, "[0-9]");
    else if (c == 'D')
        put(t, "[^0-9]");
    else if (c && strchr("wWsSbB.+*?()[]{}|^$\\", c))
        put(t, (char[]){'\\', c, 0});
    else if (ispunct((unsigned char)c) && c != '<' && c != '>') // which Rust has for words' ends
        put(t, (char[]){c, 0});
    else
        return refuse(t, "this escape");
    t->at += 2;
    return true;
}

// A class in brackets, in which POSIX knows no backslash.
static bool take_class(struct translation *t)
{
    const char *end = t->at + 1;
    end += *end == '^';
    end += *end == ']';
    end += strcspn(end, "]");
    const size_t length = (size_t)(end - t->at) + 1;
    if (!*end)
        return refuse(t, "a [ without its ]");
    if (memchr(t->at, '\\', length) || memchr(t->at + 1, '[', length - 1) ||
        memchr(t->at, '&', length) || memchr(t->at, '~', length))
        return refuse(t, "a class with \\, [, & or ~ in it");
    memcpy(t->to, t->at, length);
    t->to += length;
    t->at += length;
    return true;
}

static bool take_other(struct translation *t)
{
    const char c = *t->at;
    if (c == '(' && t->at[1] == '?') {
        if (t->at[2] != ':')
            return refuse(t, "this group");
        t->at += 2;
    }
    if (c == '(' && !open_group(t))
        return false;
    if (c == ')')
        close_group(t);
    else if (!strchr("(|*+?", c))
        add(t, (struct extent){.atoms = 1});
    const bool is_lazy = c == '?' && t->is_repeated;
    if (strchr("*+?", c) && !is_lazy && !repeat(t, 1))
        return false;
    if (!is_lazy)
        *t->to++ = c;
    t->is_repeated = !is_lazy && strchr("*+?", c);
    t->at++;
    return true;
}

static bool translate(struct translation *t)
{
    bool ok = true;
    while (ok && *t->at) {
        const bool is_one = *t->at == '\\' || *t->at == '[';
        ok = *t->at == '\\'  ? take_escape(t)
             : *t->at == '[' ? take_class(t)
             : *t->at == '{' ? take_count(t)
                             : take_other(t);
        if (is_one) {
            t->is_repeated = false;
            add(t, (struct extent){.atoms = 1});
        }
    }
    *t->to = 0;
    return ok;
}

// Whether it can be searched for in what is left for the file, which gets less by it.
static bool can_be_searched(const struct translation *t, double *left)
{
    const double repetitions = t->groups[0].repetitions;
    *left -= repetitions * repetitions;
    return (repetitions <= MOST_REPETITIONS && *left >= 0) ||
           rg_error("%s: regular expression: %s too often to be searched for in time; write fewer "
                    "of ? * + and counts (docs/expectations.md)",
                    t->place, *left >= 0 ? "repeats" : "with those before it repeats");
}

static regex_t *compile(const char *place, const char *text, const char *posix)
{
    regex_t *regex = rg_alloc(1, sizeof(*regex), place);
    if (!regex)
        return NULL;
    const int code = regcomp(regex, posix, REG_EXTENDED | REG_NOSUB);
    if (!code)
        return regex;
    char why[128];
    regerror(code, regex, why, sizeof(why));
    free(regex);
    return rg_error_null("%s: regular expression '%.80s': %s; mend it", place, text, why);
}

regex_t *rg_known_regex(const char *place, const char *text, double *left)
{
    const size_t length = strlen(text);
    if (length > MOST_BYTES)
        return rg_error_null("%s: a regular expression of %zu bytes; at most %d", place, length,
                             MOST_BYTES);
    char *posix = rg_alloc(6, length + 1, place);
    struct translation t = {.place = place, .at = text, .to = posix};
    regex_t *regex =
        posix && translate(&t) && can_be_searched(&t, left) ? compile(place, text, posix) : NULL;
    free(posix);
    return regex;
}
