// The timer audit and the ceilings of a device whose every cost is known.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "harness/devices/measure/ceilings.h"
#include "harness/devices/measure/timer_audit.h"
#include "kernels/probe/arithmetic_params.h"
#include "tests/harness/devices/measuring/fake.h"
#include "tests/tools/expect.h"

static void audit(double clock_rate, double word_ms, struct rg_timer_audit *result)
{
    struct fake_device *fake = fake_open();
    fake->clock_rate = clock_rate;
    fake->sync_ms = 0.01;
    fake->run_ms = 0.002;
    fake->word_ms = word_ms;
    fake->slow_runs = 1;
    assert_true(rg_timer_audit(&fake->pub, result));
    assert_true(rg_device_close(&fake->pub));
}

static void test_costs(void **state)
{
    (void)state;
    struct rg_timer_audit result;
    audit(1, 1e-6, &result); // a pass of the load: 1.05 ms
    assert_between(result.passes, 48, 60);
    assert_near(result.wall_ms, result.passes * (0.002 + 1.048576) + 0.01, 1e-3);
    assert_near(result.sync_us, 10, 1e-3);
    assert_near(result.round_trip_us, 12.001, 1e-3);
    assert_near(result.dispatch_us, 2.001 + 0.1, 1e-3);
}

// A load lasts 50 ms, however long its pass is.
static void test_load(void **state)
{
    (void)state;
    struct rg_timer_audit result;
    audit(1, 1e-4, &result);
    assert_int_equal(result.passes, 1);
    audit(1, 1e-5, &result); // 10 ms, and 105 ms in the run that compiles
    assert_between(result.passes, 5, 8);
    audit(1, 1e-9, &result); // 0.003 ms: 8 times as many passes at a time, up to 50 ms
    assert_between((int)result.wall_ms, 50, 70);
    struct fake_device *fake = fake_open(); // takes no time
    assert_true(rg_timer_audit(&fake->pub, &result));
    assert_int_equal(result.passes, 20000);
    assert_true(rg_device_close(&fake->pub));
}

// Rates on both sides of the bounds within which a timer is trusted.
static void test_trust(void **state)
{
    (void)state;
    static const struct {
        double rate;
        bool trusted;
    } cases[] = {{1, true}, {0.81, true}, {0.79, false}, {1.04, true}, {1.06, false}, {0, false}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_timer_audit result;
        audit(cases[i].rate, 1e-6, &result);
        assert_true(result.has_timer);
        assert_near(result.ratio, cases[i].rate, 1e-3);
        assert_near(result.api_ms, cases[i].rate * result.wall_ms, 0.1);
        assert_int_equal(result.trusted, cases[i].trusted);
        assert_int_equal(rg_timer_is_trusted(cases[i].rate), cases[i].trusted);
    }
}

// A copy of 64 MiB reads and writes 134 MB; the runs that compile do not count.
static void test_ceilings(void **state)
{
    (void)state;
    struct fake_device *fake = fake_open();
    struct rg_ceilings ceilings;
    fake->word_ms = 1e-6; // 8 bytes a nanosecond
    fake->item_ms = 2e-6;
    fake->slow_runs = 3;
    assert_true(rg_ceilings_measure(&fake->pub, &ceilings));
    assert_near(ceilings.memory_gb_s, 8, 1e-6);
    assert_near(ceilings.cache_gb_s, 8, 1e-6);
    assert_near(ceilings.arithmetic_gop_s, PROBE_ARITHMETIC_OPS / 2.0, 1e-6);
    fake->runs = 0;
    fake->slow_every = 9; // the last of the large copies
    assert_true(rg_ceilings_measure(&fake->pub, &ceilings));
    assert_near(ceilings.memory_gb_s, 8, 1e-6);
    fake->slow_every = 0;
    fake->sync_ms = 16; // one wait a batch: of one large copy, of 16 small ones
    assert_true(rg_ceilings_measure(&fake->pub, &ceilings));
    assert_near(ceilings.memory_gb_s, 134.217728 / (16.777216 + 16), 1e-6);
    assert_near(ceilings.cache_gb_s, 2.097152 / (0.262144 + 1), 1e-6);
    assert_true(rg_device_close(&fake->pub));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_costs),
        cmocka_unit_test(test_load),
        cmocka_unit_test(test_trust),
        cmocka_unit_test(test_ceilings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
