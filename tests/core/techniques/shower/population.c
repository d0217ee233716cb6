// The number of particles (eq. 1), the slots that they take, and their places of birth (eqs. 2 to
// 8), for thousands: shower population DEVICE.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/core/techniques/shower/rig.h"
#include "tests/oracle/chance.h"
#include "tests/tools/expect.h"

// --- eq. 1 ---

static int count_of(struct shower *s)
{
    struct oracle_drop *drops = pour_read(s);
    int count = 0;
    for (int i = 0; i < s->params.slots; i++)
        count += drops[i].fall_m_s > 0;
    free(drops);
    return count;
}

// All particles leave in each step. A step's births are then ExpectedNum plus the random term:
// uniform from ExpectedNum (1 - C0) to ExpectedNum (1 + C0).
static void births_vary_evenly(void **state)
{
    (void)state;
    enum { STEPS = 500, EXPECTED = 1000 };
    const double c0 = 0.4, deviation = c0 * EXPECTED / sqrt(3);
    struct shower *s = pour_open("system=traditional particles=1000 variation=0.4 fall_m_s=1000 "
                                 "step_s=1 drop_height_m=0.5",
                                 64, 36);
    double sum = 0, squares = 0, least = INFINITY, most = 0;
    for (int i = 0; i < STEPS; i++) {
        pour_step(s, 1);
        const double found = count_of(s);
        assert_int_equal(pour_tally(s, SHOWER_ALIVE), (uint32_t)found);
        sum += found;
        squares += pow(found - EXPECTED, 2);
        least = fmin(least, found);
        most = fmax(most, found);
    }
    assert_at_least(least, EXPECTED * (1 - c0));
    assert_at_most(most, EXPECTED * (1 + c0));
    assert_below(least, EXPECTED * (1 - 0.97 * c0));
    assert_above(most, EXPECTED * (1 + 0.97 * c0));
    pour_expect("mean", sum / STEPS, EXPECTED, 4 * deviation / sqrt(STEPS));
    // For a uniform distribution of half width w, squares have mean w^2 / 3 and deviation w^2
    // sqrt(4 / 45).
    const double wide = pow(c0 * EXPECTED, 2);
    pour_expect("variance", squares / STEPS, wide / 3, 4 * wide * sqrt(4.0 / 45 / STEPS));
    assert_int_equal(s->base.counters[SHOWER_COUNT_BORN].value, (int64_t)sum);
    assert_int_equal(s->base.counters[SHOWER_COUNT_DIED].value,
                     (int64_t)sum - pour_tally(s, SHOWER_ALIVE));
    pour_close(s);
}

// Without chance there are always as many as expected. With chance, surplus particles stay, and
// none is born.
static void births_fill_up(void **state)
{
    (void)state;
    struct shower *s =
        pour_open("system=traditional particles=500 variation=0 drop_height_m=0.5", 64, 36);
    for (int i = 0; i < 40; i++) {
        pour_step(s, 1);
        assert_int_equal(count_of(s), 500);
    }
    assert_above(s->base.counters[SHOWER_COUNT_DIED].value, 500);
    pour_close(s);
    s = pour_open("system=traditional particles=500 variation=1 fall_m_s=0.1 gravity_m_s2=0 "
                  "wind_m_s=0 eye_y_m=20 drop_height_m=0.5 birth=whole",
                  64, 36);
    int before = 0, resting = 0;
    for (int i = 0; i < 60; i++) {
        const int64_t died = s->base.counters[SHOWER_COUNT_DIED].value;
        pour_step(s, 1);
        const int now = count_of(s), lost = (int)(s->base.counters[SHOWER_COUNT_DIED].value - died);
        assert_at_least(now, before - lost);
        assert_below(now, 1000); // the largest possible number
        resting += now == before - lost;
        before = now;
    }
    assert_above(before, 800); // near the largest of sixty random numbers
    assert_above(resting, 30); // most random numbers are below the present count
    pour_close(s);
}

// One particle has one slot. The newborn take the first free slots in order, so that free slots
// come last.
static void slots_are_given_back(void **state)
{
    (void)state;
    struct shower *s = pour_open("system=traditional particles=3000 variation=0.3 "
                                 "drop_height_m=0.5 wind_m_s=4",
                                 64, 36);
    int given_back = 0;
    pour_step(s, 1);
    struct oracle_drop *before = pour_read(s);
    for (int step = 0; step < 30; step++) {
        const int64_t born = s->base.counters[SHOWER_COUNT_BORN].value;
        pour_step(s, 1);
        struct oracle_drop *after = pour_read(s);
        float *age = pour_attributes(s, SHOWER_AGE);
        int births = 0, last_born = -1, first_free = s->params.slots;
        for (int i = 0; i < s->params.slots; i++) {
            const bool is_born = after[i].fall_m_s > 0 && age[i] == 0;
            births += is_born;
            last_born = is_born ? i : last_born;
            given_back += is_born && before[i].fall_m_s > 0;
            if (after[i].fall_m_s > 0)
                continue;
            assert_equals(after[i].x, 0);
            assert_equals(after[i].y, 0);
            assert_equals(after[i].z, 0);
            first_free = i < first_free ? i : first_free;
        }
        assert_int_equal(births, s->base.counters[SHOWER_COUNT_BORN].value - born);
        assert_below(last_born, first_free);
        free(age);
        free(before);
        before = after;
    }
    assert_above(given_back, 500);
    free(before);
    pour_close(s);
}

// --- eqs. 2 to 8 ---

enum { BORN = 20000, BINS = 10 };

struct spread {
    int bins[BINS];
};

static void add(struct spread *spread, double share)
{
    const int bin = (int)floor(share * BINS);
    assert_between(bin + 1, 0, BINS + 1);
    spread->bins[bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin]++;
}

// Each tenth of the range holds a tenth, within 4.5 deviations.
static void expect_even(const char *what, const struct spread *spread)
{
    for (int i = 0; i < BINS; i++)
        pour_expect(what, spread->bins[i], BORN / BINS, 4.5 * sqrt(BORN * 0.1 * 0.9));
}

static double cube(double x)
{
    return x * x * x;
}

struct birth_case {
    const char *settings;
    double phi_high; // the range begins at pi / 2 - beta / 2; its width in shares of beta
    bool is_even;
};

static void expect_region(const struct birth_case *c)
{
    struct shower *s = pour_open(c->settings, 64, 36);
    pour_step(s, 1);
    const struct oracle_rain r = pour_oracle(s);
    const double pi = acos(-1), phi_low = (pi - r.beta) / 2;
    const double phi_high = phi_low + c->phi_high * r.beta,
                 theta_low = r.heading - pi - r.alpha / 2;
    struct oracle_drop *drops = pour_read(s);
    struct spread by_r = {0}, by_phi = {0}, by_theta = {0}, by_sum = {0}, by_difference = {0},
                  by_all = {0};
    static double of[3][BORN];
    for (int i = 0; i < BORN; i++) {
        const struct oracle_sphere at = oracle_sphere_of(&r, &drops[i]);
        const double u = c->is_even
                             ? (cube(at.r) - cube(r.near_m)) / (cube(r.far_m) - cube(r.near_m))
                             : (at.r - r.near_m) / (r.far_m - r.near_m);
        const double v = c->is_even ? (cos(phi_low) - cos(at.phi)) / (cos(phi_low) - cos(phi_high))
                                    : (at.phi - phi_low) / (phi_high - phi_low);
        const double w = remainder(at.theta - theta_low - r.alpha / 2, 2 * pi) / r.alpha + 0.5;
        assert_above(fmin(u, fmin(v, w)), -1e-4);
        assert_below(fmax(u, fmax(v, w)), 1 + 1e-4);
        add(&by_r, u);
        add(&by_phi, v);
        add(&by_theta, w);
        // Modulo 1, sums and differences of independent uniform numbers are uniform.
        add(&by_sum, fmod(u + v + 2, 1));
        add(&by_difference, fmod(u - v + 2, 1));
        add(&by_all, fmod(u - v + 2 * w + 2, 1));
        of[0][i] = u;
        of[1][i] = v;
        of[2][i] = w;
    }
    expect_even("distance", &by_r);
    expect_even("angle from upright", &by_phi);
    expect_even("angle about the upright", &by_theta);
    expect_even("distance and angle", &by_sum);
    expect_even("distance less angle", &by_difference);
    expect_even("distance and both angles", &by_all);
    const double *const columns[3] = {of[0], of[1], of[2]};
    assert_below(oracle_dependence(columns, 3, BORN), 5);
    free(drops);
    pour_close(s);
}

static void particles_are_born_in_the_region(void **state)
{
    (void)state;
#define MANY "system=traditional particles=20000 variation=0 eye_y_m=200 "
    static const struct birth_case cases[] = {
        {MANY "drop_height_m=0.5", 0.5, false},
        {MANY "drop_height_m=0.5 birth=whole heading_deg=130 view_angle_deg=40", 1, false},
        {MANY "drop_height_m=0.3 birth=volume heading_deg=-75 near_m=3 eye_x_m=30", 1, true},
    };
    for (int i = 0; i < 3; i++)
        expect_region(&cases[i]);
}

// Births differ in a later step and with another seed; the same seed repeats them.
static void births_go_by_the_seed(void **state)
{
    (void)state;
    static const char *const settings[] = {"particles=50 seed=3 eye_y_m=99 system=traditional",
                                           "particles=50 seed=4 eye_y_m=99 system=traditional"};
    struct shower *s[3];
    float *words[3];
    for (int i = 0; i < 3; i++) {
        s[i] = pour_open(settings[i / 2], 640, 360);
        pour_step(s[i], 1);
        words[i] = pour_words(s[i], "particles");
    }
    assert_memory_equal(words[0], words[1], 50 * 4);
    int same = 0;
    for (int i = 0; i < 50; i++)
        same += words[0][i] == words[2][i];
    assert_below(same, 3);
    pour_put(s[0], NULL, 0);
    pour_step(s[0], 1);
    float *later = pour_words(s[0], "particles");
    for (int i = 0, equal = 0; i < 50; i++)
        assert_below((equal += later[i] == words[0][i]), 3);
    free(later);
    for (int i = 0; i < 3; i++) {
        free(words[i]);
        pour_close(s[i]);
    }
}

// --- promotion ---

// All particles exist from the first step on, at random places. Particles placed out of view or
// below the ground wait.
static void promoted_particles_stay_as_many(void **state)
{
    (void)state;
    struct shower *s = pour_open("particles=5000 drop_height_m=0.5 birth=whole wind_m_s=0", 64, 36);
    pour_step(s, 1);
    const struct oracle_rain r = pour_oracle(s);
    struct oracle_drop *drops = pour_read(s);
    int placed = 0;
    for (int i = 0; i < 5000; i++) {
        if (drops[i].fall_m_s == 0)
            continue;
        placed++;
        assert_above(oracle_inside(&r, &drops[i]), -1e-3);
        assert_at_least(drops[i].y, 0);
    }
    free(drops);
    assert_int_equal(placed, pour_tally(s, SHOWER_PLACED));
    assert_int_equal(placed, pour_tally(s, SHOWER_ALIVE));
    assert_above(placed, 2500);
    assert_below(placed, 4900);
    const uint32_t raised = pour_tally(s, SHOWER_RAISED);
    pour_step(s, 30);
    assert_int_equal(count_of(s), 5000);
    assert_int_equal(pour_tally(s, SHOWER_ALIVE), 5000);
    assert_above(pour_tally(s, SHOWER_RAISED), raised + 1000);
    assert_int_equal(pour_tally(s, SHOWER_PASSED), 0);
    pour_close(s);
}

// Wind keeps the rain as uniform across the view as it was.
static void wind_keeps_the_rain_even(void **state)
{
    (void)state;
    enum { PARTS = 8, PARTICLES = 20000 };
    for (int degrees = -135; degrees <= 180; degrees += 45) {
        char all[256];
        snprintf(all, sizeof(all),
                 "particles=%d drop_height_m=0.5 eye_y_m=300 birth=whole heading_deg=0 wind_m_s=8 "
                 "wind_deg=%d",
                 PARTICLES, degrees);
        struct shower *s = pour_open(all, 64, 36);
        pour_step(s, 300);
        const struct oracle_rain r = pour_oracle(s);
        struct oracle_drop *drops = pour_read(s);
        int parts[PARTS] = {0}, count = 0;
        for (int i = 0; i < PARTICLES; i++) {
            const struct oracle_sight at = oracle_sight_of(&r, &drops[i]);
            if (drops[i].fall_m_s == 0 || at.ahead < 0.2 * r.far_m || at.ahead > 0.6 * r.far_m)
                continue;
            const int part = (int)floor((at.across + 1) / 2 * PARTS);
            parts[part < 0 ? 0 : part >= PARTS ? PARTS - 1 : part]++;
            count++;
        }
        free(drops);
        for (int i = 0; i < PARTS; i++)
            if (!(parts[i] > 0.75 * count / PARTS && parts[i] < 1.3 * count / PARTS))
                fail_msg("wind to %d degrees: part %d of %d has %d of %d", degrees, i, PARTS,
                         parts[i], count);
        pour_close(s);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(births_vary_evenly),
        cmocka_unit_test(births_fill_up),
        cmocka_unit_test(slots_are_given_back),
        cmocka_unit_test(particles_are_born_in_the_region),
        cmocka_unit_test(births_go_by_the_seed),
        cmocka_unit_test(promoted_particles_stay_as_many),
        cmocka_unit_test(wind_keeps_the_rain_even),
    };
    return pour_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
