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

static void expect_ceilings(struct fake_device *fake, double memory, double cache,
                            double arithmetic)
{
    struct rg_ceilings ceilings;
    assert_true(rg_ceilings_measure(&fake->pub, &ceilings));
    assert_near(ceilings.memory_gb_s, memory, 1e-6);
    assert_near(ceilings.cache_gb_s, cache, 1e-6);
    assert_near(ceilings.arithmetic_gop_s, arithmetic, 1e-6);
}

// A copy of 1 MiB reads and writes 2 MiB; the runs that compile do not count, nor do slow ones.
static void test_ceilings(void **state)
{
    (void)state;
    struct fake_device *fake = fake_open();
    fake->word_ms = 1e-6; // 8 bytes a nanosecond
    fake->item_ms = 2e-6;
    fake->slow_runs = 3;
    expect_ceilings(fake, 8, 8, PROBE_ARITHMETIC_OPS / 2.0);
    fake->slow_every = 64;
    expect_ceilings(fake, 8, 8, PROBE_ARITHMETIC_OPS / 2.0);
    assert_true(rg_device_close(&fake->pub));
}

// Copies of 1 MiB stay in a cache that holds 2^18 words, and larger ones do not.
static void test_caches(void **state)
{
    (void)state;
    struct fake_device *fake = fake_open();
    fake->word_ms = 1e-6;
    fake->item_ms = 2e-6;
    fake->cache_items = 262144;
    expect_ceilings(fake, 4, 8, PROBE_ARITHMETIC_OPS / 2.0);
    fake->cache_items = 12 * 262144; // it holds 8 MiB
    expect_ceilings(fake, 4, 8, PROBE_ARITHMETIC_OPS / 2.0);
    fake->cache_items = 48 * 262144; // it holds 32 MiB, and no copy of 64
    expect_ceilings(fake, 4, 8, PROBE_ARITHMETIC_OPS / 2.0);
    assert_true(rg_device_close(&fake->pub));
}

// If waiting takes most of the time of a batch, the largest work decides: copies of 128 MiB on a
// processor, on a GPU as large as it allows, of 16 MiB in a cache, sums of 2^24 items.
static void test_large_ceilings(void **state)
{
    (void)state;
    struct fake_device *fake = fake_open();
    const double mib_ms = 0.262144, item_ms = 2e-6, wait_ms = 1000; // a MiB has 2^18 words
    fake->word_ms = 1e-6;
    fake->item_ms = item_ms;
    fake->sync_ms = wait_ms;
    fake->pub.info.software = true;
    const double ops = PROBE_ARITHMETIC_OPS * 16777216e-6 / (16777216 * item_ms + wait_ms);
    expect_ceilings(fake, 128 * 2.097152 / (128 * mib_ms + wait_ms),
                    16 * 2.097152 / (16 * mib_ms + wait_ms), ops);
    fake->pub.info.software = false;
    fake->pub.info.limits.max_buffer_bytes = 300 << 20;
    expect_ceilings(fake, 256 * 2.097152 / (256 * mib_ms + wait_ms),
                    16 * 2.097152 / (16 * mib_ms + wait_ms), ops);
    assert_true(rg_device_close(&fake->pub));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_costs),  cmocka_unit_test(test_load),
        cmocka_unit_test(test_trust),  cmocka_unit_test(test_ceilings),
        cmocka_unit_test(test_caches), cmocka_unit_test(test_large_ceilings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
