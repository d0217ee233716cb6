// Rain in the packets of a grid has the density of a tree's rain: by chance, and by its map.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/rigs/packets.h"
#include "tests/oracle/streaks/packets.h"
#include "tests/tools/expect.h"

// Counts particles in the squares of a board, under two schemes that differ only by chance. A grid
// scatters no more than single particles, so that its chi-square may be small but not large.
static void test_grid_agrees_with_trees(void **state)
{
    (void)state;
    enum { SIDE = 20 };
    struct rg_density *map = rg_density_gradient();
    static const int sizes[] = {100, 1000, 20000, 300000};
    for (int size = 0; size < 4; size++) {
        int64_t counts[2][SIDE * SIDE] = {{0}}, totals[2];
        double step = 0;
        const int side = size >= 2 ? 16 : SIDE; // the grid's own side if its cells are large
        for (int i = 0; i < 2; i++) {
            struct streaks_packets_settings settings = rig_settings(&rig_space, map, 300000);
            settings.scheme = i ? STREAKS_GRID : STREAKS_KD;
            settings.packet_size = sizes[size];
            struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
            const struct streaks_packets_info *info = streaks_packets_info(packets);
            struct rig_particles all = rig_read_all(packets, &rig_space, 20);
            double *falls = malloc((size_t)all.count * sizeof(*falls));
            assert_non_null(falls);
            for (int64_t k = 0; k < all.count; k++) {
                const struct rig_particle *p = &all.all[k];
                falls[k] = p->fall;
                counts[i][(int)((p->y_m / 200 + 1) / 2 * side) * side +
                          (int)((p->x_m / 200 + 1) / 2 * side)]++;
            }
            totals[i] = all.count;
            // Densities come in 255 steps, and are rounded up or down at random.
            step = settings.drops_m2_s / 8 * 20 * 400 * 400 / (double)info->places / 255;
            if (i && size >= 2)
                assert_int_equal(info->grid_x, side);
            // Buckets repeat, but each place turns them differently. Thus 1 in 1000 is not reached,
            // but heights are uniform to a percent.
            oracle_evenness(falls, all.count);
            for (int64_t k = 0; k < all.count; k += 1000)
                assert_below(fabs(falls[k] - (double)k / (double)all.count), 0.01);
            free(falls);
            free(all.all);
            streaks_packets_destroy(packets);
        }
        const double z = (double)(totals[1] - totals[0]) / sqrt((double)totals[0]);
        assert_below(fabs(z), 3.3);
        double chi_square = 0;
        int degrees = 0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            const double sum = (double)(counts[0][i] + counts[1][i]);
            const double apart = (double)(counts[0][i] - counts[1][i]);
            chi_square += sum >= 20 ? apart * apart / (sum + step * step / 4) : 0;
            degrees += sum >= 20;
        }
        assert_at_least(degrees, side * side / 2);
        rig_expect_chance(oracle_chi_square_tail(chi_square, degrees), "a grid against a kd-tree");
    }
    rg_density_destroy(map);
}

// However large packets may be, cells are no larger than the map's shapes. Measured by the share of
// the rain that falls in the wrong squares of a 32 x 32 board, apart from chance.
static void test_grid_has_the_forms_of_its_map(void **state)
{
    (void)state;
    enum { SIDE = 32 };
    float texels[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++) // a hole in the middle and a chequered edge
        texels[i] = abs(i % SIDE - 16) + abs(i / SIDE - 16) < 9 ? 0.0f
                    : i % SIDE < 5                              ? (float)((i + i / SIDE) % 2)
                                                                : 0.7f;
    struct rg_density *map = rig_map(SIDE, SIDE, texels);
    struct streaks_packets_settings settings = rig_settings(&rig_space, map, 3000000);
    settings.scheme = STREAKS_GRID;
    settings.packet_size = 3000000;
    struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
    struct rig_particles all = rig_read_all(packets, &rig_space, 20);
    int64_t counts[SIDE * SIDE] = {0};
    for (int64_t k = 0; k < all.count; k++)
        counts[(int)((all.all[k].y_m / 200 + 1) / 2 * SIDE) * SIDE +
               (int)((all.all[k].x_m / 200 + 1) / 2 * SIDE)]++;
    const double mass = rg_density_mass(map, 0, 0, SIDE, SIDE);
    double elsewhere = 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        elsewhere += fabs((double)counts[i] - (double)texels[i] / mass * (double)all.count) / 2;
    print_message("%d x %d cells, %.2f %% of the rain elsewhere\n",
                  streaks_packets_info(packets)->grid_x, streaks_packets_info(packets)->grid_y,
                  100 * elsewhere / (double)all.count);
    assert_below(elsewhere, 0.07 * (double)all.count);
    free(all.all);
    streaks_packets_destroy(packets);
    rg_density_destroy(map);
}

// A map with a texel for each of the grid's cells keeps its densities exactly.
static void test_grid_is_exact_on_its_own_map(void **state)
{
    (void)state;
    float texels[16];
    for (int i = 0; i < 16; i++)
        texels[i] = (float)i / 15;
    struct rg_density *map = rig_map(4, 4, texels);
    struct streaks_packets_settings settings = rig_settings(&rig_space, map, 8 * 15000);
    settings.scheme = STREAKS_GRID;
    settings.packet_size = 15000;
    struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
    const struct streaks_packets_info *info = streaks_packets_info(packets);
    assert_int_equal(info->grid_x, 4);
    assert_int_equal(info->grid_y, 4);
    assert_int_equal(info->packets, 15);
    assert_int_equal(info->stored_particles, 120000);
    for (int place = 0; place < 16; place++)
        assert_int_equal(streaks_packets_count(packets, place), place * 1000);
    streaks_packets_destroy(packets);
    rg_density_destroy(map);
}

// Two places of one bucket turn differently, and the same way in every frame.
static void test_grid_places_turn_differently(void **state)
{
    (void)state;
    const float constant[1] = {0.3f};
    struct rg_density *map = rig_map(1, 1, constant);
    struct streaks_packets_settings settings = rig_settings(&rig_space, map, 100000);
    settings.scheme = STREAKS_GRID;
    struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
    assert_int_equal(streaks_packets_info(packets)->packets, 1);
    assert_int_equal(streaks_packets_info(packets)->grid_x, 10);
    struct streaks_view view = rig_everywhere(&rig_space, 20);
    struct streaks_selection s = {0}, later = {0};
    assert_true(streaks_select(packets, &view, &s));
    view.run = 0.75;
    assert_true(streaks_select(packets, &view, &later));
    double turns[100];
    for (int place = 0; place < 100; place++) {
        float now, then;
        const int64_t block = s.block_count / 100 * place;
        memcpy(&now, &s.blocks[block * STREAKS_BLOCK_WORDS + 4], 4);
        memcpy(&then, &later.blocks[block * STREAKS_BLOCK_WORDS + 4], 4);
        const double by = (double)then - (double)now;
        assert_below(fabs(by - floor(by) - 0.5), 1e-6);
        turns[place] = (double)now;
    }
    rig_expect_chance(oracle_evenness(turns, 100), "the turns of the grid's places");
    for (int i = 1; i < 100; i++)
        assert_above(turns[i], turns[i - 1]);
    streaks_selection_release(&s);
    streaks_selection_release(&later);
    streaks_packets_destroy(packets);
    rg_density_destroy(map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grid_agrees_with_trees),
        cmocka_unit_test(test_grid_has_the_forms_of_its_map),
        cmocka_unit_test(test_grid_is_exact_on_its_own_map),
        cmocka_unit_test(test_grid_places_turn_differently),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
