// Reads the files of Mesa's CI as deqp-runner does: lines "test,Status", or regular expressions.
// Empty lines and lines that begin with # are comments.
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/expected/inside.h"

static const struct {
    const char *word;
    unsigned outcomes; // 0: the status is no failure, so the line is ignored
} words[] = {
    {"Fail", 1 << RG_FAIL | 1 << RG_ERROR},
    {"Crash", 1 << RG_CRASH},
    {"Timeout", 1 << RG_TIMEOUT},
    {"ExpectedFail", 1 << RG_FAIL | 1 << RG_ERROR},
    {"UnexpectedImprovement(Fail)", 1 << RG_FAIL | 1 << RG_ERROR},
    {"Flake", RG_KNOWN_ANY},
    {"KnownFlake", RG_KNOWN_ANY},
    {"UnexpectedImprovement(Pass)", 0},
    {"UnexpectedImprovement(Skip)", 0},
    {"Pass", 0},
    {"Warn", 0},
    {"Skip", 0},
    {"Missing", 0},
};

static int find(const char *word)
{
    for (int i = 0; i < (int)(sizeof(words) / sizeof(words[0])); i++)
        if (!strcmp(words[i].word, word))
            return i;
    return -1;
}

// "test,Status"; deqp-runner's own results have more after another comma, which is ignored.
static bool take_fail(const char *place, struct rg_known *expected, char *text, int64_t line)
{
    char *word = strchr(text, ',');
    if (!word || word == text)
        return rg_error("%s: '%.80s': write TEST,Fail or TEST,Crash", place, text);
    *word++ = 0;
    word[strcspn(word, ",")] = 0;
    const int status = find(word);
    if (status < 0)
        return rg_error("%s: status '%.80s': write Fail, Crash, Timeout or Flake", place, word);
    if (!words[status].outcomes)
        return true;
    const bool is_flake = words[status].outcomes == RG_KNOWN_ANY;
    struct rg_expectation *row =
        rg_known_new(expected, is_flake ? RG_EXPECT_FLAKE : RG_EXPECT_FAIL, line);
    if (!row)
        return false;
    row->cell = text;
    row->outcomes = words[status].outcomes;
    return true;
}

static bool take_regex(const char *place, struct rg_known *expected, const char *text,
                       enum rg_known_kind kind, int64_t line)
{
    struct rg_expectation *row = rg_known_new(expected, kind, line);
    if (row)
        row->regex = rg_regex_of(place, text);
    return row && row->regex;
}

bool rg_known_read_mesa(struct rg_known *expected, enum rg_known_form form)
{
    const struct rg_lines *lines = &expected->files[expected->file_count - 1].lines;
    const enum rg_known_kind kind = form == RG_FORM_SKIPS ? RG_EXPECT_SKIP : RG_EXPECT_FLAKE;
    char place[RG_LINES_PLACE], *text;
    bool ok = true;
    for (int64_t i = -1; ok && (text = rg_lines_next(lines, &i, place));)
        ok = form == RG_FORM_FAILS ? take_fail(place, expected, text, i)
                                   : take_regex(place, expected, text, kind, i);
    return ok;
}
