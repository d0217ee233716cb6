// The paper's test of hits: the visible samples of a drop's sphere, the decision, and bisection, in
// double precision.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "tests/core/techniques/cartoon/rain/rig.h"

static struct rg_device *device;

// --- samples ---

struct counted {
    int asked, sure, partly;
};

static void look_at_samples(const struct rig_change *s, void *user)
{
    struct counted *n = user;
    for (int i = 0; i < s->c->rain.drops; i++) {
        const int slot = (int)s->is.living[i];
        if (!rig_fell(s, slot))
            continue;
        const struct rainfall_vector at = rig_next_place(s->c, &s->was.drops[slot]);
        const struct rainfall_spot spot = rainfall_spot_of(&s->eye, at);
        const int found = (int)s->is.counts[i];
        if (spot.is_at_border)
            continue;
        struct rainfall_samples due = {0, 0};
        if (spot.is_inside)
            due = rainfall_count(&s->eye, at, rig_bound_m(s->c, spot.distance_m));
        if (found < due.least || found > due.most)
            fail_msg("drop %u at (%.3f, %.3f): %d samples, not %d to %d", s->was.drops[slot].number,
                     spot.x_px, spot.y_px, found, due.least, due.most);
        n->asked += spot.is_inside;
        n->sure += spot.is_inside && due.least == due.most;
        n->partly += spot.is_inside && due.least > 0 && due.most < 12;
    }
}

static void samples_are_those_of_a_sphere(void **state)
{
    (void)state;
    struct counted n = {0};
    rig_each_step(device, "scene=house2 drops_s=3000 collide=faithful", 128, 70, 74,
                  look_at_samples, &n);
    rig_each_step(device, "scene=house2 drops_s=1000 collide=any bound_m=0.3", 128, 70, 73,
                  look_at_samples, &n);
    if (n.asked < 1000 || n.sure < n.asked / 3 || n.partly < 20)
        fail_msg("%d drops asked, %d for certain, %d partly seen", n.asked, n.sure, n.partly);
}

// --- the paper's test ---

struct decided {
    int hits, misses, hidden, ends;
};

// The nearer end of the bisection's last interval.
static struct rainfall_vector before_hit(const struct rig_change *s, int slot)
{
    const cartoon_raindrop *was = &s->was.drops[slot];
    const struct rainfall_vector old = rig_place(was), now = rig_next_place(s->c, was);
    const struct rainfall_vector way = rainfall_sum(now, old, -1);
    double share = 1;
    while (share * rainfall_length(way) > s->c->settings.rain.precision_m)
        share /= 2;
    return rainfall_sum(rig_place(&s->is.drops[slot]), way, -share);
}

static void look_at_decisions(const struct rig_change *s, void *user)
{
    struct decided *n = user;
    const struct cartoon_rain_settings *rules = &s->c->settings.rain;
    const int least = rules->collide == CARTOON_COLLIDE_ANY ? 1 : rules->least_samples;
    for (int i = 0; i < s->is.drop_slots; i++) {
        if (!rig_fell(s, i))
            continue;
        const struct rainfall_vector now = rig_next_place(s->c, &s->was.drops[i]);
        const struct rainfall_spot spot = rainfall_spot_of(&s->eye, now);
        const bool has_hit = s->is.drops[i].state == CARTOON_COLLISION;
        if (spot.is_at_border)
            continue;
        const struct rainfall_samples seen =
            rainfall_count(&s->eye, now, rig_bound_m(s->c, spot.distance_m));
        if (has_hit && (!spot.is_inside || seen.least >= least))
            fail_msg("a drop of which %d to %d samples are seen has hit", seen.least, seen.most);
        if (!has_hit && spot.is_inside && seen.most < least)
            fail_msg("a drop of which %d to %d samples are seen has not hit", seen.least,
                     seen.most);
        n->misses += !has_hit;
        if (!has_hit)
            continue;
        n->hits++;
        rig_expect_on_way(s, i);
        const struct rainfall_vector end = rig_place(&s->is.drops[i]), before = before_hit(s, i);
        const struct rainfall_spot at_end = rainfall_spot_of(&s->eye, end),
                                   at_before = rainfall_spot_of(&s->eye, before);
        n->hidden += rainfall_behind(&s->eye, end).behind_m > 0.5;
        if (!at_end.is_at_border &&
            rainfall_count(&s->eye, end, rig_bound_m(s->c, at_end.distance_m)).least >= least)
            fail_msg("bisection ended where the drop has not hit");
        // At the step's beginning the test may have fired already.
        const struct rainfall_vector begin = rig_place(&s->was.drops[i]);
        if (at_before.is_at_border || !at_before.is_inside ||
            rainfall_length(rainfall_sum(before, begin, -1)) < 1e-4)
            continue;
        n->ends++;
        if (rainfall_count(&s->eye, before, rig_bound_m(s->c, at_before.distance_m)).most < least)
            fail_msg("bisection ended %.3g m behind the hit",
                     rainfall_length(rainfall_sum(end, before, -1)));
    }
}

static void a_drop_hits_where_few_samples_are_seen(void **state)
{
    (void)state;
    struct decided n = {0};
    rig_each_step(device, "scene=house2 drops_s=2000 collide=faithful", 128, 20, 80,
                  look_at_decisions, &n);
    rig_each_step(device, "scene=house2 drops_s=1000 collide=faithful least_samples=9", 128, 60, 90,
                  look_at_decisions, &n);
    rig_each_step(device, "scene=house2 drops_s=1000 collide=any", 128, 60, 90, look_at_decisions,
                  &n);
    if (n.hits < 500 || n.misses < 2000 || n.hidden < 50 || n.ends < 200)
        fail_msg("%d hits, %d misses, %d hidden, %d ends", n.hits, n.misses, n.hidden, n.ends);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_those_of_a_sphere),
        cmocka_unit_test(a_drop_hits_where_few_samples_are_seen),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
