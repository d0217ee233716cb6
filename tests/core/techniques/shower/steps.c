// Each particle's step against the oracle. A particle moves; it ends when it lands or leaves the
// body in view, or it enters again: shower steps DEVICE.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/core/techniques/shower/rig.h"
#include "tests/tools/expect.h"

enum { PARTICLES = 600, STEPS = 25 };

// Places are floats up to some 100 m from the origin. A particle nearer than this to a side may go
// either way.
static const double OFF_M = 3e-4, UNDECIDED_M = 2e-3;

// The fates of particles over all steps.
struct events {
    int stayed, left, landed, born, promoted, fell_in, crossed, turned, drawn_in, waited;
};

static double distance(const struct oracle_drop *a, const struct oracle_drop *b)
{
    return fmax(fmax(fabs(a->x - b->x), fabs(a->y - b->y)), fabs(a->z - b->z));
}

static bool is_at(const struct oracle_drop *a, const struct oracle_drop *b)
{
    return distance(a, b) <= OFF_M;
}

static void expect_fall(const struct oracle_drop *found, double due)
{
    pour_expect("speed", found->fall_m_s, due, 1e-5 * due);
}

// --- the traditional renewal ---

// A newborn particle is in the region and has the speed of its layer.
static void expect_born(const struct shower *s, const struct oracle_rain *r,
                        const struct oracle_drop *d)
{
    const struct oracle_sphere at = oracle_sphere_of(r, d);
    const double pi = acos(-1),
                 lowest = s->settings.birth == SHOWER_PAPER ? pi / 2 : (pi + r->beta) / 2;
    assert_at_least(at.r, r->near_m - OFF_M);
    assert_at_most(at.r, r->far_m + OFF_M);
    assert_at_least(at.phi, (pi - r->beta) / 2 - 1e-5);
    assert_at_most(at.phi, lowest + 1e-4);
    expect_fall(d, r->fall_m_s * oracle_share(r, d));
}

static void check_ended(const struct shower *s, const struct oracle_rain *r,
                        const struct oracle_drop *after, struct events *e)
{
    if (after->fall_m_s == 0) {
        assert_equals(after->x, 0);
        assert_equals(after->y, 0);
        assert_equals(after->z, 0);
        e->waited++;
        return;
    }
    expect_born(s, r, after);
    e->born++;
}

static void check_traditional(const struct shower *s, const struct oracle_rain *r,
                              const struct oracle_drop *before, const struct oracle_drop *after,
                              struct events *e)
{
    const struct oracle_drop due = oracle_moved(r, before);
    const double inside = oracle_inside(r, &due), above = due.y - r->ground_m;
    if (before->fall_m_s == 0) {
        check_ended(s, r, after, e);
        return;
    }
    if (fmin(fabs(inside), fabs(above)) < UNDECIDED_M)
        return;
    if (inside > 0 && above > 0) {
        if (!is_at(after, &due))
            fail_msg("a particle that moves to %g %g %g is at %g %g %g", due.x, due.y, due.z,
                     after->x, after->y, after->z);
        expect_fall(after, due.fall_m_s);
        e->stayed++;
        return;
    }
    e->left += inside <= 0;
    e->landed += above <= 0;
    assert_false(is_at(after, &due));
    check_ended(s, r, after, e);
}

// --- promotion ---

// The lower end of a column, as a share of half the view's height there.
static double lowest_of(const struct oracle_rain *r, double ahead)
{
    return fmax(-1, (r->ground_m - r->eye[1]) / (ahead * tan(r->beta / 2)));
}

// A particle that passes the front or the back enters at the other, at its place on the screen.
static bool wrap_deep(const struct oracle_rain *r, struct oracle_sight *s)
{
    const double span = r->far_m - r->near_m, was = s->ahead;
    if (s->ahead < r->near_m)
        s->ahead += span;
    else if (s->ahead > r->far_m)
        s->ahead -= span;
    return s->ahead != was;
}

// A particle that passes an end of its column enters as far inside the other end.
static bool wrap_high(const struct oracle_rain *r, struct oracle_sight *s)
{
    const double low = lowest_of(r, s->ahead), was = s->up;
    if (s->up < low)
        s->up = fmin(fmax(s->up + 1 - low, low), 1);
    else if (s->up > 1)
        s->up = fmin(fmax(s->up - (1 - low), low), 1);
    return s->up != was;
}

// A particle that has left by a side is at the opposite side, or anywhere across at its distance.
// Any other is in its place, or at a side if a wind from behind brings others in.
static bool is_across(const struct oracle_sight *due, const struct oracle_sight *found,
                      struct events *e)
{
    const double off = 1e-3, opposite = due->across - (due->across > 0 ? 2 : -2);
    if (fabs(due->across) <= 1) {
        const bool is_same = fabs(found->across - due->across) < off;
        e->drawn_in += !is_same;
        return is_same || fabs(fabs(found->across) - 1) < 2 * off;
    }
    const bool is_opposite = fabs(found->across - opposite) < off;
    e->crossed += is_opposite;
    e->turned += !is_opposite;
    return fabs(found->across) <= 1 + off;
}

static void check_promoted(const struct oracle_rain *r, const struct oracle_drop *before,
                           const struct oracle_drop *after, struct events *e)
{
    const struct oracle_drop moved = oracle_moved(r, before);
    struct oracle_sight due = oracle_sight_of(r, &moved), seen = oracle_sight_of(r, after);
    const double near_side = UNDECIDED_M / due.ahead;
    if (before->fall_m_s == 0 || after->fall_m_s == 0 || due.ahead < 0.2 * r->near_m) {
        e->waited++;
        return;
    }
    if (fabs(due.ahead - r->near_m) < UNDECIDED_M || fabs(due.ahead - r->far_m) < UNDECIDED_M ||
        fabs(fabs(due.across) - 1) < near_side)
        return;
    const bool is_deep = wrap_deep(r, &due);
    const double low = lowest_of(r, due.ahead);
    if (fabs(due.up - low) < near_side || fabs(due.up - 1) < near_side)
        return;
    const bool is_high = wrap_high(r, &due);
    if (!is_across(&due, &seen, e))
        fail_msg("a particle across %g is across %g", due.across, seen.across);
    pour_expect("ahead", seen.ahead, due.ahead, OFF_M);
    pour_expect("up", seen.up, due.up, 2e-4);
    expect_fall(after, is_deep || is_high ? r->fall_m_s * oracle_share(r, after) : moved.fall_m_s);
    e->stayed += !is_deep && !is_high;
    e->promoted += is_high;
    e->fell_in += is_deep;
}

// --- steps ---

// Particles anywhere in the body, at all kinds of speed.
static void throw_in(struct shower *s)
{
    struct oracle_drop drops[PARTICLES];
    pour_step(s, 1); // sets the frame's wind
    const struct oracle_rain r = pour_oracle(s);
    for (int i = 0; i < PARTICLES; i++) {
        const struct oracle_sight at = {r.near_m + (r.far_m - r.near_m) * fmod(i * 0.618033989, 1),
                                        2 * fmod(i * 0.754877666, 1) - 1,
                                        2 * fmod(i * 0.569840291, 1) - 1};
        drops[i] = oracle_drop_at(&r, &at);
        drops[i].y = fmax(drops[i].y, r.ground_m + 0.05);
        drops[i].fall_m_s = 2 + 20 * fmod(i * 0.414213562, 1);
    }
    pour_put(s, drops, PARTICLES);
}

static struct events run(const char *settings, bool is_promoted)
{
    char all[512];
    struct events e = {0};
    snprintf(all, sizeof(all), "particles=%d variation=0 drop_height_m=0.5 drop_width_m=0.1 %s",
             PARTICLES, settings);
    struct shower *s = pour_open(all, 64, 36);
    throw_in(s);
    struct oracle_drop *before = pour_read(s);
    for (int step = 0; step < STEPS; step++) {
        pour_step(s, 1);
        const struct oracle_rain r = pour_oracle(s);
        struct oracle_drop *after = pour_read(s);
        for (int i = 0; i < PARTICLES; i++)
            if (is_promoted)
                check_promoted(&r, &before[i], &after[i], &e);
            else
                check_traditional(s, &r, &before[i], &after[i], &e);
        free(before);
        before = after;
    }
    free(before);
    pour_close(s);
    print_message(
        "%s: stayed %d, left %d, landed %d, born %d, promoted %d, fell in %d, crossed %d, "
        "turned %d, drawn in %d, waited %d\n",
        settings, e.stayed, e.left, e.landed, e.born, e.promoted, e.fell_in, e.crossed, e.turned,
        e.drawn_in, e.waited);
    return e;
}

// Particles leave by each side of the body: the bottom, the sides in a wind, and the ends in a wind
// along the view. Near the ground they also land.
static void particles_of_the_traditional_system_end(void **state)
{
    (void)state;
    static const char *const settings[] = {
        "system=traditional wind_m_s=20",
        "system=traditional wind_m_s=30 wind_deg=110 heading_deg=40 birth=whole eye_y_m=100",
        "system=traditional wind_m_s=25 wind_deg=-80 crop=point state=compact eye_y_m=0.5",
        "system=traditional motion=uniform wind_m_s=15 wind_deg=200 gust=0.9 gust_s=0.3 layers=on",
        "system=improved renewal=birth walk_m_s=12 heading_deg=-130",
    };
    for (int i = 0; i < 5; i++) {
        const struct events e = run(settings[i], false);
        assert_above(e.stayed, 3000);
        assert_above(e.left, 50);
        assert_above(e.born, 50);
        assert_true(i == 1 ? e.landed == 0 : e.landed > 10);
    }
}

static void particles_of_the_improved_system_come_in_again(void **state)
{
    (void)state;
    static const char *const settings[] = {
        "wind_m_s=20 wind_deg=5",
        "wind_m_s=20 wind_deg=95 heading_deg=10 eye_y_m=100",
        "wind_m_s=20 wind_deg=-90 eye_y_m=0.5",
        "system=traditional renewal=promotion crop=point layers=on wind_m_s=20 wind_deg=140",
        "walk_m_s=15 heading_deg=170 gust=0.9 gust_s=0.3 wind_m_s=9",
    };
    int crossed = 0, turned = 0, drawn_in = 0, fell_in = 0;
    for (int i = 0; i < 5; i++) {
        const struct events e = run(settings[i], true);
        assert_above(e.stayed, 3000);
        assert_above(e.promoted, 50);
        crossed += e.crossed;
        turned += e.turned;
        drawn_in += e.drawn_in;
        fell_in += e.fell_in;
    }
    assert_above(crossed, 50);
    assert_above(turned, 50);
    assert_above(drawn_in, 50);
    assert_above(fell_in, 50);
}

// Attributes are stored beside the place: the present wind, gravity and age.
static void the_traditional_state_is_whole(void **state)
{
    (void)state;
    const char *settings = "system=traditional particles=400 variation=0 wind_m_s=7 wind_deg=30 "
                           "gust=0.5 gust_s=0.4 eye_y_m=50 drop_height_m=2 gravity_m_s2=3";
    struct shower *s = pour_open(settings, 64, 36);
    pour_step(s, 1);
    for (int step = 1; step < 6; step++) {
        float *was = pour_attributes(s, SHOWER_AGE);
        pour_step(s, 1);
        const struct oracle_rain r = pour_oracle(s);
        const double due[] = {r.wind_x, r.wind_z, 0, -3, 0};
        for (int plane = 0; plane < 5; plane++) {
            float *words = pour_attributes(s, plane);
            for (int i = 0; i < 400; i++)
                pour_expect("attribute", (double)words[i], due[plane], 1e-5);
            free(words);
        }
        float *age = pour_attributes(s, SHOWER_AGE);
        int older = 0;
        for (int i = 0; i < 400; i++) {
            assert_true(age[i] == was[i] + 1 || age[i] == 0);
            older += age[i] > 0;
        }
        assert_above(older, 200);
        free(age);
        free(was);
    }
    pour_close(s);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(particles_of_the_traditional_system_end),
        cmocka_unit_test(particles_of_the_improved_system_come_in_again),
        cmocka_unit_test(the_traditional_state_is_whole),
    };
    return pour_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
