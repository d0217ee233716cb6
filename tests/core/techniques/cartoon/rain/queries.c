// One query for each drop: samples of rasterised spheres, the API's own occlusion queries, and
// answers that are read a frame late.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "tests/core/techniques/cartoon/rain/rig.h"
#include "tests/oracle/raster.h"
#include "tests/tools/instance.h"

static struct rg_device *device;

// --- rasterised spheres ---

// A corner of an upright sphere of 6 by 4 quads.
static struct rainfall_vector corner_of(struct rainfall_vector middle, double radius, int ring,
                                        int slice)
{
    const double pi = acos(-1), rise = pi * ring / 4 - pi / 2, turn = 2 * pi * slice / 6;
    return (struct rainfall_vector){middle.x + radius * cos(rise) * sin(turn),
                                    middle.y + radius * sin(rise),
                                    middle.z + radius * cos(rise) * cos(turn)};
}

// The share of a ray up to the near side of the sphere's mesh; 0: the ray misses it.
static double near_side(struct rainfall_vector from, struct rainfall_vector to,
                        struct rainfall_vector middle, double radius)
{
    double nearest = INFINITY;
    for (int f = 0; f < 24; f++) {
        const int ring = f / 6, slice = f % 6;
        const struct rainfall_vector a = corner_of(middle, radius, ring, slice),
                                     b = corner_of(middle, radius, ring, slice + 1),
                                     d = corner_of(middle, radius, ring + 1, slice + 1),
                                     e = corner_of(middle, radius, ring + 1, slice);
        const double one = rainfall_meets(from, to, (struct rainfall_vector[]){a, b, d});
        const double two = rainfall_meets(from, to, (struct rainfall_vector[]){a, d, e});
        nearest = one >= 0 ? fmin(nearest, one) : nearest;
        nearest = two >= 0 ? fmin(nearest, two) : nearest;
    }
    return isinf(nearest) ? 0 : nearest;
}

static int facet_samples(const struct rainfall_eye *eye, struct rainfall_vector at, double radius)
{
    const struct rainfall_spot s = rainfall_spot_of(eye, at);
    const int reach = (int)(radius * eye->focal_px / s.distance_m) + 2;
    const double far_m = 2 * s.distance_m;
    int count = 0;
    for (int y = (int)s.y_px - reach; y <= (int)s.y_px + reach; y++)
        for (int x = (int)s.x_px - reach; x <= (int)s.x_px + reach; x++) {
            if (x < 0 || y < 0 || x >= eye->width || y >= eye->height)
                continue;
            struct rainfall_vector to = rainfall_sum(eye->at, eye->ahead, far_m);
            to = rainfall_sum(to, eye->right, (x + 0.5 - eye->width / 2.0) / eye->focal_px * far_m);
            to = rainfall_sum(to, eye->up, (eye->height / 2.0 - y - 0.5) / eye->focal_px * far_m);
            const double along = near_side(eye->at, to, at, radius);
            count += along > 0 &&
                     rainfall_depth_of(eye, along * far_m) < (double)eye->depth[y * eye->width + x];
        }
    return count;
}

struct spheres {
    int asked;
    double off;
};

static void look_at_spheres(const struct rig_change *s, void *user)
{
    struct spheres *n = user;
    for (int i = 0; i < s->c->rain.drops; i++) {
        const int slot = (int)s->is.living[i];
        const struct rainfall_vector at = rig_next_place(s->c, &s->was.drops[slot]);
        const struct rainfall_spot spot = rainfall_spot_of(&s->eye, at);
        if (!rig_fell(s, slot) || spot.is_at_border || i % 3)
            continue;
        const int due =
            spot.is_inside ? facet_samples(&s->eye, at, rig_bound_m(s->c, spot.distance_m)) : 0;
        const double off = fabs((double)s->is.counts[i] - due);
        // Quads are drawn as if they were flat, and corners are snapped to 1/256 pixel.
        if (off > 3)
            fail_msg("a sphere at (%.3f, %.3f): %u samples, not %d", spot.x_px, spot.y_px,
                     s->is.counts[i], due);
        n->asked += spot.is_inside;
        n->off += off;
    }
}

static void rasterised_spheres_have_their_facets_samples(void **state)
{
    (void)state;
    struct spheres n = {0};
    rig_each_step(device, "scene=house2 drops_s=2000 collide=faithful query=spheres bound_m=0.08",
                  128, 70, 74, look_at_spheres, &n);
    if (n.asked < 50 || n.off > 0.15 * n.asked)
        fail_msg("%d spheres, %.3g samples off in the mean", n.asked, n.off / n.asked);
}

// --- a sphere in front of nothing, behind everything, and cut by a wall ---

// The samples of a sphere's outline from column `from_x` on. Corners are snapped to 1/256 pixel.
static struct rainfall_samples outline_samples(const struct rainfall_eye *eye,
                                               struct rainfall_vector middle, double radius,
                                               int from_x)
{
    struct oracle_place points[30], outline[60];
    for (int i = 0; i < 30; i++) {
        const struct rainfall_spot s =
            rainfall_spot_of(eye, corner_of(middle, radius, i / 6, i % 6));
        points[i] = (struct oracle_place){s.x_px, s.y_px};
    }
    const int corners = oracle_hull(points, 30, outline);
    struct rainfall_samples n = {0, 0};
    for (int y = 0; y < eye->height; y++)
        for (int x = from_x; x < eye->width; x++) {
            const double px =
                oracle_inside_px(outline, corners, (struct oracle_place){x + 0.5, y + 0.5});
            n.least += px > 0.01;
            n.most += px > -0.01;
        }
    return n;
}

enum { SIZE_PX = 96 };

// Hides all columns before `from_x` and shows the others.
static void put_wall(struct cartoon *c, int from_x)
{
    float depth[SIZE_PX * SIZE_PX];
    for (int i = 0; i < SIZE_PX * SIZE_PX; i++)
        depth[i] = i % SIZE_PX < from_x ? 0.0f : 1.0f;
    assert_true(rg_image_write(c->depth_map->image, 0, 0, depth));
}

// The count of the one drop at a place, with the columns before `from_x` hidden.
static int count_at(struct cartoon *c, struct rainfall_vector at, int from_x)
{
    const cartoon_raindrop drop = {
        .x = (float)at.x, .y = (float)at.y, .z = (float)at.z, .state = CARTOON_DROP};
    uint32_t count;
    assert_true(rg_buf_write(c->rain.raindrops->buf, 0, &drop, sizeof(drop)));
    put_wall(c, from_x);
    rig_step(c, 1);
    assert_int_equal(c->rain.drops, 1);
    assert_true(rg_buf_read(c->rain.counts->buf, 0, &count, sizeof(count)));
    return (int)count;
}

static void expect_counts(struct cartoon *c, const struct rainfall_eye *eye, double across_px,
                          double down_px)
{
    const double metres = 4, a_px = metres / eye->focal_px;
    struct rainfall_vector at = rainfall_sum(eye->at, eye->ahead, metres);
    at = rainfall_sum(at, eye->right, across_px * a_px);
    at = rainfall_sum(at, eye->up, -down_px * a_px);
    const int walls[] = {0, SIZE_PX / 2, SIZE_PX};
    for (int i = 0; i < 3; i++) {
        const struct rainfall_samples due =
            outline_samples(eye, at, rig_bound_m(c, metres), walls[i]);
        const int found = count_at(c, at, walls[i]);
        if (found < due.least || found > due.most || due.most - due.least > 12)
            fail_msg("a sphere at (%g, %g) px, seen from column %d on: %d samples, not %d to %d",
                     across_px, down_px, walls[i], found, due.least, due.most);
        if (i == 0 && due.least < 100)
            fail_msg("a sphere of %d samples proves little", due.least);
        if (i == 1 && across_px == 0)
            rig_expect("half of a sphere", found,
                       outline_samples(eye, at, rig_bound_m(c, metres), 0).least / 2.0, 12);
        if (i == 2)
            assert_int_equal(found, 0);
    }
}

static bool has_queries(void)
{
    return device->info.limits.has_queries;
}

// The drop does not fall, and none is released. The camera stands still, so that the scene is not
// drawn over the walls.
static void counts_are_those_of_an_outline(void **state)
{
    static const char *const ways[] = {"query=spheres", "query=spheres bound_m=0.3", "query=api",
                                       "query=api bound_m=0.3"};
    (void)state;
    for (int i = 0; i < (has_queries() ? 4 : 2); i++) {
        char settings[160];
        snprintf(settings, sizeof(settings),
                 "scene=house2 drops_s=0 gravity_m_s2=0 drag_m_s2=0 collide=faithful bound_m=9 %s",
                 ways[i]);
        struct cartoon *c = rig_open(device, settings, SIZE_PX, SIZE_PX);
        rig_step(c, 1);
        const struct rainfall_eye eye = rig_eye(c);
        expect_counts(c, &eye, 0, 0);
        expect_counts(c, &eye, 0.37, -0.21);
        expect_counts(c, &eye, -20.1, 17.6);
        free((void *)eye.depth);
        rig_close(c);
    }
}

// --- the API's queries ---

static void expect_equal(struct cartoon *api, struct cartoon *spheres, const char *name,
                         size_t words)
{
    uint32_t *found = rig_words(api, name), *due = rig_words(spheres, name);
    for (size_t i = 0; i < words; i++)
        if (found[i] != due[i])
            fail_msg("step %d: %s[%zu] is %u with the API's queries, %u with spheres of ours",
                     (int)api->base.frame, name, i, found[i], due[i]);
    free(found);
    free(due);
}

// How many counts are of no sample, of some and of all.
static void tell_counts(struct cartoon *c, int kinds[3])
{
    uint32_t *counts = rig_words(c, "counts");
    for (int i = 0; i < c->rain.drops; i++)
        kinds[counts[i] == 0 ? 0 : counts[i] < 12 ? 1 : 2]++;
    free(counts);
}

static void expect_same_rain(const char *settings)
{
    char text[160];
    int kinds[3] = {0};
    snprintf(text, sizeof(text), "%s query=api", settings);
    struct cartoon *api = rig_open(device, text, 128, 128);
    snprintf(text, sizeof(text), "%s query=spheres", settings);
    struct cartoon *spheres = rig_open(device, text, 128, 128);
    for (int i = 0; i < 20; i++) {
        rig_step(api, 4);
        rig_step(spheres, 4);
        assert_int_equal(api->rain.drops, spheres->rain.drops);
        expect_equal(api, spheres, "counts", (size_t)api->rain.drops);
        expect_equal(api, spheres, "raindrops", api->rain.raindrops->buf->size / 4);
        expect_equal(api, spheres, "sprays", api->rain.sprays->buf->size / 4);
        expect_equal(api, spheres, "tally", CARTOON_TALLY);
        tell_counts(api, kinds);
    }
    if (kinds[0] < 100 || kinds[1] < 100 || kinds[2] < 100 || rig_tally(api, CARTOON_HITS) < 100)
        fail_msg("%d counts of none, %d of some, %d of many; %u hits", kinds[0], kinds[1], kinds[2],
                 rig_tally(api, CARTOON_HITS));
    rig_close(api);
    rig_close(spheres);
}

static void expect_refused(void)
{
    void *settings = settings_of("cartoon", "", "collide=faithful query=api");
    assert_null(rg_instance_open(rg_technique_find("cartoon"), device, settings, 32, 32));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_NONE);
    assert_non_null(strstr(rg_last_error(), device->info.name));
    assert_non_null(strstr(rg_last_error(), "no occlusion queries of its own; set query=spheres"));
    free(settings);
}

static void the_apis_queries_count_what_spheres_do(void **state)
{
    (void)state;
    if (!has_queries()) {
        expect_refused();
        return;
    }
    expect_same_rain("scene=house2 drops_s=3000 bound_m=0.12 collide=faithful answers=late");
    expect_same_rain("scene=house2 drops_s=3000 bound_m=0.12 collide=any answers=now spin_deg=3");
}

// --- late answers ---

struct late {
    int hits, misses, entered;
};

static void expect_hit(const struct rig_change *s, int slot)
{
    const cartoon_raindrop *was = &s->was.drops[slot], *is = &s->is.drops[slot];
    const struct rainfall_vector from = {(double)was->from_x, (double)was->from_y,
                                         (double)was->from_z};
    const struct rainfall_vector way = rainfall_sum(rig_place(was), from, -1);
    const struct rainfall_vector to = rainfall_sum(rig_place(is), from, -1);
    const double along = rainfall_dot(to, way) / rainfall_dot(way, way);
    assert_int_equal(is->state, CARTOON_STICKED);
    assert_int_equal(is->stuck, 1);
    rig_expect("distance of a hit from the way that was asked about",
               rainfall_length(rainfall_sum(to, way, -along)), 0, 1e-5);
    if (!(along > 0 && along < 1 + 1e-5))
        fail_msg("a hit at %.6g of the way that was asked about", along);
}

// A drop hits if the step before asked about it and counted few samples. Drops that have hit are
// not asked about.
static void look_at_answers(const struct rig_change *s, void *user)
{
    struct late *n = user;
    for (int i = 0; i < s->was.listed; i++) {
        const int slot = (int)s->was.living[i];
        const cartoon_raindrop *was = &s->was.drops[slot], *is = &s->is.drops[slot];
        const struct rainfall_spot before = rainfall_spot_of(&s->eye_was, rig_place(was)),
                                   now = rainfall_spot_of(&s->eye, rig_place(was));
        if (was->state != CARTOON_DROP)
            assert_int_equal(s->was.counts[i], 0);
        if (was->state != CARTOON_DROP || before.is_at_border || now.is_at_border)
            continue;
        const bool due = before.is_inside && now.is_inside && (int)s->was.counts[i] < 3;
        if (due)
            expect_hit(s, slot);
        else if (is->number == was->number && is->state != CARTOON_DROP &&
                 is->state != CARTOON_DEATH)
            fail_msg("a drop of which %u samples were seen has hit", s->was.counts[i]);
        n->hits += due;
        n->misses += !due;
        n->entered += now.is_inside && !before.is_inside;
    }
    for (int i = 0; i < s->is.listed; i++) {
        const cartoon_raindrop *is = &s->is.drops[s->is.living[i]];
        if (is->age == 1 && is->state != CARTOON_DROP)
            fail_msg("drop %u has hit before it was asked about", is->number);
    }
}

static void late_answers_are_those_to_the_step_before(void **state)
{
    (void)state;
    struct late n = {0};
    rig_each_step(device,
                  "scene=house2 drops_s=3000 top_m=2 collide=faithful query=spheres answers=late",
                  128, 0, 80, look_at_answers, &n);
    rig_each_step(device,
                  "scene=house2 drops_s=3000 collide=faithful answers=late spin_deg=8 zoom=3", 128,
                  40, 90, look_at_answers, &n);
    if (n.hits < 500 || n.misses < 2000 || n.entered < 50)
        fail_msg("%d hits, %d misses, %d drops that came into sight", n.hits, n.misses, n.entered);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rasterised_spheres_have_their_facets_samples),
        cmocka_unit_test(counts_are_those_of_an_outline),
        cmocka_unit_test(the_apis_queries_count_what_spheres_do),
        cmocka_unit_test(late_answers_are_those_to_the_step_before),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
