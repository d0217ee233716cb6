#include "harness/compare/gate/report/gtest.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>
#include <xxhash.h>

// --- the filter ---

// Whether a pattern, which ends at `end`, matches all of a name. After a mismatch the last "*"
// takes one character more: no earlier one need be tried again.
static bool matches_pattern(const char *pattern, const char *end, const char *name)
{
    const char *star = NULL, *taken = name;
    while (*name) {
        if (pattern < end && *pattern == '*') {
            star = pattern++;
            taken = name;
        } else if (pattern < end && (*pattern == '?' || *pattern == *name)) {
            pattern++;
            name++;
        } else if (star) {
            pattern = star + 1;
            name = ++taken;
        } else
            return false;
    }
    while (pattern < end && *pattern == '*')
        pattern++;
    return pattern == end;
}

// Whether one of the patterns between `filter` and `end` does.
static bool matches_any(const char *filter, const char *end, const char *name)
{
    for (;;) {
        const char *colon = memchr(filter, ':', (size_t)(end - filter));
        if (matches_pattern(filter, colon ? colon : end, name))
            return true;
        if (!colon)
            return false;
        filter = colon + 1;
    }
}

bool rg_gtest_matches(const char *filter, const char *name)
{
    const char *end = filter + strlen(filter), *minus = strchr(filter, '-');
    if (minus == filter)
        return !matches_any(filter + 1, end, name);
    return matches_any(filter, minus ? minus : end, name) &&
           !(minus && matches_any(minus + 1, end, name));
}

// --- names ---

static bool is_plain(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           (c && strchr("_=@+", c));
}

void rg_gtest_name(const char *name, char made[RG_GTEST_NAME])
{
    const char *point = strchr(name, '.');
    bool is_changed = !point || point == name || point - name >= RG_GTEST_KEPT || !point[1];
    int length = is_changed ? snprintf(made, RG_GTEST_NAME, "raingauge.") : 0;
    const bool has_suite = !is_changed;
    for (const char *c = name; *c; c++) {
        if (length >= RG_GTEST_KEPT) {
            is_changed = true;
            break;
        }
        is_changed |= !is_plain(*c) && *c != '.';
        made[length++] = has_suite && c == point ? '.' : *c == '.' ? '/' : is_plain(*c) ? *c : '_';
    }
    made[length] = 0;
    if (is_changed)
        snprintf(made + length, (size_t)(RG_GTEST_NAME - length), "_%016" PRIx64,
                 (uint64_t)XXH3_64bits(name, strlen(name)));
}

static int suite_length(const char *name)
{
    return (int)strcspn(name, ".");
}

static bool is_same_suite(const char *a, const char *b)
{
    return suite_length(a) == suite_length(b) && !strncmp(a, b, (size_t)suite_length(a));
}

// --- the list ---

// Whether a case's suite has been listed with an earlier one.
static bool is_listed(const struct rg_report *report, int until, const char *made,
                      const char *filter)
{
    char earlier[RG_GTEST_NAME];
    for (int i = 0; i < until; i++) {
        rg_gtest_name(report->cases[i].name, earlier);
        if (rg_gtest_matches(filter, earlier) && is_same_suite(earlier, made))
            return true;
    }
    return false;
}

void rg_gtest_list(FILE *out, const struct rg_report *report, const char *filter)
{
    char first[RG_GTEST_NAME], made[RG_GTEST_NAME];
    for (int i = 0; i < report->case_count; i++) {
        rg_gtest_name(report->cases[i].name, first);
        if (!rg_gtest_matches(filter, first) || is_listed(report, i, first, filter))
            continue;
        fprintf(out, "%.*s.\n", suite_length(first), first);
        for (int j = i; j < report->case_count; j++) {
            rg_gtest_name(report->cases[j].name, made);
            if (rg_gtest_matches(filter, made) && is_same_suite(first, made))
                fprintf(out, "  %s\n", made + suite_length(made) + 1);
        }
    }
}

// --- results ---

// Text of a case, whose brackets no runner takes for a result, nor GitHub for a command.
static void put_text(FILE *out, const char *text)
{
    if (!*text)
        return;
    fputs("| ", out);
    for (; *text; text++)
        fprintf(out, *text == '\n' ? "\n| " : "%c", *text == '[' ? '(' : *text);
    fputc('\n', out);
}

static const char *word_of(enum rg_ending ending)
{
    const enum rg_ending_kind kind = rg_ending_kind(ending);
    return kind == RG_KIND_PASS      ? "[       OK ]"
           : kind == RG_KIND_SKIPPED ? "[  SKIPPED ]"
                                     : "[  FAILED  ]";
}

static int64_t ms_of(double seconds)
{
    const double longest_s = 1e9;
    return isfinite(seconds) && seconds > 0 && seconds < longest_s ? llrint(1000 * seconds) : 0;
}

static const char *tests(int count)
{
    return count == 1 ? "test" : "tests";
}

void rg_gtest_begin(FILE *out, int count)
{
    fprintf(out, "[==========] Running %d %s.\n", count, tests(count));
}

void rg_gtest_run(FILE *out, const char *name)
{
    char made[RG_GTEST_NAME];
    rg_gtest_name(name, made);
    fprintf(out, "[ RUN      ] %s\n", made);
}

void rg_gtest_result(FILE *out, const struct rg_report_case *told)
{
    char made[RG_GTEST_NAME], measured[RG_REPORT_MEASURED];
    rg_gtest_name(told->name, made);
    rg_report_measured(told, measured, sizeof(measured));
    put_text(out, told->name);
    put_text(out, rg_ending_name(told->ending));
    put_text(out, told->message);
    put_text(out, measured);
    put_text(out, told->details);
    fprintf(out, "%s %s (%" PRId64 " ms)\n", word_of(told->ending), made, ms_of(told->seconds));
}

// The cases whose word this is, below a count of them.
static void put_listed(FILE *out, const struct rg_report *report, const char *word)
{
    char made[RG_GTEST_NAME];
    int count = 0;
    for (int i = 0; i < report->case_count; i++)
        count += !strcmp(word_of(report->cases[i].ending), word);
    if (count)
        fprintf(out, "%s %d %s, listed below:\n", word, count, tests(count));
    for (int i = 0; i < report->case_count; i++) {
        rg_gtest_name(report->cases[i].name, made);
        if (!strcmp(word_of(report->cases[i].ending), word))
            fprintf(out, "%s %s\n", word, made);
    }
}

void rg_gtest_end(FILE *out, const struct rg_report *report)
{
    double seconds = 0;
    int passed = 0;
    for (int i = 0; i < report->case_count; i++) {
        seconds += isfinite(report->cases[i].seconds) ? report->cases[i].seconds : 0;
        passed += rg_ending_kind(report->cases[i].ending) == RG_KIND_PASS;
    }
    fprintf(out, "[==========] %d %s ran. (%" PRId64 " ms total)\n", report->case_count,
            tests(report->case_count), ms_of(seconds));
    fprintf(out, "[  PASSED  ] %d %s.\n", passed, tests(passed));
    put_listed(out, report, word_of(RG_ENDING_SKIPPED));
    put_listed(out, report, word_of(RG_ENDING_CRASH));
}

bool rg_gtest_print(const struct rg_report *report, FILE *out)
{
    rg_gtest_begin(out, report->case_count);
    for (int i = 0; i < report->case_count; i++) {
        rg_gtest_run(out, report->cases[i].name);
        rg_gtest_result(out, &report->cases[i]);
    }
    rg_gtest_end(out, report);
    return true;
}
