// Which exit status each outcome and error becomes.
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "tests/tools/process/logged.h"

static void each_outcome_has_one(void **state)
{
    (void)state;
    static const int due[RG_OUTCOME_COUNT] = {
        [RG_OK] = 0,      [RG_FAIL] = 1,    [RG_UNSUPPORTED] = 77, [RG_ERROR] = 1, [RG_CRASH] = 1,
        [RG_TIMEOUT] = 1, [RG_NOTHING] = 4, [RG_LACKING] = 71,     [RG_SETUP] = 1};
    for (int i = 0; i < RG_OUTCOME_COUNT; i++)
        assert_int_equal(rg_exit_of((enum rg_outcome)i), due[i]);
}

static void failures_outweigh_what_is_ok(void **state)
{
    (void)state;
    int counts[RG_OUTCOME_COUNT] = {0};
    assert_int_equal(rg_exit_of_all(counts), RG_EXIT_NOTHING);
    counts[RG_UNSUPPORTED] = 3;
    assert_int_equal(rg_exit_of_all(counts), RG_EXIT_UNSUPPORTED);
    counts[RG_OK] = 1;
    assert_int_equal(rg_exit_of_all(counts), RG_EXIT_PASS);
    static const enum rg_outcome failures[] = {RG_FAIL, RG_ERROR, RG_CRASH, RG_TIMEOUT, RG_SETUP};
    for (int i = 0; i < 5; i++) {
        counts[failures[i]] = 1;
        assert_int_equal(rg_exit_of_all(counts), RG_EXIT_FAIL);
        counts[RG_LACKING] = 1;
        assert_int_equal(rg_exit_of_all(counts), RG_EXIT_FAIL);
        counts[failures[i]] = 0;
        assert_int_equal(rg_exit_of_all(counts), RG_EXIT_HARNESS);
        counts[RG_LACKING] = 0;
    }
}

static void what_proves_nothing_is_no_pass(void **state)
{
    (void)state;
    int counts[RG_OUTCOME_COUNT] = {[RG_NOTHING] = 1};
    assert_int_equal(rg_exit_of_all(counts), RG_EXIT_NOTHING);
    counts[RG_OK] = counts[RG_UNSUPPORTED] = 5;
    assert_int_equal(rg_exit_of_all(counts), RG_EXIT_NOTHING);
    counts[RG_CRASH] = 1;
    assert_int_equal(rg_exit_of_all(counts), RG_EXIT_FAIL);
    assert_int_equal(rg_exit_with(RG_EXIT_PASS, 0), RG_EXIT_NOTHING);
    assert_int_equal(rg_exit_with(RG_EXIT_PASS, 1), RG_EXIT_PASS);
    assert_int_equal(rg_exit_with(RG_EXIT_FAIL, 0), RG_EXIT_FAIL);
    assert_int_equal(rg_exit_with(RG_EXIT_UNSUPPORTED, 0), RG_EXIT_UNSUPPORTED);
}

static void only_users_make_bad_usage(void **state)
{
    (void)state;
    rg_log_listen(log_last, NULL);
    rg_driver_error("the driver's");
    assert_int_equal(rg_exit_of_error(), RG_EXIT_FAIL);
    rg_unsupported("nobody's");
    assert_int_equal(rg_exit_of_error(), RG_EXIT_UNSUPPORTED);
    rg_error("the user's");
    assert_int_equal(rg_exit_of_error(), RG_EXIT_USAGE);
    rg_harness_error("its own");
    assert_int_equal(rg_exit_of_error(), RG_EXIT_HARNESS);
    rg_system_error(ENOSPC, "its own");
    assert_int_equal(rg_exit_of_error(), RG_EXIT_HARNESS);
    rg_system_error(ENOENT, "the user's");
    assert_int_equal(rg_exit_of_error(), RG_EXIT_USAGE);
    rg_log_listen(NULL, NULL);
}

// Each status outweighs those after it in the list, in either order of arguments.
static void the_worse_of_two_is_kept(void **state)
{
    (void)state;
    static const int order[] = {RG_EXIT_SIGNALLED + 15, RG_EXIT_SIGNALLED + 2, RG_EXIT_USAGE,
                                RG_EXIT_FAIL,           RG_EXIT_HARNESS,       RG_EXIT_INCONCLUSIVE,
                                RG_EXIT_NOTHING,        RG_EXIT_UNSUPPORTED,   RG_EXIT_PASS};
    for (int i = 0; i < 9; i++) {
        for (int j = i; j < 9; j++) {
            assert_int_equal(rg_exit_worse(order[i], order[j]), order[i]);
            assert_int_equal(rg_exit_worse(order[j], order[i]), order[i]);
        }
    }
}

// A record may tell any number; only those that commands end with are taken.
static void a_records_status_is_one_of_ours(void **state)
{
    (void)state;
    static const struct {
        int told, taken;
    } rows[] = {{0, 0}, {1, 1},  {2, 2},  {3, 3},   {4, 4},   {71, 71}, {77, 77},
                {5, 1}, {-1, 1}, {70, 1}, {127, 1}, {128, 1}, {130, 1}, {1 << 30, 1}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        json_t *json = json_integer(rows[i].told);
        assert_int_equal(rg_exit_of_record(json), rows[i].taken);
        json_decref(json);
    }
    assert_int_equal(rg_exit_with(RG_EXIT_PASS, -1), RG_EXIT_NOTHING);
}

static void output_that_is_lost_is_no_users_fault(void **state)
{
    (void)state;
    rg_log_listen(log_last, NULL);
    assert_false(rg_stdout_error());
    rg_log_listen(NULL, NULL);
    assert_int_equal(rg_exit_of_error(), RG_EXIT_HARNESS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_outcome_has_one),
        cmocka_unit_test(failures_outweigh_what_is_ok),
        cmocka_unit_test(what_proves_nothing_is_no_pass),
        cmocka_unit_test(only_users_make_bad_usage),
        cmocka_unit_test(the_worse_of_two_is_kept),
        cmocka_unit_test(a_records_status_is_one_of_ours),
        cmocka_unit_test(output_that_is_lost_is_no_users_fault),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
