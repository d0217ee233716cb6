// The audit tells an honest timer from a lying and from an absent one: cpu's, and two that replace
// it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "harness/devices/measure/timer_audit.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

static const struct rg_backend *honest;

static bool half_the_time(struct rg_device *device, int64_t *time_ns)
{
    bool ok = honest->time(device, time_ns);
    *time_ns /= 2;
    return ok;
}

static bool no_time(struct rg_device *device, int64_t *time_ns)
{
    (void)device;
    (void)time_ns;
    return rg_error("no timer");
}

static bool no_sync(struct rg_device *device)
{
    (void)device;
    return rg_error("lost");
}

static bool has_clock = true; // the device says that it has one

// Audits cpu with some of its functions replaced.
static bool audit(struct rg_backend backend, struct rg_timer_audit *result)
{
    struct rg_device *device = rg_device_open("cpu");
    assert_non_null(device);
    device->backend = &backend;
    device->info.limits.has_clock = has_clock;
    rg_log_listen(log_last, NULL);
    bool ok = rg_timer_audit(device, result);
    rg_log_listen(NULL, NULL);
    assert_int_equal(rg_device_work(device)->live_bytes, 0);
    device->backend = honest;
    assert_int_equal(rg_device_close(device), backend.sync == honest->sync);
    return ok;
}

static int find_honest(void **state)
{
    (void)state;
    struct rg_device *device = rg_device_open("cpu");
    honest = device ? device->backend : NULL;
    return rg_device_close(device) && honest ? 0 : -1;
}

// cpu's timer is the wall clock: its interval holds the wall's, so the ratio is never below 1.
static void an_honest_timer_is_read(void **state)
{
    (void)state;
    struct rg_timer_audit result;
    assert_true(audit(*honest, &result));
    assert_true(result.has_timer);
    assert_at_least(result.ratio, 1);
    assert_int_equal(result.trusted, result.ratio <= 1.05);
    assert_above(result.wall_ms, 0);
    assert_above(result.passes, 0);
    assert_above(result.round_trip_us, 0);
    assert_above(result.dispatch_us, 0);
}

static void a_lying_timer_is_not_trusted(void **state)
{
    (void)state;
    struct rg_timer_audit result;
    struct rg_backend liar = *honest;
    liar.time = half_the_time;
    assert_true(audit(liar, &result));
    assert_true(result.has_timer);
    assert_below(result.ratio, 0.8);
    assert_false(result.trusted);
}

static void an_absent_timer_is_a_result(void **state)
{
    (void)state;
    struct rg_timer_audit result;
    struct rg_backend without = *honest;
    without.time = no_time;
    has_clock = false;
    assert_true(audit(without, &result));
    has_clock = true;
    assert_false(result.has_timer);
    assert_false(result.trusted);
    assert_above(result.wall_ms, 0);
}

static void a_timer_that_fails_is_a_failure(void **state)
{
    (void)state;
    struct rg_timer_audit result;
    struct rg_backend broken = *honest;
    broken.time = no_time;
    assert_false(audit(broken, &result));
}

static void a_lost_device_is_a_failure(void **state)
{
    (void)state;
    struct rg_timer_audit result;
    struct rg_backend lost = *honest;
    lost.sync = no_sync;
    assert_false(audit(lost, &result));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_honest_timer_is_read),
        cmocka_unit_test(a_lying_timer_is_not_trusted),
        cmocka_unit_test(an_absent_timer_is_a_result),
        cmocka_unit_test(a_timer_that_fails_is_a_failure),
        cmocka_unit_test(a_lost_device_is_a_failure),
    };
    return cmocka_run_group_tests(tests, find_honest, NULL);
}
