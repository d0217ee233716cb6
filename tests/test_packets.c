// Rain in packets: where particles are, that all schemes hold them, and what is refused.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "tests/oracle/packets_oracle.h"
#include "tests/packets_rig.h"

// By chance, a sound generator is found out this often; seeds are fixed, so that a test that passes
// once always does.
#define CHANCE 1e-3

enum { UNEVEN_X = 7, UNEVEN_Y = 5 };

// Black places, steep steps, and no power of two.
static const float uneven[UNEVEN_X * UNEVEN_Y] = {
    0.1f, 0.5f, 0, 0,    1,    0.2f, 0.3f, 0.9f, 0.9f, 0, 0.4f,  0.7f, 0.1f, 0,    0, 0, 0,    0,
    0,    0,    0, 0.6f, 0.2f, 0.8f, 0.1f, 0.5f, 1,    1, 0.02f, 0.3f, 0.4f, 0.2f, 1, 0, 0.25f};

static const enum streaks_scheme schemes[] = {STREAKS_WORLD, STREAKS_KD, STREAKS_QUAD,
                                              STREAKS_GRID};

static struct rg_density *uneven_map(void)
{
    return rig_map(UNEVEN_X, UNEVEN_Y, uneven);
}

static void expect_chance(double p, const char *what)
{
    if (!(p > CHANCE))
        fail_msg("%s: by chance only in %g of all cases", what, p);
}

// --- where particles are ---

// Particles counted over across x down bins of the rain space, and the chi-square of the expected
// shares; a bin without rain must stay empty.
static double binned_chance(const struct rig_particles *all, const double *shares, int across,
                            int down)
{
    int64_t *counts = calloc((size_t)(across * down), sizeof(*counts));
    assert_non_null(counts);
    for (int64_t i = 0; i < all->count; i++) {
        const int column = (int)((all->all[i].x_m / rig_space.half_x_m + 1) / 2 * across);
        const int row = (int)((all->all[i].y_m / rig_space.half_y_m + 1) / 2 * down);
        assert_in_range(column, 0, across - 1);
        assert_in_range(row, 0, down - 1);
        counts[row * across + column]++;
    }
    double chi_square = 0;
    int degrees = -1;
    for (int i = 0; i < across * down; i++) {
        const double expected = shares[i] * (double)all->count;
        if (shares[i] <= 0)
            assert_int_equal(counts[i], 0);
        if (expected < 5)
            continue;
        chi_square += (counts[i] - expected) * (counts[i] - expected) / expected;
        degrees++;
    }
    free(counts);
    const double p = oracle_chi_square_tail(chi_square, degrees);
    return fmin(p, 2 * (1 - p)); // too good is no chance, either
}

static void test_counts_follow_the_map(void **state)
{
    (void)state;
    double shares[UNEVEN_X * UNEVEN_Y], sum = 0;
    for (int i = 0; i < UNEVEN_X * UNEVEN_Y; i++)
        sum += (double)uneven[i];
    for (int i = 0; i < UNEVEN_X * UNEVEN_Y; i++)
        shares[i] = (double)uneven[i] / sum;
    struct rg_density *map = uneven_map();
    static const double amounts[] = {200, 3000, 200000};
    for (int i = 0; i < 3; i++) {
        const struct streaks_packets_settings settings = rig_settings(&rig_space, map, amounts[i]);
        struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
        struct rig_particles all = rig_read_all(packets, &rig_space, 20);
        assert_int_equal(all.count, amounts[i]);
        expect_chance(binned_chance(&all, shares, UNEVEN_X, UNEVEN_Y), "an uneven map");
        free(all.all);
        streaks_packets_destroy(packets);
    }
    rg_density_destroy(map);
}

static void test_counts_follow_the_gradient(void **state)
{
    (void)state;
    enum { SIDE = 24 };
    double shares[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double x = 2.0 * (i % SIDE) / SIDE - 1, y = 2.0 * (i / SIDE) / SIDE - 1;
        shares[i] = oracle_gradient_mass(x, y, x + 2.0 / SIDE, y + 2.0 / SIDE) / (acos(-1) / 3);
    }
    struct rg_density *map = rg_density_gradient();
    const struct streaks_packets_settings settings = rig_settings(&rig_space, map, 300000);
    struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
    struct rig_particles all = rig_read_all(packets, &rig_space, 20);
    expect_chance(binned_chance(&all, shares, SIDE, SIDE), "the gradient");
    free(all.all);
    streaks_packets_destroy(packets);
    rg_density_destroy(map);
}

// Inside a texel of the map rain is even, in x, in y, and in height; and streaks differ evenly.
static void check_evenness(const struct rig_particles *all)
{
    double *numbers = malloc((size_t)all->count * sizeof(*numbers));
    assert_non_null(numbers);
    int64_t oscillations[10] = {0};
    for (int i = 0; i < 3; i++) {
        int64_t count = 0;
        for (int64_t k = 0; k < all->count; k++) {
            const struct rig_particle *p = &all->all[k];
            const double x = (p->x_m / rig_space.half_x_m + 1) / 2 * UNEVEN_X;
            const double y = (p->y_m / rig_space.half_y_m + 1) / 2 * UNEVEN_Y;
            if (i < 2 && !((int)x == 4 && (int)y == 0))
                continue;
            numbers[count++] = i == 0 ? x - floor(x) : i == 1 ? y - floor(y) : p->start;
        }
        assert_true(count > 1000);
        expect_chance(oracle_evenness(numbers, count), i == 2 ? "heights" : "places in a texel");
    }
    double chi_square = 0;
    for (int64_t k = 0; k < all->count; k++)
        oscillations[all->all[k].oscillation]++;
    for (int i = 0; i < 10; i++)
        chi_square +=
            pow((double)oscillations[i] - (double)all->count / 10, 2) / ((double)all->count / 10);
    expect_chance(oracle_chi_square_tail(chi_square, 9), "oscillations");
    free(numbers);
}

static void test_particles_are_even(void **state)
{
    (void)state;
    struct rg_density *map = uneven_map();
    const struct streaks_packets_settings settings = rig_settings(&rig_space, map, 100000);
    struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
    struct rig_particles all = rig_read_all(packets, &rig_space, 20);
    for (int64_t i = 0; i < all.count; i++)
        assert_in_range(all.all[i].oscillation, 0, 9);
    check_evenness(&all);
    free(all.all);
    streaks_packets_destroy(packets);
    rg_density_destroy(map);
}

// The table's number (Creus, table 5.3), and what heights make of it.
static void test_default_amount(void **state)
{
    (void)state;
    struct rg_density *map = rg_density_gradient();
    struct streaks_packets_settings settings = {
        .drops_m2_s = STREAKS_DEFAULT_DROPS_M2_S, .fall_speed_m_s = 8.16, .local_height_m = 20};
    assert_int_equal(streaks_packets_total(&rig_space, map, &settings), 54978100);
    settings.local_height_m = 40;
    assert_in_range(streaks_packets_total(&rig_space, map, &settings), 109956199, 109956201);
    settings.drops_m2_s = -1;
    assert_int_equal(streaks_packets_total(&rig_space, map, &settings), 0);
    rg_density_destroy(map);
}

// --- schemes hold the same particles ---

// All particles by id, as bytes.
static float *by_id(const struct rg_density *map, struct streaks_packets_settings settings,
                    enum streaks_scheme scheme, int size, int64_t *bytes)
{
    settings.scheme = scheme;
    settings.packet_size = size;
    settings.by_id = true;
    struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
    assert_int_equal(streaks_packets_buffers(packets), 1);
    const float *from = streaks_packets_buffer(packets, 0, bytes);
    float *copy = malloc((size_t)*bytes);
    assert_non_null(copy);
    memcpy(copy, from, (size_t)*bytes);
    streaks_packets_destroy(packets);
    return copy;
}

static void test_ids_are_the_same(void **state)
{
    (void)state;
    struct rg_density *map = uneven_map();
    const struct streaks_packets_settings settings = rig_settings(&rig_space, map, 20000);
    int64_t bytes, other_bytes;
    float *world = by_id(map, settings, STREAKS_WORLD, 1000, &bytes);
    static const int sizes[] = {1, 33, 1000, 50000};
    for (int scheme = STREAKS_KD; scheme <= STREAKS_QUAD; scheme++)
        for (int i = 0; i < 4; i++) {
            float *other =
                by_id(map, settings, (enum streaks_scheme)scheme, sizes[i], &other_bytes);
            assert_int_equal(bytes, other_bytes);
            assert_memory_equal(world, other, (size_t)bytes);
            free(other);
        }
    free(world);
    rg_density_destroy(map);
}

static int compare_values(const void *a, const void *b)
{
    return memcmp(a, b, 3 * sizeof(float));
}

// x, y and packed value of all particles, sorted.
static float *sorted_particles(const struct streaks_packets *packets, int64_t *count)
{
    const struct rig_particles all = rig_read_all(packets, &rig_space, 20);
    float *values = malloc((size_t)all.count * 3 * sizeof(*values));
    assert_non_null(values);
    for (int64_t i = 0; i < all.count; i++) {
        int64_t bytes;
        memcpy(values + 3 * i, streaks_packets_buffer(packets, 0, &bytes) + 3 * all.all[i].slot,
               3 * sizeof(*values));
    }
    qsort(values, (size_t)all.count, 3 * sizeof(*values), compare_values);
    *count = all.count;
    free(all.all);
    return values;
}

static void test_packets_hold_the_same_particles(void **state)
{
    (void)state;
    struct rg_density *map = uneven_map();
    struct streaks_packets_settings settings = rig_settings(&rig_space, map, 20000);
    settings.packet_size = 77;
    float *values[3];
    int64_t counts[3];
    for (int i = 0; i < 3; i++) {
        settings.scheme = schemes[i];
        struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
        values[i] = sorted_particles(packets, &counts[i]);
        streaks_packets_destroy(packets);
        assert_int_equal(counts[i], counts[0]);
        assert_memory_equal(values[i], values[0], (size_t)counts[0] * 3 * sizeof(float));
    }
    for (int i = 0; i < 3; i++)
        free(values[i]);
    rg_density_destroy(map);
}

// Each particle lies in exactly one packet, which is no larger than asked for, and inside that
// packet's place.
static void check_packets(const struct streaks_packets *packets, int size)
{
    const struct streaks_packets_info *info = streaks_packets_info(packets);
    struct rig_particles all = rig_read_all(packets, &rig_space, 20);
    qsort(all.all, (size_t)all.count, sizeof(*all.all), rig_compare);
    for (int64_t i = 1; i < all.count; i++)
        assert_true(rig_compare(&all.all[i - 1], &all.all[i]) < 0);
    int64_t sum = 0;
    for (int place = 0; place < info->places; place++) {
        const int64_t count = streaks_packets_count(packets, place);
        assert_true(count <= size);
        sum += count;
        double r[4];
        streaks_packets_rectangle(packets, place, r);
        assert_true(r[0] < r[2] && r[1] < r[3] && r[0] >= -200 && r[1] >= -200 && r[2] <= 200.001 &&
                    r[3] <= 200.001);
    }
    assert_int_equal(sum, info->total_particles);
    free(all.all);
}

// Of views of one packet's place only, that packet's particles lie inside it.
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
            assert_true(one.all[i].x_m >= r[0] - 1e-4 && one.all[i].x_m <= r[2] + 1e-4);
            assert_true(one.all[i].y_m >= r[1] - 1e-4 && one.all[i].y_m <= r[3] + 1e-4);
        }
        free(one.all);
    }
    streaks_selection_release(&selection);
}

static void test_packets_are_sound(void **state)
{
    (void)state;
    struct rg_density *map = uneven_map();
    static const int sizes[] = {1, 10, 32, 100, 5000};
    for (int s = 1; s < 4; s++)
        for (int i = 0; i < 5; i++) {
            struct streaks_packets_settings settings = rig_settings(&rig_space, map, 20000);
            settings.scheme = schemes[s];
            settings.packet_size = sizes[i];
            struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
            assert_int_equal(streaks_packets_info(packets)->scheme, schemes[s]);
            check_packets(packets, sizes[i]);
            check_places(packets, schemes[s]);
            streaks_packets_destroy(packets);
        }
    rg_density_destroy(map);
}

// Halving until no part exceeds the size leaves parts of n / 2^k, rounded either way.
static void test_kd_halves_are_alike(void **state)
{
    (void)state;
    struct rg_density *map = uneven_map();
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
        assert_true(most <= sizes[i] && (most - least <= 1 || 2 * least >= most));
        assert_true(2 * least >= sizes[i] || least == most || sizes[i] == 1);
        streaks_packets_destroy(packets);
    }
    rg_density_destroy(map);
}

// A map with rain on one texel of many: packets stay small where particles crowd, down to the same
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
        settings.scheme = schemes[i];
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

// --- the same for any number of threads ---

static void test_threads_change_nothing(void **state)
{
    (void)state;
    struct rg_density *map = uneven_map();
    const int before = omp_get_max_threads();
    for (int s = 0; s < 4; s++) {
        float *first = NULL;
        int64_t first_bytes = 0;
        for (int threads = 1; threads <= 5; threads += 2) {
            omp_set_num_threads(threads);
            struct streaks_packets_settings settings = rig_settings(&rig_space, map, 600000);
            settings.scheme = schemes[s];
            settings.packet_size = 20000;
            struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
            int64_t bytes;
            const float *particles = streaks_packets_buffer(packets, 0, &bytes);
            if (!first) {
                first = malloc((size_t)bytes);
                assert_non_null(first);
                memcpy(first, particles, (size_t)bytes);
                first_bytes = bytes;
            }
            assert_int_equal(bytes, first_bytes);
            assert_memory_equal(particles, first, (size_t)bytes);
            streaks_packets_destroy(packets);
        }
        free(first);
    }
    omp_set_num_threads(before);
    rg_density_destroy(map);
}

static void test_seeds_differ(void **state)
{
    (void)state;
    struct rg_density *map = uneven_map();
    struct streaks_packets_settings settings = rig_settings(&rig_space, map, 1000);
    int64_t bytes;
    float *a = by_id(map, settings, STREAKS_WORLD, 1000, &bytes);
    settings.seed++;
    float *b = by_id(map, settings, STREAKS_WORLD, 1000, &bytes);
    int64_t same = 0;
    for (int64_t i = 0; i < bytes / 4; i++)
        same += a[i] == b[i];
    assert_true(same < 100); // zeros of the padding
    free(a);
    free(b);
    rg_density_destroy(map);
}

// --- the grid ---

// Particles in the squares of a board, under two schemes that only chance tells apart. A grid
// scatters no more than single particles do, so that its chi-square may be small, but not large.
static void test_grid_agrees_with_trees(void **state)
{
    (void)state;
    enum { SIDE = 20 };
    struct rg_density *map = rg_density_gradient();
    static const int sizes[] = {100, 1000, 20000};
    for (int size = 0; size < 3; size++) {
        int64_t counts[2][SIDE * SIDE] = {{0}}, totals[2];
        double step = 0;
        const int side = size == 2 ? 8 : SIDE; // the grid's own, where its cells are large
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
            // densities come in 255 steps, and are rounded up or down at random
            step = settings.drops_m2_s / 8 * 20 * 400 * 400 / (double)info->places / 255;
            if (i && size == 2)
                assert_int_equal(info->grid_x, side);
            // Buckets repeat, but each place turns them by its own; so 1 in 1000 is not met, but
            // heights are even to a percent.
            oracle_evenness(falls, all.count);
            for (int64_t k = 0; k < all.count; k += 1000)
                assert_true(fabs(falls[k] - (double)k / (double)all.count) < 0.01);
            free(falls);
            free(all.all);
            streaks_packets_destroy(packets);
        }
        const double z = (double)(totals[1] - totals[0]) / sqrt((double)totals[0]);
        assert_true(fabs(z) < 3.3);
        double chi_square = 0;
        int degrees = 0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            const double sum = (double)(counts[0][i] + counts[1][i]);
            const double apart = (double)(counts[0][i] - counts[1][i]);
            chi_square += sum >= 20 ? apart * apart / (sum + step * step / 4) : 0;
            degrees += sum >= 20;
        }
        assert_true(degrees >= side * side / 2);
        expect_chance(oracle_chi_square_tail(chi_square, degrees), "a grid against a kd-tree");
    }
    rg_density_destroy(map);
}

// A map of as many texels as the grid has cells keeps its densities exactly.
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

// Two places of one bucket are turned differently, and the same in every frame.
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
        assert_true(fabs(by - floor(by) - 0.5) < 1e-6);
        turns[place] = (double)now;
    }
    expect_chance(oracle_evenness(turns, 100), "the turns of the grid's places");
    for (int i = 1; i < 100; i++)
        assert_true(turns[i] > turns[i - 1]);
    streaks_selection_release(&s);
    streaks_selection_release(&later);
    streaks_packets_destroy(packets);
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
    // Rain of which most falls in one quarter, and nowhere as much as anywhere else: 7 quarters of
    // a quad-tree, 8 halves, or a grid of 16 different cells.
    static const float quarter[16] = {1,     0.98f, 0.26f, 0.25f, 0.96f, 0.94f, 0.24f, 0.23f,
                                      0.27f, 0.22f, 0.28f, 0.21f, 0.2f,  0.29f, 0.3f,  0.19f};
    struct rg_density *maps[3] = {uneven_map(), rg_density_gradient(), rig_map(4, 4, quarter)};
    int seen[5] = {0};
    for (int m = 0; m < 3; m++)
        for (int size = m < 2 ? 100 : 7700; size <= 200000; size = size * 4 + 7) {
            struct streaks_packets_settings settings = rig_settings(&rig_space, maps[m], 50000);
            settings.packet_size = size;
            int64_t fewest = INT64_MAX;
            enum streaks_scheme chosen;
            for (int i = 1; i < 4; i++) {
                const int64_t count = packets_of(maps[m], settings, schemes[i], &chosen);
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
    struct rg_density *map = uneven_map();
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
    for (int i = 0; i < 4; i++, count++) { // each scheme, without memory for it
        wrong[count].scheme = schemes[i];
        wrong[count].packet_size = 50000;
        wrong[count].memory_bytes = schemes[i] == STREAKS_GRID ? 10000 : 12 * 50000 - 1;
    }
    for (int i = 0; i < count; i++) {
        rig_listen();
        assert_null(streaks_packets_create(&rig_space, map, &wrong[i]));
        assert_int_equal(rig_errors(), 1);
    }
    // one particle a packet where rain crowds: more cells than a grid may have
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

// What is told about memory before it is taken is no less than what is taken, and not far more.
static void test_memory_is_told(void **state)
{
    (void)state;
    struct rg_density *map = uneven_map();
    for (int i = 0; i < 4; i++) {
        struct streaks_packets_settings settings = rig_settings(&rig_space, map, 200000);
        settings.scheme = schemes[i];
        struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
        const struct streaks_packets_info info = *streaks_packets_info(packets);
        int64_t bytes, sum = 0;
        for (int k = 0; k < streaks_packets_buffers(packets); k++) {
            assert_non_null(streaks_packets_buffer(packets, k, &bytes));
            sum += bytes;
        }
        assert_int_equal(sum, info.particle_bytes);
        assert_true(info.stored_particles * 12 <= sum);
        assert_true(info.peak_bytes >= sum && info.peak_bytes <= 4 * sum);
        streaks_packets_destroy(packets);
        // exactly this much is enough, and a byte less is not
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
        cmocka_unit_test(test_counts_follow_the_map),
        cmocka_unit_test(test_counts_follow_the_gradient),
        cmocka_unit_test(test_particles_are_even),
        cmocka_unit_test(test_default_amount),
        cmocka_unit_test(test_ids_are_the_same),
        cmocka_unit_test(test_packets_hold_the_same_particles),
        cmocka_unit_test(test_packets_are_sound),
        cmocka_unit_test(test_kd_halves_are_alike),
        cmocka_unit_test(test_crowded),
        cmocka_unit_test(test_threads_change_nothing),
        cmocka_unit_test(test_seeds_differ),
        cmocka_unit_test(test_grid_agrees_with_trees),
        cmocka_unit_test(test_grid_is_exact_on_its_own_map),
        cmocka_unit_test(test_grid_places_turn_differently),
        cmocka_unit_test(test_auto_takes_the_fewest),
        cmocka_unit_test(test_wrong_settings),
        cmocka_unit_test(test_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
