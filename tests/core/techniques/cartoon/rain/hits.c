// When a drop has hit, where and what: the visible samples of its sphere, the decision, bisection,
// and rays against the mesh, in double precision.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/cartoon/rain/rig.h"

#define PRECISION_M 0.00101 // bisection's
#define ROUNDED_M   0.0001  // by the depth map

static struct rg_device *device;

static double bound_m(const struct cartoon *c, double distance_m)
{
    const double focal_px = (double)c->rain.params.focal_px;
    return fmin((double)c->rain.params.bound_m, 16 / focal_px * distance_m);
}

// Runs steps, and shows each to `look` with the rain before it.
struct step {
    struct cartoon *c;
    struct rig_rain was, is;
    struct rainfall_eye eye;
};

static void each_step(const char *settings, int size_px, int from, int to,
                      void (*look)(const struct step *s, void *user), void *user)
{
    struct cartoon *c = rig_open(device, settings, size_px, size_px);
    rig_step(c, from);
    for (int i = from; i < to; i++) {
        struct step s = {.c = c, .was = rig_look(c)};
        rig_step(c, 1);
        s.is = rig_look(c);
        s.eye = rig_eye(c);
        look(&s, user);
        rig_free(&s.was);
        rig_free(&s.is);
        free((void *)s.eye.depth);
    }
    rig_close(c);
}

// Whether a drop fell through the whole of a step, and may have hit in it.
static bool fell(const struct step *s, int slot)
{
    const cartoon_raindrop *was = &s->was.drops[slot], *is = &s->is.drops[slot];
    return was->state == CARTOON_DROP && is->number == was->number &&
           (is->state == CARTOON_DROP || is->state == CARTOON_COLLISION);
}

// --- samples ---

struct counted {
    int asked, sure, partly;
};

static void look_at_samples(const struct step *s, void *user)
{
    struct counted *n = user;
    for (int i = 0; i < s->c->rain.drops; i++) {
        const int slot = (int)s->is.living[i];
        if (!fell(s, slot))
            continue;
        const struct rainfall_vector at = rig_next_place(s->c, &s->was.drops[slot]);
        const struct rainfall_spot spot = rainfall_spot_of(&s->eye, at);
        const int found = (int)s->is.counts[i];
        if (spot.is_at_border)
            continue;
        struct rainfall_samples due = {0, 0};
        if (spot.is_inside)
            due = rainfall_count(&s->eye, at, bound_m(s->c, spot.distance_m));
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
    each_step("scene=house2 drops_s=3000 collide=faithful", 128, 70, 74, look_at_samples, &n);
    each_step("scene=house2 drops_s=1000 collide=any bound_m=0.3", 128, 70, 73, look_at_samples,
              &n);
    if (n.asked < 1000 || n.sure < n.asked / 3 || n.partly < 20)
        fail_msg("%d drops asked, %d for certain, %d partly seen", n.asked, n.sure, n.partly);
}

// --- the paper's test ---

struct decided {
    int hits, misses, hidden, ends;
};

// The lesser end of the last interval of the bisection.
static struct rainfall_vector before_hit(const struct step *s, int slot)
{
    const cartoon_raindrop *was = &s->was.drops[slot];
    const struct rainfall_vector old = rig_place(was), now = rig_next_place(s->c, was);
    const struct rainfall_vector way = rainfall_sum(now, old, -1);
    double share = 1;
    while (share * rainfall_length(way) > s->c->settings.rain.precision_m)
        share /= 2;
    return rainfall_sum(rig_place(&s->is.drops[slot]), way, -share);
}

static void expect_on_way(const struct step *s, int slot)
{
    const struct rainfall_vector old = rig_place(&s->was.drops[slot]);
    const struct rainfall_vector now = rig_next_place(s->c, &s->was.drops[slot]);
    const struct rainfall_vector way = rainfall_sum(now, old, -1);
    const struct rainfall_vector to = rainfall_sum(rig_place(&s->is.drops[slot]), old, -1);
    const double along = rainfall_dot(to, way) / rainfall_dot(way, way);
    rig_expect("distance of a hit from its way", rainfall_length(rainfall_sum(to, way, -along)), 0,
               1e-5);
    if (!(along > 0 && along < 1 + 1e-5))
        fail_msg("a hit at %.6g of its way", along);
}

static void look_at_decisions(const struct step *s, void *user)
{
    struct decided *n = user;
    const struct cartoon_rain_settings *rules = &s->c->settings.rain;
    const int least = rules->collide == CARTOON_COLLIDE_ANY ? 1 : rules->least_samples;
    for (int i = 0; i < s->is.drop_slots; i++) {
        if (!fell(s, i))
            continue;
        const struct rainfall_vector now = rig_next_place(s->c, &s->was.drops[i]);
        const struct rainfall_spot spot = rainfall_spot_of(&s->eye, now);
        const bool has_hit = s->is.drops[i].state == CARTOON_COLLISION;
        if (spot.is_at_border)
            continue;
        const struct rainfall_samples seen =
            rainfall_count(&s->eye, now, bound_m(s->c, spot.distance_m));
        if (has_hit && (!spot.is_inside || seen.least >= least))
            fail_msg("a drop of which %d to %d samples are seen has hit", seen.least, seen.most);
        if (!has_hit && spot.is_inside && seen.most < least)
            fail_msg("a drop of which %d to %d samples are seen has not hit", seen.least,
                     seen.most);
        n->misses += !has_hit;
        if (!has_hit)
            continue;
        n->hits++;
        expect_on_way(s, i);
        const struct rainfall_vector end = rig_place(&s->is.drops[i]), before = before_hit(s, i);
        const struct rainfall_spot at_end = rainfall_spot_of(&s->eye, end),
                                   at_before = rainfall_spot_of(&s->eye, before);
        n->hidden += rainfall_behind(&s->eye, end).behind_m > 0.5;
        if (!at_end.is_at_border &&
            rainfall_count(&s->eye, end, bound_m(s->c, at_end.distance_m)).least >= least)
            fail_msg("bisection ended where the drop has not hit");
        // Where the way began, the test may have fired already.
        const struct rainfall_vector begin = rig_place(&s->was.drops[i]);
        if (at_before.is_at_border || !at_before.is_inside ||
            rainfall_length(rainfall_sum(before, begin, -1)) < 1e-4)
            continue;
        n->ends++;
        if (rainfall_count(&s->eye, before, bound_m(s->c, at_before.distance_m)).most < least)
            fail_msg("bisection ended %.3g m behind the hit",
                     rainfall_length(rainfall_sum(end, before, -1)));
    }
}

static void a_drop_hits_where_few_samples_are_seen(void **state)
{
    (void)state;
    struct decided n = {0};
    each_step("scene=house2 drops_s=2000 collide=faithful", 128, 20, 80, look_at_decisions, &n);
    each_step("scene=house2 drops_s=1000 collide=faithful least_samples=9", 128, 60, 90,
              look_at_decisions, &n);
    each_step("scene=house2 drops_s=1000 collide=any", 128, 60, 90, look_at_decisions, &n);
    if (n.hits < 500 || n.misses < 2000 || n.hidden < 50 || n.ends < 200)
        fail_msg("%d hits, %d misses, %d hidden, %d ends", n.hits, n.misses, n.hidden, n.ends);
}

// --- the correct test ---

static void look_at_crossings(const struct step *s, void *user)
{
    struct decided *n = user;
    const struct cartoon_rain_settings *rules = &s->c->settings.rain;
    for (int i = 0; i < s->is.drop_slots; i++) {
        if (!fell(s, i))
            continue;
        const struct rainfall_vector old = rig_place(&s->was.drops[i]);
        const struct rainfall_vector now = rig_next_place(s->c, &s->was.drops[i]);
        const struct rainfall_spot before = rainfall_spot_of(&s->eye, old),
                                   after = rainfall_spot_of(&s->eye, now);
        if (before.is_at_border || after.is_at_border)
            continue;
        const struct rainfall_gap first = rainfall_behind(&s->eye, old),
                                  last = rainfall_behind(&s->eye, now);
        if (fabs(first.behind_m) < first.doubt_m || fabs(last.behind_m) < last.doubt_m)
            continue;
        const bool crosses =
            before.is_inside && after.is_inside && first.behind_m < 0 && last.behind_m > 0;
        const bool has_hit = s->is.drops[i].state == CARTOON_COLLISION;
        n->misses += !has_hit;
        if (has_hit && !crosses)
            fail_msg("a drop has hit that goes from %.3g m to %.3g m behind", first.behind_m,
                     last.behind_m);
        if (!has_hit && crosses && last.behind_m < rules->thickness_m - last.doubt_m)
            fail_msg("a drop passed %.3g m behind what is seen", last.behind_m);
        n->hidden += !has_hit && crosses;
        if (!has_hit)
            continue;
        n->hits++;
        expect_on_way(s, i);
        const struct rainfall_gap end = rainfall_behind(&s->eye, rig_place(&s->is.drops[i]));
        const struct rainfall_gap begin = rainfall_behind(&s->eye, before_hit(s, i));
        if (end.behind_m < -end.doubt_m || end.behind_m > rules->thickness_m + end.doubt_m)
            fail_msg("a hit %.3g m behind the surface", end.behind_m);
        if (begin.behind_m > begin.doubt_m)
            fail_msg("bisection ended behind the hit: %.3g m and %.3g m", begin.behind_m,
                     end.behind_m);
        n->ends += end.doubt_m < 1;
    }
}

static void a_drop_hits_what_its_middle_passes(void **state)
{
    (void)state;
    struct decided n = {0};
    each_step("scene=house2 drops_s=4000", 256, 60, 90, look_at_crossings, &n);
    each_step("scene=house2 drops_s=2000 precision_m=0.03 wind_m_s=6", 256, 60, 90,
              look_at_crossings, &n);
    if (n.hits < 500 || n.misses < 2000 || n.hidden < 10 || n.ends < 400)
        fail_msg("%d hits, %d misses, %d hidden, %d ends", n.hits, n.misses, n.hidden, n.ends);
}

// --- rasterised spheres ---

// A sphere of 6 by 4 quads, upright.
static struct rainfall_vector corner_of(struct rainfall_vector middle, double radius, int ring,
                                        int slice)
{
    const double pi = acos(-1), rise = pi * ring / 4 - pi / 2, turn = 2 * pi * slice / 6;
    return (struct rainfall_vector){middle.x + radius * cos(rise) * sin(turn),
                                    middle.y + radius * sin(rise),
                                    middle.z + radius * cos(rise) * cos(turn)};
}

// How far along a ray through the sphere's mesh its near side is; 0: beside it.
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

static void look_at_spheres(const struct step *s, void *user)
{
    struct spheres *n = user;
    for (int i = 0; i < s->c->rain.drops; i++) {
        const int slot = (int)s->is.living[i];
        const struct rainfall_vector at = rig_next_place(s->c, &s->was.drops[slot]);
        const struct rainfall_spot spot = rainfall_spot_of(&s->eye, at);
        if (!fell(s, slot) || spot.is_at_border || i % 3)
            continue;
        const int due =
            spot.is_inside ? facet_samples(&s->eye, at, bound_m(s->c, spot.distance_m)) : 0;
        const double off = fabs((double)s->is.counts[i] - due);
        // A quad is drawn as if it were even, and corners are snapped to 1/256 pixel.
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
    each_step("scene=house2 drops_s=2000 collide=faithful query=spheres bound_m=0.08", 128, 70, 74,
              look_at_spheres, &n);
    if (n.asked < 50 || n.off > 0.15 * n.asked)
        fail_msg("%d spheres, %.3g samples off in the mean", n.asked, n.off / n.asked);
}

// --- hits against rays ---

static struct rainfall_vector corner(const struct rg_mesh *mesh, int face, int k)
{
    const float *p = mesh->positions + 3 * (size_t)mesh->indices[3 * face + k % 3];
    return (struct rainfall_vector){(double)p[0], (double)p[1], (double)p[2]};
}

// The sine of the angle at which a way meets a face.
static double sine_to(const struct rainfall_vector corners[3], struct rainfall_vector way)
{
    const struct rainfall_vector a = rainfall_sum(corners[1], corners[0], -1);
    const struct rainfall_vector b = rainfall_sum(corners[2], corners[0], -1);
    const struct rainfall_vector n = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                                      a.x * b.y - a.y * b.x};
    return fabs(rainfall_dot(n, way)) / rainfall_length(n) / rainfall_length(way);
}

// The distance of a hit from the nearest place where the drop's way meets the mesh, less what a
// rounding of the depth map comes to along a way that grazes it.
static double off_mesh_m(const struct cartoon *c, struct rainfall_vector from,
                         struct rainfall_vector to, struct rainfall_vector hit)
{
    const struct rg_mesh *mesh = c->diorama->mesh;
    const struct rainfall_vector way = rainfall_sum(to, from, -1);
    const double length = rainfall_length(way);
    const double at = rainfall_length(rainfall_sum(hit, from, -1));
    double nearest = INFINITY;
    for (int f = 0; f < mesh->face_count; f++) {
        const struct rainfall_vector corners[] = {corner(mesh, f, 0), corner(mesh, f, 1),
                                                  corner(mesh, f, 2)};
        const double along = rainfall_meets(from, to, corners);
        if (along >= 0)
            nearest = fmin(nearest, fabs(along * length - at) - ROUNDED_M / sine_to(corners, way));
    }
    return nearest;
}

// The face that is seen through a place on the screen; -1: none.
static int face_at(const struct step *s, double x_px, double y_px)
{
    const struct rainfall_eye *eye = &s->eye;
    const struct rg_mesh *mesh = s->c->diorama->mesh;
    struct rainfall_vector to = rainfall_sum(eye->at, eye->ahead, eye->far_m);
    to = rainfall_sum(to, eye->right, (x_px - eye->width / 2.0) / eye->focal_px * eye->far_m);
    to = rainfall_sum(to, eye->up, (eye->height / 2.0 - y_px) / eye->focal_px * eye->far_m);
    double nearest = 2;
    int face = -1;
    for (int f = 0; f < mesh->face_count; f++) {
        const struct rainfall_vector corners[] = {corner(mesh, f, 0), corner(mesh, f, 1),
                                                  corner(mesh, f, 2)};
        const double along = rainfall_meets(eye->at, to, corners);
        if (along >= 0 && along < nearest) {
            nearest = along;
            face = f;
        }
    }
    return face;
}

// Whether the texels that depths about a place are found from see more than one face: its own and
// the next one, with their neighbours.
static bool is_at_edge(const struct step *s, struct rainfall_vector place)
{
    const struct rainfall_spot at = rainfall_spot_of(&s->eye, place);
    const double x = floor(at.x_px) + 0.5, y = floor(at.y_px) + 0.5;
    const int here = face_at(s, at.x_px, at.y_px);
    for (int i = 0; i < 25; i++)
        if (face_at(s, x + i % 5 - 2, y + i / 5 - 2) != here)
            return true;
    return false;
}

struct against_rays {
    int hits, edges;
    double worst_m;
};

static void look_at_rays(const struct step *s, void *user)
{
    struct against_rays *n = user;
    for (int i = 0; i < s->is.drop_slots; i++) {
        if (!fell(s, i) || s->is.drops[i].state != CARTOON_COLLISION)
            continue;
        const struct rainfall_vector from = rig_place(&s->was.drops[i]);
        const struct rainfall_vector to = rig_next_place(s->c, &s->was.drops[i]);
        const struct rainfall_vector way = rainfall_sum(to, from, -1);
        const struct rainfall_vector hit = rig_place(&s->is.drops[i]);
        // The way goes on a little, so that what is met at its very end is met.
        const double off_m =
            off_mesh_m(s->c, rainfall_sum(from, way, -0.1), rainfall_sum(to, way, 0.1), hit);
        n->hits++;
        if (off_m > PRECISION_M && is_at_edge(s, hit))
            n->edges++;
        else
            n->worst_m = fmax(n->worst_m, off_m);
    }
}

// Each hit is as near to where its way meets the mesh as bisection was told to find it, but for a
// few with the edge of a face among the texels beside: the depth map does not say where an edge is.
static void hits_lie_on_the_mesh(void **state)
{
    (void)state;
    struct against_rays n = {0};
    const bool is_long = !strcmp(device->info.name, "cpu");
    each_step("scene=house2 drops_s=12000", 512, 70, is_long ? 270 : 100, look_at_rays, &n);
    print_message("%d hits, %.3g mm off at most; %d at edges\n", n.hits, 1e3 * n.worst_m, n.edges);
    if (n.hits < (is_long ? 10000 : 1000) || n.edges > n.hits / 20)
        fail_msg("%d hits, %d at edges", n.hits, n.edges);
    rig_expect("a hit from the mesh", n.worst_m, 0, PRECISION_M);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_those_of_a_sphere),
        cmocka_unit_test(a_drop_hits_where_few_samples_are_seen),
        cmocka_unit_test(a_drop_hits_what_its_middle_passes),
        cmocka_unit_test(rasterised_spheres_have_their_facets_samples),
        cmocka_unit_test(hits_lie_on_the_mesh),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
