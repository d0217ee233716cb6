// Regular expressions mean what they meant to the C library, and none takes for ever.
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/expected/expected.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

static const char *corpus; // a file

static struct rg_regex *compile(const char *text)
{
    logged_lines = 0;
    struct rg_regex *regex = rg_regex_of("f:1", text);
    if (regex ? logged_lines : logged_lines != 1 || strncmp(logged, "f:1: ", 5) != 0)
        fail_msg("%s: %d lines, '%s'", text, logged_lines, logged);
    return regex;
}

enum { NAMES = 48, DIGITS = NAMES / 4 };

static void find_all(char names[NAMES][128], const char *text, char found[DIGITS + 1])
{
    struct rg_regex *regex = compile(text);
    snprintf(found, DIGITS + 1, "-");
    for (int i = 0; regex && i < DIGITS; i++) {
        unsigned digit = 0;
        for (int k = 0; k < 4; k++)
            digit |= (unsigned)(rg_regex_search(regex, names[4 * i + k]) == RG_REGEX_FOUND) << k;
        snprintf(found + i, 2, "%x", digit);
    }
    rg_regex_free(regex);
}

static void they_mean_what_they_meant(void **state)
{
    (void)state;
    static char names[NAMES][128];
    char line[256], found[DIGITS + 1];
    int name_count = 0, count = 0;
    FILE *in = fopen(corpus, "rb");
    assert_non_null(in);
    while (fgets(line, sizeof(line), in)) {
        line[strcspn(line, "\n")] = 0;
        char *text = strchr(line, ' ') + 1;
        if (!strncmp(line, "# ", 2))
            continue;
        text[-1] = 0;
        if (!strcmp(line, "name")) {
            assert_between(name_count, 0, NAMES - 1);
            snprintf(names[name_count++], sizeof(names[0]), "%s", text);
            continue;
        }
        count++;
        find_all(names, text, found);
        if (strcmp(found, line) != 0)
            fail_msg("%s: %s, not %s", text, found, line);
    }
    fclose(in);
    // Lines of a file cannot contain these.
    snprintf(names[0], sizeof(names[0]), "a\nb");
    snprintf(names[1], sizeof(names[1]), "b\n");
    find_all(names, "^a.b$|b$", found);
    assert_int_equal(found[0] & 3, '1' & 3);
    assert_int_equal(name_count, NAMES);
    assert_between(count, 700, 2000);
}

// A text: `before`, a character `times` times, and `after`.
static const char *written(const char *before, char c, int times, const char *after)
{
    static char text[8192];
    const size_t length = strlen(before);
    strcpy(text, before);
    memset(text + length, c, (size_t)times);
    strcpy(text + length + (size_t)times, after);
    return text;
}

static void long_and_deep_ones_are_refused(void **state)
{
    (void)state;
    struct rg_regex *regex = compile(written("", 'a', 4096, ""));
    assert_non_null(regex);
    rg_regex_free(regex);
    assert_null(compile(written("", 'a', 4097, "")));
    char after[252];
    memset(after, ')', 251);
    after[251] = 0;
    regex = compile(written("", '(', 250, after + 1));
    assert_non_null(regex);
    rg_regex_free(regex);
    assert_null(compile(written("", '(', 251, after)));
    assert_non_null(strstr(logged, "so deep a group"));
    assert_null(compile("((a{1,99}){1,99}){1,99}"));
    assert_non_null(strstr(logged, "too large"));
    regex = compile(written("a", '+', 4000, "b"));
    if (regex)
        assert_int_equal(rg_regex_search(regex, "xaab"), RG_REGEX_FOUND);
    rg_regex_free(regex);
}

// Backtracking would try 2^60 ways. An expression with too many states side by side is reported as
// too long instead.
static void none_takes_for_ever(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        enum rg_regex_found found;
    } rows[] = {{"(a+)+[$!]", RG_REGEX_ABSENT},       {"(a|a)*[bB]", RG_REGEX_ABSENT},
                {"((a|aa)+)+$", RG_REGEX_FOUND},      {"(.*.*.*.*.*.*.*)*[YZ]", RG_REGEX_ABSENT},
                {"(a?){60}a{60}$", RG_REGEX_FOUND},   {"(((.?){30}){30})+[YZ]", RG_REGEX_TOO_LONG},
                {"(.{0,1000}){9}Z", RG_REGEX_ABSENT}, {"(.{0,1000}){9}[YZ]", RG_REGEX_TOO_LONG}};
    char name[64];
    memset(name, 'a', 63);
    name[63] = 0;
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_regex *regex = compile(rows[i].text);
        assert_non_null(regex);
        const enum rg_regex_found found = rg_regex_search(regex, name);
        if (found != rows[i].found)
            fail_msg("%s: %d", rows[i].text, (int)found);
        rg_regex_free(regex);
    }
    // Backtracking runs out of memory long before it runs out of steps.
    enum { LONG = 200000 };
    char *long_name = calloc(1, LONG + 1);
    assert_non_null(long_name);
    memset(long_name, 'a', LONG);
    struct rg_regex *heavy = compile("(a|b)*c|(a|b)*a$");
    assert_int_equal(rg_regex_search(heavy, long_name), RG_REGEX_FOUND);
    rg_regex_free(heavy);
    free(long_name);
    struct rg_known known = {.count = 0};
    static const char text[] = "fine\n\n(.{0,1000}){9}[YZ]\n";
    assert_true(rg_known_add_text(&known, "my.txt", text, strlen(text), RG_FORM_SKIPS));
    assert_true(rg_known_can_search(&known, "a"));
    assert_false(rg_known_can_search(&known, name));
    assert_int_equal(logged_lines, 1);
    assert_ptr_equal(strstr(logged, "my.txt:3: regular expression: takes too long"), logged);
    assert_int_equal(rg_known_row(&known, name, "gl", "", 0), -1);
    rg_known_free(&known);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(they_mean_what_they_meant),
        cmocka_unit_test(long_and_deep_ones_are_refused),
        cmocka_unit_test(none_takes_for_ever),
    };
    corpus = argc > 1 ? argv[1] : "";
    rg_log_listen(log_last, NULL);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
