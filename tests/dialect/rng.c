// Compares kernels/dialect/rng.h with Random123's own Philox and with its published known answers.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <Random123/philox.h>

#include "kernels/dialect/rng.h"
#include "tests/tools/expect.h"

// Random123's kat_vectors for philox4x32, 10 rounds.
static void known_answers(void **state)
{
    (void)state;
    static const struct {
        rg_uint4 counter;
        uint key[2];
        rg_uint4 expected;
    } cases[] = {
        {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
        {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
         {0xffffffff, 0xffffffff},
         {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
        {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
         {0xa4093822, 0x299f31d0},
         {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        rg_uint4 got = rg_philox(cases[i].counter, cases[i].key[0], cases[i].key[1]);
        assert_memory_equal(&got, &cases[i].expected, sizeof(got));
    }
}

static void equals_random123(void **state)
{
    (void)state;
    for (uint i = 0; i < 100000; i++) {
        uint item = i * 2654435761u, step = i / 7, stream = i % 13, seed = i ^ 0x5eedu;
        philox4x32_ctr_t counter = {{item, step, stream, 0}};
        philox4x32_key_t key = {{seed, 0}};
        philox4x32_ctr_t expected = philox4x32(counter, key);
        rg_uint4 got = rg_random(seed, item, step, stream);
        assert_memory_equal(&got, expected.v, sizeof(got));
        counter.v[3] = ~i;
        key.v[1] = i * 40503u;
        expected = philox4x32(counter, key);
        got = rg_philox((rg_uint4){item, step, stream, ~i}, seed, i * 40503u);
        assert_memory_equal(&got, expected.v, sizeof(got));
    }
}

static void uniforms_fill_the_unit_interval(void **state)
{
    (void)state;
    assert_equals(rg_uniform(0), 0.0f);
    assert_equals(rg_uniform(0xff), 0.0f);
    assert_equals(rg_uniform(0x100), 0x1p-24f);
    assert_equals(rg_uniform(0xffffffff), 1.0f - 0x1p-24f);
    double sum = 0.0;
    const int count = 100000;
    for (int i = 0; i < count; i++)
        sum += (double)rg_uniform(rg_random(1, (uint)i, 0, 0).x);
    // The mean's standard deviation is 1 / sqrt(12 count) = 0.0009.
    assert_below(fabs(sum / count - 0.5), 0.004);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_answers),
        cmocka_unit_test(equals_random123),
        cmocka_unit_test(uniforms_fill_the_unit_interval),
    };
    return cmocka_run_group_tests_name("rng", tests, NULL, NULL);
}
