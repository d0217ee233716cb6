// The particles of rain in packets: their places, which are the same in all trees, for any packet
// size and any number of threads.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/rigs/packets.h"
#include "tests/oracle/chance.h"
#include "tests/oracle/streaks/packets.h"
#include "tests/tools/expect.h"

// --- where particles are ---

// Counts particles over across x down bins of the rain space. Returns the chi-square probability
// for the expected shares; a bin without rain must stay empty.
static double binned_chance(const struct rig_particles *all, const double *shares, int across,
                            int down)
{
    int64_t *counts = calloc((size_t)(across * down), sizeof(*counts));
    assert_non_null(counts);
    for (int64_t i = 0; i < all->count; i++) {
        const int column = (int)((all->all[i].x_m / rig_space.half_x_m + 1) / 2 * across);
        const int row = (int)((all->all[i].y_m / rig_space.half_y_m + 1) / 2 * down);
        assert_between(column, 0, across - 1);
        assert_between(row, 0, down - 1);
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
    return fmin(p, 2 * (1 - p)); // a fit too good is not chance, either
}

static void test_counts_follow_the_map(void **state)
{
    (void)state;
    double shares[UNEVEN_X * UNEVEN_Y], sum = 0;
    for (int i = 0; i < UNEVEN_X * UNEVEN_Y; i++)
        sum += (double)rig_uneven[i];
    for (int i = 0; i < UNEVEN_X * UNEVEN_Y; i++)
        shares[i] = (double)rig_uneven[i] / sum;
    struct rg_density *map = rig_uneven_map();
    static const double amounts[] = {200, 3000, 200000};
    for (int i = 0; i < 3; i++) {
        const struct streaks_packets_settings settings = rig_settings(&rig_space, map, amounts[i]);
        struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
        struct rig_particles all = rig_read_all(packets, &rig_space, 20);
        assert_int_equal(all.count, amounts[i]);
        rig_expect_chance(binned_chance(&all, shares, UNEVEN_X, UNEVEN_Y), "an uneven map");
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
    rig_expect_chance(binned_chance(&all, shares, SIDE, SIDE), "the gradient");
    free(all.all);
    streaks_packets_destroy(packets);
    rg_density_destroy(map);
}

// The nearest particle is as often along one diagonal as along the other.
static void check_neighbours(const double *x, const double *y, int count)
{
    int rising = 0;
    for (int i = 0; i < count; i++) {
        double least = INFINITY, product = 0;
        for (int k = 0; k < count; k++) {
            const double dx = x[k] - x[i], dy = y[k] - y[i], away = dx * dx + dy * dy;
            if (k == i || away >= least)
                continue;
            least = away;
            product = dx * dy;
        }
        rising += product > 0;
    }
    assert_below(fabs(rising - count / 2.0), 3 * sqrt(count)); // most neighbours are mutual
}

// In a texel of the map a drop's place, height and oscillation are independent of each other.
static void check_independence(const struct rig_particles *all)
{
    double *of[4];
    int count = 0;
    for (int k = 0; k < 4; k++) {
        of[k] = malloc((size_t)all->count * sizeof(**of));
        assert_non_null(of[k]);
    }
    for (int64_t i = 0; i < all->count; i++) {
        const struct rig_particle *p = &all->all[i];
        const double x = (p->x_m / rig_space.half_x_m + 1) / 2 * UNEVEN_X;
        const double y = (p->y_m / rig_space.half_y_m + 1) / 2 * UNEVEN_Y;
        if ((int)x != 4 || (int)y != 0)
            continue;
        of[0][count] = x;
        of[1][count] = y;
        of[2][count] = p->start;
        // Equal oscillations in an order of no meaning, and not in that of memory.
        of[3][count] = p->oscillation + fmod(0.6180339887 * count, 1) / 2;
        count++;
    }
    assert_at_least(count, 1000);
    assert_below(oracle_dependence((const double *const *)of, 4, count), 5);
    check_neighbours(of[0], of[1], count);
    for (int k = 0; k < 4; k++)
        free(of[k]);
}

// In a texel of the map rain is uniform in x, y and height, and oscillations are equally frequent.
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
        assert_above(count, 1000);
        rig_expect_chance(oracle_evenness(numbers, count),
                          i == 2 ? "heights" : "places in a texel");
    }
    double chi_square = 0;
    for (int64_t k = 0; k < all->count; k++)
        oscillations[all->all[k].oscillation]++;
    for (int i = 0; i < 10; i++)
        chi_square +=
            pow((double)oscillations[i] - (double)all->count / 10, 2) / ((double)all->count / 10);
    rig_expect_chance(oracle_chi_square_tail(chi_square, 9), "oscillations");
    free(numbers);
    check_independence(all);
}

static void test_particles_are_even(void **state)
{
    (void)state;
    struct rg_density *map = rig_uneven_map();
    const struct streaks_packets_settings settings = rig_settings(&rig_space, map, 100000);
    struct streaks_packets *packets = rig_packets(&rig_space, map, &settings);
    struct rig_particles all = rig_read_all(packets, &rig_space, 20);
    for (int64_t i = 0; i < all.count; i++)
        assert_between(all.all[i].oscillation, 0, 9);
    check_evenness(&all);
    free(all.all);
    streaks_packets_destroy(packets);
    rg_density_destroy(map);
}

// The table's number (Creus, table 5.3), and its change with the height.
static void test_default_amount(void **state)
{
    (void)state;
    struct rg_density *map = rg_density_gradient();
    struct streaks_packets_settings settings = {
        .drops_m2_s = STREAKS_DEFAULT_DROPS_M2_S, .fall_speed_m_s = 8.16, .local_height_m = 20};
    assert_int_equal(streaks_packets_total(&rig_space, map, &settings), 54978100);
    settings.local_height_m = 40;
    assert_between(streaks_packets_total(&rig_space, map, &settings), 109956199, 109956201);
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
    struct rg_density *map = rig_uneven_map();
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

// The sorted x, y and packed values of all particles.
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
    struct rg_density *map = rig_uneven_map();
    struct streaks_packets_settings settings = rig_settings(&rig_space, map, 20000);
    settings.packet_size = 77;
    float *values[3];
    int64_t counts[3];
    for (int i = 0; i < 3; i++) {
        settings.scheme = rig_schemes[i];
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

// --- the same for any number of threads ---

static void test_threads_change_nothing(void **state)
{
    (void)state;
    struct rg_density *map = rig_uneven_map();
    const int before = omp_get_max_threads();
    for (int s = 0; s < 4; s++) {
        float *first = NULL;
        int64_t first_bytes = 0;
        for (int threads = 1; threads <= 5; threads += 2) {
            omp_set_num_threads(threads);
            struct streaks_packets_settings settings = rig_settings(&rig_space, map, 600000);
            settings.scheme = rig_schemes[s];
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
    struct rg_density *map = rig_uneven_map();
    struct streaks_packets_settings settings = rig_settings(&rig_space, map, 1000);
    int64_t bytes;
    float *a = by_id(map, settings, STREAKS_WORLD, 1000, &bytes);
    settings.seed++;
    float *b = by_id(map, settings, STREAKS_WORLD, 1000, &bytes);
    int64_t same = 0;
    for (int64_t i = 0; i < bytes / 4; i++)
        same += a[i] == b[i];
    assert_below(same, 100); // zeroes of the padding
    free(a);
    free(b);
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
        cmocka_unit_test(test_threads_change_nothing),
        cmocka_unit_test(test_seeds_differ),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
