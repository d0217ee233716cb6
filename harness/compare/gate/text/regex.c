#define PCRE2_CODE_UNIT_WIDTH 8
#include "harness/compare/gate/text/regex.h"

#include <ctype.h>
#include <pcre2.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

enum {
    MOST_BYTES = 4096,
    MOST_DEPTH = 250,
    MOST_NESTED = 8192,   // for libpcre2's groups, including those added for nested repetitions
    MOST_STEPS = 1000000, // of one search
    STATES = 2 + 6 * 600, // work space of a parallel search: 600 states and their heads
    MOST_HEAP_KIB = 16 * 1024, // of one search
};

struct rg_regex {
    pcre2_code *code;
    pcre2_match_context *limits;
};

// --- from Rust's syntax to libpcre2's ---

// The syntaxes differ in the constructs refused here. They also differ in an unmatched ), which is
// read here as itself, and in a repetition of a repetition, which libpcre2 would read as
// possessive.
struct translation {
    const char *place;
    const char *at;                    // the rest to translate
    char *to;                          // the end of the translation
    char *last;                        // start of the item before it in the translation
    char *groups[MOST_DEPTH];          // starts of the groups around it
    int depth;                         // number of these groups
    enum { ONCE, REPEATED, LAZY } how; // how often the last item is repeated
};

static bool refuse(const struct translation *t, const char *what)
{
    return rg_error("%s: regular expression: %s at '%.40s' is not known here; write it without "
                    "(docs/expectations.md)",
                    t->place, what, t->at);
}

static void put(struct translation *t, size_t length)
{
    memcpy(t->to, t->at, length);
    t->to += length;
    t->at += length;
}

static void put_item(struct translation *t, size_t length)
{
    t->last = t->to;
    t->how = ONCE;
    put(t, length);
}

// Escapes with the same meaning in both; Rust's \< and \> are word boundaries.
static bool is_escape(char c, const char *letters)
{
    return c && (strchr(letters, c) || (ispunct((unsigned char)c) && c != '<' && c != '>'));
}

static bool take_escape(struct translation *t)
{
    if (!is_escape(t->at[1], "dDwWsSbB"))
        return refuse(t, "this escape");
    put_item(t, 2);
    return true;
}

// Refuses Rust's nested classes and class operators.
static bool take_class(struct translation *t)
{
    const char *end = t->at + 1;
    end += *end == '^';
    end += *end == ']';
    for (; *end && *end != ']'; end++)
        if (strchr("[&~", *end) || (*end == '\\' && !is_escape(*++end, "dDwWsS")))
            return refuse(t, "a class with [, &, ~ or this escape in it");
    if (!*end)
        return refuse(t, "a [ without its ]");
    put_item(t, (size_t)(end - t->at) + 1);
    return true;
}

// The length of a repetition count, {3}, {3,} or {3,5}; 0: it is none.
static size_t count_length(const char *at)
{
    static const char digits[] = "0123456789";
    size_t length = 1 + strspn(at + 1, digits);
    if (length > 1 && at[length] == ',')
        length += 1 + strspn(at + length + 1, digits);
    return isdigit((unsigned char)at[1]) && at[length] == '}' ? length + 1 : 0;
}

static bool take_repetition(struct translation *t)
{
    const size_t length = *t->at == '{' ? count_length(t->at) : 1;
    if (!length)
        return refuse(t, "this count");
    const bool is_lazy = t->how == REPEATED && *t->at == '?';
    if (t->how != ONCE && !is_lazy) {
        memmove(t->last + 3, t->last, (size_t)(t->to - t->last));
        memcpy(t->last, "(?:", 3);
        t->to += 3;
        *t->to++ = ')';
    }
    t->how = is_lazy ? LAZY : REPEATED;
    put(t, length);
    return true;
}

static bool take_group(struct translation *t)
{
    if (t->at[1] == '*' || (t->at[1] == '?' && t->at[2] != ':'))
        return refuse(t, "this group");
    if (t->depth == MOST_DEPTH)
        return refuse(t, "so deep a group");
    t->groups[t->depth++] = t->to;
    put_item(t, t->at[1] == '?' ? 3 : 1);
    return true;
}

static bool take_end_of_group(struct translation *t)
{
    if (!t->depth)
        *t->to++ = '\\';
    put_item(t, 1);
    t->last = t->depth ? t->groups[--t->depth] : t->last - 1;
    return true;
}

static bool take_next(struct translation *t)
{
    switch (*t->at) {
    case '\\':
        return take_escape(t);
    case '[':
        return take_class(t);
    case '(':
        return take_group(t);
    case ')':
        return take_end_of_group(t);
    case '*':
    case '+':
    case '?':
    case '{':
        return take_repetition(t);
    default:
        put_item(t, 1);
        return true;
    }
}

// --- libpcre2 ---

static pcre2_code *compile(const char *place, const char *text, const char *translated)
{
    // Works on bytes: . matches any of them, and $ only the end.
    enum { OPTIONS = PCRE2_DOTALL | PCRE2_DOLLAR_ENDONLY | PCRE2_NEVER_UTF | PCRE2_NEVER_UCP };
    pcre2_compile_context *context = pcre2_compile_context_create(NULL);
    if (!context)
        return rg_harness_error_null("%s: no memory for a regular expression; close other programs",
                                     place);
    pcre2_set_parens_nest_limit(context, MOST_NESTED);
    int code;
    PCRE2_SIZE at;
    pcre2_code *regex =
        pcre2_compile((PCRE2_SPTR)translated, PCRE2_ZERO_TERMINATED, OPTIONS, &code, &at, context);
    pcre2_compile_context_free(context);
    if (regex)
        return regex;
    char why[128];
    pcre2_get_error_message(code, (PCRE2_UCHAR *)why, sizeof(why));
    return rg_error_null("%s: regular expression '%.80s': %s; mend it", place, text, why);
}

static bool add_limits(const char *place, struct rg_regex *regex)
{
    regex->limits = pcre2_match_context_create(NULL);
    if (!regex->limits)
        return rg_harness_error("%s: no memory for a regular expression; close other programs",
                                place);
    pcre2_set_match_limit(regex->limits, MOST_STEPS);
    pcre2_set_depth_limit(regex->limits, MOST_STEPS);
    pcre2_set_heap_limit(regex->limits, MOST_HEAP_KIB);
    return true;
}

struct rg_regex *rg_regex_of(const char *place, const char *text)
{
    enum { GROWTH = 5 }; // a + that repeats a repetition also adds "(?:" and ")"
    const size_t length = strlen(text);
    if (length > MOST_BYTES)
        return rg_error_null("%s: a regular expression of %zu bytes; at most %d", place, length,
                             MOST_BYTES);
    struct rg_regex *regex = rg_alloc(1, sizeof(*regex), place);
    char *translated = rg_alloc(GROWTH, length + 1, place);
    struct translation t = {.place = place, .at = text, .to = translated};
    bool ok = regex && translated;
    while (ok && *t.at)
        ok = take_next(&t);
    ok = ok && (regex->code = compile(place, text, translated)) && add_limits(place, regex);
    free(translated);
    if (ok)
        return regex;
    rg_regex_free(regex);
    return NULL;
}

void rg_regex_free(struct rg_regex *regex)
{
    if (!regex)
        return;
    pcre2_code_free(regex->code);
    pcre2_match_context_free(regex->limits);
    free(regex);
}

enum rg_regex_found rg_regex_search(const struct rg_regex *regex, const char *text)
{
    const PCRE2_SPTR in = (PCRE2_SPTR)text;
    const PCRE2_SIZE length = PCRE2_ZERO_TERMINATED;
    pcre2_match_data *data = pcre2_match_data_create(1, NULL); // not kept: holds 20 kB once used
    int found = data ? pcre2_match(regex->code, in, length, 0, 0, data, regex->limits)
                     : PCRE2_ERROR_NOMEMORY;
    // Backtracking took too many steps. A parallel search needs fewer, although each takes longer.
    int states[STATES];
    if (data && found < 0 && found != PCRE2_ERROR_NOMATCH)
        found = pcre2_dfa_match(regex->code, in, length, 0, PCRE2_DFA_SHORTEST, data, regex->limits,
                                states, STATES);
    pcre2_match_data_free(data);
    return found >= 0                     ? RG_REGEX_FOUND
           : found == PCRE2_ERROR_NOMATCH ? RG_REGEX_ABSENT
                                          : RG_REGEX_TOO_LONG;
}
