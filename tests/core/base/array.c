// Arrays that grow.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "tests/tools/expect.h"

static void elements_stay_while_an_array_grows(void **state)
{
    (void)state;
    uint32_t *numbers = NULL;
    int64_t room = 0;
    int moves = 0;
    for (int64_t count = 0; count < 10000; count++) {
        const int64_t before = room;
        assert_true(rg_array_fit(&numbers, &room, count + 1, sizeof(*numbers), "numbers"));
        assert_above(room, count);
        moves += room != before;
        numbers[count] = (uint32_t)(count * count);
    }
    for (int64_t i = 0; i < 10000; i++)
        assert_int_equal(numbers[i], (uint32_t)(i * i));
    assert_below(moves, 10); // it doubles: 64, 128, ...
    free(numbers);
}

static void an_array_takes_many_at_once(void **state)
{
    (void)state;
    char *bytes = NULL;
    int64_t room = 0;
    assert_true(rg_array_fit(&bytes, &room, 5000, 3, "bytes"));
    assert_int_equal(room, 5000);
    memset(bytes, 1, 15000);
    assert_true(rg_array_fit(&bytes, &room, 4000, 3, "bytes"));
    assert_int_equal(room, 5000);
    free(bytes);
}

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)line;
    ++*(int *)user;
}

static void an_array_without_memory_is_as_it_was(void **state)
{
    (void)state;
    int lines = 0;
    rg_log_listen(hear, &lines);
    double *values = NULL;
    int64_t room = 0;
    assert_true(rg_array_fit(&values, &room, 1, sizeof(*values), "values"));
    values[0] = 7;
    const int64_t had = room;
    assert_false(rg_array_fit(&values, &room, INT64_MAX / 4, sizeof(*values), "values"));
    assert_int_equal(lines, 1);
    assert_non_null(strstr(rg_last_error(), "values: no memory"));
    assert_int_equal(room, had);
    assert_equals(values[0], 7);
    rg_log_listen(NULL, NULL);
    free(values);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elements_stay_while_an_array_grows),
        cmocka_unit_test(an_array_takes_many_at_once),
        cmocka_unit_test(an_array_without_memory_is_as_it_was),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
