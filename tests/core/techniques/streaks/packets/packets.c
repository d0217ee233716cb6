// Rain in packets: their contents, the choice of scheme, and refusals.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "tests/core/techniques/rigs/packets.h"
#include "tests/tools/expect.h"

// Each particle is in exactly one packet, inside that packet's rectangle. A packet is no larger
// than asked for.
static void check_packets(const struct streaks_packets *packets, int size)
{
    const struct streaks_packets_info *info = streaks_packets_info(packets);
    struct rig_particles all = rig_read_all(packets, &rig_space, 20);
    qsort(all.all, (size_t)all.count, sizeof(*all.all), rig_compare);
    for (int64_t i = 1; i < all.count; i++)
        assert_below(rig_compare(&all.all[i - 1], &all.all[i]), 0);
    int64_t sum = 0;
    for (int place = 0; place < info->places; place++) {
        const int64_t count = streaks_packets_count(packets, place);
        assert_at_most(count, size);
        sum += count;
        double r[4];
        streaks_packets_rectangle(packets, place, r);
        assert_below(r[0], r[2]);
        assert_below(r[1], r[3]);
        assert_at_least(r[0], -200);
        assert_at_least(r[1], -200);
        assert_at_most(r[2], 200.001);
        assert_at_most(r[3], 200.001);
    }
    assert_int_equal(sum, info->total_particles);
    free(all.all);
}

// A view of one packet's place selects that packet, whose particles are inside it.
static void check_places(const struct streaks_packets *packets, enum streaks_scheme scheme)
{
    const struct streaks_packets_info *info = streaks_packets_info(packets);
    struct streaks_selection selection = {0};
    for (int place = 0; place < info->places; place += 1 + (int)(info->places / 50)) {
        double r[4];
        streaks_packets_rectangle(packets, place, r);
        struct streaks_view view = rig_everywhere(&rig_space, 20);
        view.eye[0] = (r[0] + r[2]) / 2;
        view.eye[1] = (r[1] + r[3]) / 2;
        view.radius_m = 0;
        assert_true(streaks_select(packets, &view, &selection));
        bool found = streaks_packets_count(packets, place) == 0;
        for (int i = 0; i < selection.packets; i++)
            found = found || selection.selected[i] == place;
        assert_true(found);
        if (selection.packets != 1 || scheme == STREAKS_WORLD)
            continue;
        const struct rig_particles one = rig_read(packets, &rig_space, &selection);
        for (int64_t i = 0; i < one.count; i++) {
            assert_at_least(one.all[i].x_m, r[0] - 1e-4);
            assert_at_most(one.all[i].x_m, r[2] + 1e-4);
            assert_at_least(one.all[i].y_m, r[1] - 1e-4);
            assert_at_most(one.all[i].y_m, r[3] + 1e-4);
        }
        free(one.all);
    }
    streaks_selection_release(&selection);
}

static void test_packets_are_sound(void **state)
{
    (void)state;
    struct rg_density *map = rig_uneven_map();
    static const int sizes[] = {1, 10, 32, 100, 5000};
    for (int s = 1; s < 4; s++)
        for (int i = 0; i < 5; i++) {
            struct streaks_packets_settings settings = rig_settings(&rig_space, map, 20000);
            settings.scheme = rig_schemes[s];
            settings.packet_size = sizes[i];
            struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
            assert_int_equal(streaks_packets_info(packets)->scheme, rig_schemes[s]);
            check_packets(packets, sizes[i]);
            check_places(packets, rig_schemes[s]);
            streaks_packets_destroy(packets);
        }
    rg_density_destroy(map);
}

// Halving until no part exceeds the size leaves parts of n / 2^k, rounded up or down.
static void test_kd_halves_are_alike(void **state)
{
    (void)state;
    struct rg_density *map = rig_uneven_map();
    static const int sizes[] = {1, 7, 100, 2500, 2499, 9999};
    for (int i = 0; i < 6; i++) {
        struct streaks_packets_settings settings = rig_settings(&rig_space, map, 20000);
        settings.scheme = STREAKS_KD;
        settings.packet_size = sizes[i];
        struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
        int64_t least = INT64_MAX, most = 0;
        for (int place = 0; place < streaks_packets_info(packets)->places; place++) {
            const int64_t count = streaks_packets_count(packets, place);
            least = count < least ? count : least;
            most = count > most ? count : most;
        }
        assert_at_most(most, sizes[i]);
        assert_true((most - least <= 1 || 2 * least >= most));
        assert_true(2 * least >= sizes[i] || least == most || sizes[i] == 1);
        streaks_packets_destroy(packets);
    }
    rg_density_destroy(map);
}

// The map has rain on one texel of many: packets stay small even where particles crowd into one
// place.
static void test_crowded(void **state)
{
    (void)state;
    enum { SIDE = 600 };
    float *texels = calloc(SIDE * SIDE, sizeof(*texels));
    assert_non_null(texels);
    texels[SIDE * 123 + 456] = 1;
    struct rg_density *map = rig_map(SIDE, SIDE, texels);
    free(texels);
    struct streaks_packets_settings settings = rig_settings(&rig_space, map, 30000);
    for (int i = 1; i < 3; i++) {
        settings.scheme = rig_schemes[i];
        settings.packet_size = 3;
        struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
        check_packets(packets, 3);
        const struct rig_particles all = rig_read_all(packets, &rig_space, 20);
        for (int64_t k = 0; k < all.count; k++) {
            assert_int_equal((all.all[k].x_m / 200 + 1) / 2 * SIDE, 456);
            assert_int_equal((all.all[k].y_m / 200 + 1) / 2 * SIDE, 123);
        }
        free(all.all);
        streaks_packets_destroy(packets);
    }
    rg_density_destroy(map);
}

// --- the automatic choice ---

static int64_t packets_of(const struct rg_density *map, struct streaks_packets_settings settings,
                          enum streaks_scheme scheme, enum streaks_scheme *chosen)
{
    settings.scheme = scheme;
    struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
    const int64_t count = streaks_packets_info(packets)->packets;
    *chosen = streaks_packets_info(packets)->scheme;
    streaks_packets_destroy(packets);
    return count;
}

static void test_auto_takes_the_fewest(void **state)
{
    (void)state;
    // Most of this rain falls in one quarter, and the density differs everywhere. It takes 7
    // quarters of a quad-tree, 8 halves, or a grid of 16 different cells.
    static const float quarter[16] = {1,     0.98f, 0.26f, 0.25f, 0.96f, 0.94f, 0.24f, 0.23f,
                                      0.27f, 0.22f, 0.28f, 0.21f, 0.2f,  0.29f, 0.3f,  0.19f};
    struct rg_density *maps[3] = {rig_uneven_map(), rg_density_gradient(), rig_map(4, 4, quarter)};
    int seen[5] = {0};
    for (int m = 0; m < 3; m++)
        for (int size = m < 2 ? 100 : 7700; size <= 200000; size = size * 4 + 7) {
            struct streaks_packets_settings settings = rig_settings(&rig_space, maps[m], 50000);
            settings.packet_size = size;
            int64_t fewest = INT64_MAX;
            enum streaks_scheme chosen;
            for (int i = 1; i < 4; i++) {
                const int64_t count = packets_of(maps[m], settings, rig_schemes[i], &chosen);
                fewest = count < fewest ? count : fewest;
            }
            assert_int_equal(packets_of(maps[m], settings, STREAKS_AUTO, &chosen), fewest);
            assert_int_equal(chosen == STREAKS_WORLD, size >= 50000);
            seen[chosen]++;
        }
    assert_true(seen[STREAKS_WORLD] && seen[STREAKS_KD] && seen[STREAKS_QUAD] &&
                seen[STREAKS_GRID]);
    for (int m = 0; m < 3; m++)
        rg_density_destroy(maps[m]);
}

// --- what is refused ---

static void test_wrong_settings(void **state)
{
    (void)state;
    struct rg_density *map = rig_uneven_map();
    const struct streaks_packets_settings good = rig_settings(&rig_space, map, 50000);
    struct streaks_packets_settings wrong[16];
    int count = 0;
    for (int i = 0; i < 16; i++)
        wrong[i] = good;
    wrong[count++].drops_m2_s = 0;
    wrong[count++].drops_m2_s = -3;
    wrong[count++].drops_m2_s = NAN;
    wrong[count++].drops_m2_s = 1e-12;
    wrong[count++].drops_m2_s = 1e300;
    wrong[count++].drops_m2_s = INFINITY;
    wrong[count++].fall_speed_m_s = 0;
    wrong[count++].fall_speed_m_s = NAN;
    wrong[count++].local_height_m = -20;
    wrong[count++].packet_size = 0;
    wrong[count++].packet_size = -5;
    wrong[count++].scheme = (enum streaks_scheme)9;
    for (int i = 0; i < 4; i++, count++) { // each scheme without enough memory
        wrong[count].scheme = rig_schemes[i];
        wrong[count].packet_size = 50000;
        wrong[count].memory_bytes = rig_schemes[i] == STREAKS_GRID ? 10000 : 12 * 50000 - 1;
    }
    for (int i = 0; i < count; i++) {
        rig_listen();
        assert_null(streaks_packets_create(&rig_space, map, &wrong[i]));
        assert_int_equal(rig_errors(), 1);
    }
    // One particle a packet with crowded rain: more cells than a grid may have.
    float texels[64 * 64] = {[777] = 1};
    struct rg_density *dot = rig_map(64, 64, texels);
    struct streaks_packets_settings crowded = rig_settings(&rig_space, dot, 50000);
    crowded.scheme = STREAKS_GRID;
    crowded.packet_size = 1;
    rig_listen();
    assert_null(streaks_packets_create(&rig_space, dot, &crowded));
    assert_int_equal(rig_errors(), 1);
    rg_density_destroy(dot);
    rg_density_destroy(map);
}

// The memory announced beforehand is at least the memory taken, and not far more.
static void test_memory_is_told(void **state)
{
    (void)state;
    struct rg_density *map = rig_uneven_map();
    for (int i = 0; i < 4; i++) {
        struct streaks_packets_settings settings = rig_settings(&rig_space, map, 200000);
        settings.scheme = rig_schemes[i];
        struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
        const struct streaks_packets_info info = *streaks_packets_info(packets);
        int64_t bytes, sum = 0;
        for (int k = 0; k < streaks_packets_buffers(packets); k++) {
            assert_non_null(streaks_packets_buffer(packets, k, &bytes));
            sum += bytes;
        }
        assert_int_equal(sum, info.particle_bytes);
        assert_at_most(info.stored_particles * 12, sum);
        assert_at_least(info.peak_bytes, sum);
        assert_at_most(info.peak_bytes, 4 * sum);
        streaks_packets_destroy(packets);
        // Exactly this much is enough, and a byte less is not.
        settings.memory_bytes = info.peak_bytes;
        packets = rig_packets(&rig_space, map, &settings);
        streaks_packets_forget(packets);
        assert_null(streaks_packets_buffer(packets, 0, &bytes));
        const struct streaks_view view = rig_everywhere(&rig_space, 20);
        struct streaks_selection selection = {0};
        assert_true(streaks_select(packets, &view, &selection));
        assert_int_equal(selection.particles, info.total_particles);
        streaks_selection_release(&selection);
        streaks_packets_destroy(packets);
        settings.memory_bytes--;
        rig_listen();
        assert_null(streaks_packets_create(&rig_space, map, &settings));
        assert_int_equal(rig_errors(), 1);
    }
    rg_density_destroy(map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_packets_are_sound), cmocka_unit_test(test_kd_halves_are_alike),
        cmocka_unit_test(test_crowded),           cmocka_unit_test(test_auto_takes_the_fewest),
        cmocka_unit_test(test_wrong_settings),    cmocka_unit_test(test_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
