// The words of outcomes, and the last error.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "core/base/outcome.h"
#include "tests/tools/process/logged.h"

static void outcomes_are_found_by_their_names(void **state)
{
    (void)state;
    static const char *const names[] = {"ok",    "fail",    "unsupported", "error",
                                        "crash", "timeout", "nothing"};
    for (int i = 0; i < RG_LACKING; i++) { // later outcomes are errors with a fault beside them
        enum rg_outcome found = (enum rg_outcome)((i + 1) % RG_OUTCOME_COUNT);
        assert_string_equal(rg_outcome_name((enum rg_outcome)i), names[i]);
        assert_true(rg_outcome_find(names[i], &found));
        assert_int_equal(found, i);
    }
    assert_string_equal(rg_outcome_name(RG_LACKING), "error"); // the word that older readers know
    assert_string_equal(rg_outcome_name(RG_SETUP), "error");
    enum rg_outcome untouched = RG_CRASH;
    assert_false(rg_outcome_find("unknown", &untouched));
    assert_false(rg_outcome_find("", &untouched));
    assert_int_equal(untouched, RG_CRASH);
}

static void what_kept_work_from_being_done_is_broken(void **state)
{
    (void)state;
    static const bool due[RG_OUTCOME_COUNT] = {[RG_ERROR] = true,
                                               [RG_CRASH] = true,
                                               [RG_TIMEOUT] = true,
                                               [RG_LACKING] = true,
                                               [RG_SETUP] = true};
    for (int i = 0; i < RG_OUTCOME_COUNT; i++)
        assert_int_equal(rg_outcome_is_broken((enum rg_outcome)i), due[i]);
}

static void errors_are_of_a_kind(void **state)
{
    (void)state;
    rg_log_listen(log_last, NULL);
    assert_false(rg_driver_error("the driver's %d", 1));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_DRIVER);
    assert_int_equal(rg_failure_take().outcome, RG_ERROR);
    assert_string_equal(rg_last_error(), "the driver's 1");
    assert_null(rg_unsupported_null("nobody's"));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_NONE);
    rg_warning("no error"); // warnings do not change the last error
    rg_info("no error");
    assert_int_equal(rg_failure_take().outcome, RG_UNSUPPORTED);
    assert_string_equal(rg_last_error(), "nobody's");
    assert_null(rg_error_null("the user's"));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_INPUT);
    assert_int_equal(rg_failure_take().outcome, RG_ERROR);
    assert_false(rg_unsupported("nobody's"));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_NONE);
    assert_null(rg_driver_error_null("the driver's"));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_DRIVER);
    assert_false(rg_error("the user's"));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_INPUT);
    assert_null(rg_harness_error_null("its own"));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_HARNESS);
    assert_int_equal(rg_failure_take().outcome, RG_LACKING);
    assert_false(rg_setup_error("the machine's"));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_SETUP);
    assert_int_equal(rg_failure_take().outcome, RG_SETUP);
    rg_log_listen(NULL, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outcomes_are_found_by_their_names),
        cmocka_unit_test(what_kept_work_from_being_done_is_broken),
        cmocka_unit_test(errors_are_of_a_kind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
