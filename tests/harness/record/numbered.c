// A file's name has a placeholder, which the digits of a number replace.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "harness/record/numbered.h"
#include "tests/tools/process/logged.h"

static void places_are_counted_in_the_name_alone(void **state)
{
    (void)state;
    static const struct {
        const char *path;
        int places;
    } rows[] = {
        {"", 0},         {"a.png", 0},    {"%d", 1},          {"a%d.png", 1},   {"a%04d.png", 1},
        {"%d%d.png", 2}, {"%%d.png", 1},  {"a%4d.png", 0},    {"a%00d.png", 0}, {"a%010d.png", 0},
        {"a%0d.png", 0}, {"a%i.png", 0},  {"a%", 0},          {"a%0", 0},       {"a%04", 0},
        {"%d/a.png", 0}, {"/%d/%01d", 1}, {"a%s%n%d.png", 1},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        if (rg_numbered_places(rows[i].path) != rows[i].places)
            fail_msg("%s: %d places, not %d", rows[i].path, rg_numbered_places(rows[i].path),
                     rows[i].places);
}

static void expect(const char *path, int number, const char *wanted)
{
    char numbered[64];
    assert_true(rg_numbered_path(path, number, numbered, sizeof(numbered)));
    assert_string_equal(numbered, wanted);
}

static void numbers_stand_in_their_places(void **state)
{
    (void)state;
    expect("%d", 0, "0");
    expect("a%d.png", 12, "a12.png");
    expect("a%04d.png", 12, "a0012.png");
    expect("a%02d.png", 10000000, "a10000000.png");
    expect("/x%d/%s%n%09d.exr", 3, "/x%d/%s%n000000003.exr");
}

static void a_path_that_does_not_fit_is_refused(void **state)
{
    (void)state;
    char numbered[8];
    assert_true(rg_numbered_path("ab%d.c", 12, numbered, sizeof(numbered)));
    rg_log_listen(log_last, NULL);
    assert_false(rg_numbered_path("ab%d.c", 123, numbered, 7));
    rg_log_listen(NULL, NULL);
    assert_string_equal(logged, "ab%d.c...: the path is too long; choose a shorter one");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_are_counted_in_the_name_alone),
        cmocka_unit_test(numbers_stand_in_their_places),
        cmocka_unit_test(a_path_that_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
