// Variables for a worker: set, replaced, removed and found, and joined with those of this process.
#include "harness/devices/drivers/variables.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "harness/devices/workers/environment.h"

static void expect(const struct rg_worker_variables *variables, const char *text, size_t size)
{
    assert_int_equal(variables->size, size);
    assert_memory_equal(variables->text, text, size + 1); // with the last zero
    assert_false(variables->failed);
}

#define EXPECT(variables, text) expect(variables, text, sizeof(text) - 1)

static void a_variable_has_its_last_value(void **state)
{
    (void)state;
    struct rg_worker_variables all = {.text = NULL};
    rg_variables_drop(&all, "A"); // there is none
    assert_true(rg_variables_set(&all, "A", "1"));
    EXPECT(&all, "A=1\0");
    assert_true(rg_variables_set(&all, "AB", "x=y"));
    assert_true(rg_variables_set(&all, "C", ""));
    EXPECT(&all, "A=1\0AB=x=y\0C=\0");
    assert_true(rg_variables_set(&all, "A", "long value"));
    EXPECT(&all, "AB=x=y\0C=\0A=long value\0");
    rg_variables_drop(&all, "C");
    rg_variables_drop(&all, "B");
    EXPECT(&all, "AB=x=y\0A=long value\0");
    rg_variables_drop(&all, "A");
    EXPECT(&all, "AB=x=y\0");
    rg_variables_drop(&all, "AB");
    assert_int_equal(all.size, 0);
    assert_int_equal(*all.text, 0);
    rg_variables_free(&all);
    assert_null(all.text);
    assert_int_equal(all.size, 0);
}

static void a_value_is_the_worker_s_or_ours(void **state)
{
    (void)state;
    struct rg_worker_variables all = {.text = NULL};
    setenv("RG_TEST_OURS", "ours", 1);
    unsetenv("RG_TEST_NONE");
    assert_string_equal(rg_variables_find(&all, "RG_TEST_OURS"), "ours");
    assert_null(rg_variables_find(&all, "RG_TEST_NONE"));
    assert_true(rg_variables_set(&all, "RG_TEST_OURS", "theirs"));
    assert_string_equal(rg_variables_find(&all, "RG_TEST_OURS"), "theirs");
    assert_true(rg_variables_set(&all, "RG_TEST_OURS", ""));
    assert_string_equal(rg_variables_find(&all, "RG_TEST_OURS"), "");
    rg_variables_free(&all);
}

static void a_key_is_found_whole(void **state)
{
    (void)state;
    const char *all = "AB=1\0B=A=2\0ABC=3\0E=\0";
    assert_string_equal(rg_environment_find(all, "AB"), "1");
    assert_string_equal(rg_environment_find(all, "ABC"), "3");
    assert_string_equal(rg_environment_find(all, "B"), "A=2");
    assert_string_equal(rg_environment_find(all, "E"), "");
    assert_null(rg_environment_find(all, "A"));
    assert_null(rg_environment_find(all, "BC"));
    assert_null(rg_environment_find("", "A"));
}

static void a_copy_holds_all(void **state)
{
    (void)state;
    static const char all[] = "AB=1\0C=\0";
    char *copy = rg_environment_copy(all), *none = rg_environment_copy(NULL);
    assert_memory_equal(copy, all, sizeof(all));
    assert_int_equal(*none, 0);
    free(copy);
    free(none);
}

// How often a line stands in an environment for a program.
static int count_of(char *const *environment, const char *line)
{
    int count = 0;
    for (char *const *v = environment; *v; v++)
        count += !strcmp(*v, line);
    return count;
}

static void a_program_gets_each_variable_once(void **state)
{
    (void)state;
    char theirs[] = "RG_TEST_TWO=theirs\0RG_TEST_NEW=new\0";
    setenv("RG_TEST_ONE", "ours", 1);
    setenv("RG_TEST_TWO", "ours", 1);
    setenv("RG_TEST_TWO_MORE", "ours", 1); // begins as another does
    unsetenv("RG_TEST_NEW");
    char **all = rg_environment_with(theirs);
    assert_int_equal(count_of(all, "RG_TEST_ONE=ours"), 1);
    assert_int_equal(count_of(all, "RG_TEST_TWO=theirs"), 1);
    assert_int_equal(count_of(all, "RG_TEST_TWO=ours"), 0);
    assert_int_equal(count_of(all, "RG_TEST_TWO_MORE=ours"), 1);
    assert_int_equal(count_of(all, "RG_TEST_NEW=new"), 1);
    free(all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_variable_has_its_last_value),
        cmocka_unit_test(a_value_is_the_worker_s_or_ours),
        cmocka_unit_test(a_key_is_found_whole),
        cmocka_unit_test(a_copy_holds_all),
        cmocka_unit_test(a_program_gets_each_variable_once),
    };
    return cmocka_run_group_tests_name("variables for workers", tests, NULL, NULL);
}
