// One host thread that allocates and frees particles makes the same rain, to the bit, as slots on
// the device: shower heap DEVICE.
#include <stdio.h>
#include <stdlib.h>

#include "tests/core/techniques/shower/rig.h"

static void expect_same(struct shower *a, struct shower *b, const char *name)
{
    void *first = pour_words(a, name), *second = pour_words(b, name);
    assert_memory_equal(first, second, rg_asset_find(&a->base, name)->buf->size);
    free(first);
    free(second);
}

static void allocated_particles_are_the_same(void **state)
{
    (void)state;
    static const char *const settings[] = {
        "particles=2000 variation=0.3 system=traditional wind_m_s=6 gust=0.5 drop_height_m=0.5",
        "particles=2000 variation=0.3 wind_m_s=3 walk_m_s=4 drop_height_m=0.5",
    };
    for (int i = 0; i < 2; i++) {
        char all[256];
        struct shower *both[2];
        for (int k = 0; k < 2; k++) {
            snprintf(all, sizeof(all), "%s renewal=%s", settings[i], k ? "heap" : "birth");
            both[k] = pour_open(all, 64, 36);
            pour_step(both[k], 40);
        }
        expect_same(both[0], both[1], "particles");
        expect_same(both[0], both[1], "tally");
        if (both[0]->params.is_full)
            for (int plane = 0; plane < SHOWER_ATTRIBUTES; plane++) {
                float *a = pour_attributes(both[0], plane), *b = pour_attributes(both[1], plane);
                struct oracle_drop *drops = pour_read(both[0]);
                for (int slot = 0; slot < both[0]->params.slots; slot++)
                    assert_true(drops[slot].fall_m_s == 0 || a[slot] == b[slot]);
                free(drops);
                free(a);
                free(b);
            }
        for (int c = 0; c < SHOWER_COUNTERS; c++)
            assert_int_equal(both[0]->base.counters[c].value, both[1]->base.counters[c].value);
        pour_close(both[0]);
        pour_close(both[1]);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(allocated_particles_are_the_same),
    };
    return pour_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
