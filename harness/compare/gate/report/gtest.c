#include "harness/compare/gate/report/gtest.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/files/file.h"
#include "core/base/log.h"
#include "harness/compare/gate/report/forms.h"
#include "harness/compare/gate/text/glob.h"

// --- the filter ---

// Whether one of the patterns between `filter` and `end` matches.
static bool matches_any(const char *filter, const char *end, const char *name)
{
    for (;;) {
        const char *colon = memchr(filter, ':', (size_t)(end - filter));
        if (rg_glob_part(filter, (size_t)((colon ? colon : end) - filter), name))
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

static void name_at(const json_t *names, size_t i, char made[RG_GTEST_NAME])
{
    rg_gtest_name(json_string_value(json_array_get(names, i)), made);
}

// Whether an earlier case has listed this suite already.
static bool is_listed(const json_t *names, size_t until, const char *made)
{
    char earlier[RG_GTEST_NAME];
    bool any = false;
    for (size_t i = 0; !any && i < until; i++) {
        name_at(names, i, earlier);
        any = is_same_suite(earlier, made);
    }
    return any;
}

void rg_gtest_list(FILE *out, const json_t *names)
{
    char first[RG_GTEST_NAME], made[RG_GTEST_NAME];
    for (size_t i = 0; i < json_array_size(names); i++) {
        name_at(names, i, first);
        if (is_listed(names, i, first))
            continue;
        fprintf(out, "%.*s.\n", suite_length(first), first);
        for (size_t j = i; j < json_array_size(names); j++) {
            name_at(names, j, made);
            if (is_same_suite(first, made))
                fprintf(out, "  %s\n", made + suite_length(made) + 1);
        }
    }
}

// --- results ---

// Writes a case's text such that no runner takes its brackets for a result, nor GitHub for a
// command.
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
    return !rg_ending_element(ending) ? "[       OK ]"
           : rg_ending_fails(ending)  ? "[  FAILED  ]"
                                      : "[  SKIPPED ]";
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

static void put_case(FILE *out, const struct rg_report_case *told)
{
    char made[RG_GTEST_NAME];
    rg_gtest_name(told->name, made);
    fprintf(out, "[ RUN      ] %s\n", made);
    put_text(out, told->name);
    put_text(out, rg_ending_name(told->ending));
    put_text(out, told->message);
    put_text(out, told->measured);
    put_text(out, told->details);
    fprintf(out, "%s %s (%" PRId64 " ms)\n", word_of(told->ending), made, ms_of(told->seconds));
}

// Lists the cases that ended with this word, after their number.
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

static void put_sums(FILE *out, const struct rg_report *report)
{
    double seconds = 0;
    int passed = 0;
    for (int i = 0; i < report->case_count; i++) {
        seconds += isfinite(report->cases[i].seconds) ? report->cases[i].seconds : 0;
        passed += !rg_ending_element(report->cases[i].ending);
    }
    fprintf(out, "[==========] %d %s ran. (%" PRId64 " ms total)\n", report->case_count,
            tests(report->case_count), ms_of(seconds));
    fprintf(out, "[  PASSED  ] %d %s.\n", passed, tests(passed));
    put_listed(out, report, word_of(RG_ENDING_SKIPPED));
    put_listed(out, report, word_of(RG_ENDING_CRASH));
}

bool rg_gtest_print(const struct rg_report *report, FILE *out)
{
    fprintf(out, "[==========] Running %d %s.\n", report->case_count, tests(report->case_count));
    for (int i = 0; i < report->case_count; i++)
        put_case(out, &report->cases[i]);
    put_sums(out, report);
    return true;
}

// --- shards ---

static bool read_number(const char *variable, int *number)
{
    const char *text = getenv(variable);
    char *end;
    const long value = strtol(text, &end, 10);
    *number = (int)value;
    return (end != text && !*end && value >= 0 && value <= INT_MAX) ||
           rg_error(
               "%s '%.40s': must be a whole number from 0 to %d; unset it, or count shards with "
               "it",
               variable, text, INT_MAX);
}

// Creates the file that tells the runner that shards are understood. Only its existence counts, so
// existing contents stay.
static bool tell_runner(void)
{
    const char *path = getenv("GTEST_SHARD_STATUS_FILE"), *why;
    if (!path || !*path)
        return true;
    FILE *file = rg_file_append(path, &why);
    return (file && fclose(file) == 0) ||
           rg_system_error(errno,
                           "%s: cannot be written: %s; $GTEST_SHARD_STATUS_FILE names a file", path,
                           file ? strerror(errno) : why);
}

bool rg_gtest_shards(struct rg_gtest_shards *shards)
{
    const bool has_total = getenv("GTEST_TOTAL_SHARDS"), has_index = getenv("GTEST_SHARD_INDEX");
    *shards = (struct rg_gtest_shards){.total = 1};
    if (!tell_runner())
        return false;
    if (!has_total && !has_index)
        return true;
    if (!has_total || !has_index)
        return rg_error("GTEST_TOTAL_SHARDS and GTEST_SHARD_INDEX: one of them is not set; set "
                        "both, or none");
    return read_number("GTEST_TOTAL_SHARDS", &shards->total) &&
           read_number("GTEST_SHARD_INDEX", &shards->index) &&
           (shards->index < shards->total ||
            rg_error("GTEST_SHARD_INDEX %d: must be below GTEST_TOTAL_SHARDS, which is %d",
                     shards->index, shards->total));
}
