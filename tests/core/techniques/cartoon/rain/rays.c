// The correct test of hits against rays in double precision. Each hit is where the drop's path
// meets the mesh, at a place that the eye sees. Each meeting that the eye sees is a hit.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/cartoon/rain/rig.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

#define PLACED_M  2e-6 // the error of places in floats; more along a grazing path
#define ROUNDED_M 2e-5 // the error of a float ray's meeting with a face

static struct rg_device *device;

// --- the mesh ---

struct faces {
    int count;
    struct rainfall_vector (*corners)[3];
    double (*low)[3], (*high)[3];
};

static double part(struct rainfall_vector v, int i)
{
    return i == 0 ? v.x : i == 1 ? v.y : v.z;
}

static struct faces faces_of(const struct cartoon *c)
{
    const struct rg_mesh *mesh = c->diorama->mesh;
    const size_t count = (size_t)mesh->face_count;
    struct faces f = {mesh->face_count, malloc(count * sizeof(*f.corners)),
                      malloc(count * sizeof(*f.low)), malloc(count * sizeof(*f.high))};
    assert_true(f.corners && f.low && f.high);
    for (size_t i = 0; i < 3 * count; i++) {
        const float *p = mesh->positions + 3 * (size_t)mesh->indices[i];
        f.corners[i / 3][i % 3] =
            (struct rainfall_vector){(double)p[0], (double)p[1], (double)p[2]};
    }
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            const struct rainfall_vector *a = f.corners[i];
            f.low[i][k] = fmin(part(a[0], k), fmin(part(a[1], k), part(a[2], k)));
            f.high[i][k] = fmax(part(a[0], k), fmax(part(a[1], k), part(a[2], k)));
        }
    return f;
}

static void free_faces(struct faces *f)
{
    free(f->corners);
    free(f->low);
    free(f->high);
}

static bool may_meet(const struct faces *f, int face, const double low[3], const double high[3])
{
    for (int k = 0; k < 3; k++)
        if (low[k] > f->high[face][k] || high[k] < f->low[face][k])
            return false;
    return true;
}

// A path's meeting with the mesh: the share of the path up to it, and its angle. -1: no meeting.
struct met {
    double along, sine;
    int face;                      // its number
    struct rainfall_vector normal; // unit length, on the side that the path comes from
};

static struct rainfall_vector normal_of(const struct rainfall_vector corners[3])
{
    const struct rainfall_vector a = rainfall_sum(corners[1], corners[0], -1);
    const struct rainfall_vector b = rainfall_sum(corners[2], corners[0], -1);
    return (struct rainfall_vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                                    a.x * b.y - a.y * b.x};
}

static struct met met_at(const struct rainfall_vector corners[3], struct rainfall_vector way,
                         double along, int face)
{
    const struct rainfall_vector n = normal_of(corners), nothing = {0, 0, 0};
    const double against = -rainfall_dot(n, way), length = rainfall_length(n);
    return (struct met){along, fabs(against) / length / rainfall_length(way), face,
                        rainfall_sum(nothing, n, (against > 0 ? 1 : -1) / length)};
}

// The meeting of a path with the mesh that is nearest to a share of it.
static struct met nearest_to(const struct faces *f, struct rainfall_vector from,
                             struct rainfall_vector to, double share)
{
    const struct rainfall_vector way = rainfall_sum(to, from, -1);
    double low[3], high[3];
    struct met nearest = {.along = -1};
    for (int k = 0; k < 3; k++) {
        low[k] = fmin(part(from, k), part(to, k));
        high[k] = fmax(part(from, k), part(to, k));
    }
    for (int i = 0; i < f->count; i++) {
        if (!may_meet(f, i, low, high))
            continue;
        const double along = rainfall_meets(from, to, f->corners[i]);
        if (along >= 0 && (nearest.along < 0 || fabs(along - share) < fabs(nearest.along - share)))
            nearest = met_at(f->corners[i], way, along, i);
    }
    return nearest;
}

// Whether nothing is between the eye and a place on the mesh.
static bool is_seen(const struct faces *f, const struct rainfall_eye *eye,
                    struct rainfall_vector place)
{
    const struct rainfall_vector ray = rainfall_sum(place, eye->at, -1);
    const double less = 1 - 1e-3 / rainfall_length(ray);
    return nearest_to(f, eye->at, rainfall_sum(eye->at, ray, less), 0).along < 0;
}

// --- what hits ---

struct against_rays {
    struct faces faces;
    int hits, hidden;
    double off_m; // the largest distance of a hit behind the meeting
    int seen, missed;
};

// A hit is never in front of the mesh. It is compared with the path's last meeting, since another
// may follow right behind the first.
static void look_at_hit(const struct rig_change *m, int slot, struct against_rays *n)
{
    const struct rainfall_vector from = rig_place(&m->was.drops[slot]);
    const struct rainfall_vector to = rig_next_place(m->c, &m->was.drops[slot]);
    const struct rainfall_vector way = rainfall_sum(to, from, -1);
    const struct rainfall_vector hit = rig_place(&m->is.drops[slot]);
    const double more = ROUNDED_M / rainfall_length(way);
    const struct rainfall_vector begin = rainfall_sum(from, way, -more),
                                 end = rainfall_sum(hit, way, more);
    const struct met met = nearest_to(&n->faces, begin, end, 1);
    rig_expect_on_way(m, slot);
    if (met.along < 0)
        fail_msg("drop %u has hit, and its way meets nothing", m->was.drops[slot].number);
    const struct rainfall_vector place =
        rainfall_sum(begin, rainfall_sum(end, begin, -1), met.along);
    const double off_m = rainfall_length(rainfall_sum(end, place, -1)) - ROUNDED_M;
    n->hits++;
    n->off_m = fmax(n->off_m, off_m - PLACED_M / met.sine);
    n->hidden += !is_seen(&n->faces, &m->eye, place);
}

static void look_at_hits(const struct rig_change *m, void *user)
{
    struct against_rays *n = user;
    if (!n->faces.count)
        n->faces = faces_of(m->c);
    for (int i = 0; i < m->is.drop_slots; i++)
        if (rig_fell(m, i) && m->is.drops[i].state == CARTOON_COLLISION)
            look_at_hit(m, i, n);
}

static void expect_hits(const char *settings, int from, int to, int least, double precision_m,
                        int of_hidden)
{
    struct against_rays n = {0};
    rig_each_step(device, settings, 512, from, to, look_at_hits, &n);
    free_faces(&n.faces);
    print_message("%s: %d hits, %.4g mm behind the mesh at most; %d hidden\n", settings, n.hits,
                  1e3 * n.off_m, n.hidden);
    if (n.hits < least || n.hidden > n.hits / of_hidden)
        fail_msg("%d hits, %d of them hidden", n.hits, n.hidden);
    rig_expect("a hit behind the mesh", n.off_m, 0, precision_m + ROUNDED_M);
    // Bisection is no finer than its precision.
    assert_above(n.off_m, precision_m / 2);
}

// The face map alone decides whether a face is hidden. Things smaller than its texels, such as the
// park's leaves, may hide one all the same.
static void hits_lie_on_the_mesh(void **state)
{
    (void)state;
    const bool is_long = !strcmp(device->info.name, "cpu");
    expect_hits("scene=house2 drops_s=12000", 70, is_long ? 260 : 100, is_long ? 10000 : 1000,
                0.001, 200);
    expect_hits("scene=ground drops_s=6000 wind_m_s=6 precision_m=0.0001", 70, is_long ? 90 : 75,
                50, 0.0001, 100);
    expect_hits("scene=park1 drops_s=6000 spin_deg=3 precision_m=0.02", 70, is_long ? 90 : 75, 100,
                0.02, 20);
}

// A box whose faces look inwards, as some exporters leave them: the eye sees their backs, and drops
// hit these.
static void faces_have_two_sides(void **state)
{
    (void)state;
    static const char box[] = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\n"
                              "v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
                              "f 6 7 8 5\nf 4 3 2 1\nf 8 7 3 4\nf 6 5 1 2\nf 7 6 2 3\nf 5 8 4 1\n";
    char path[64], settings[160];
    snprintf(path, sizeof(path), "%s/box.obj", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(box, file);
    assert_int_equal(fclose(file), 0);
    snprintf(settings, sizeof(settings), "scene=mesh mesh=%s drops_s=6000", path);
    expect_hits(settings, 70, 80, 150, 0.001, 100); // of 178
    assert_int_equal(unlink(path), 0);
}

// The face seen in each pixel, with numbers beyond two bytes among them.
static void the_face_map_names_what_is_seen(void **state)
{
    (void)state;
    enum { SIZE_PX = 20 };
    struct cartoon *c = rig_open(device, "scene=mesh mesh=bunny drops_s=0", SIZE_PX, SIZE_PX);
    rig_step(c, 1);
    struct faces faces = faces_of(c);
    struct rainfall_eye eye = rig_eye(c);
    uint32_t *found = rig_texels(c, "face_map", 0, 0);
    int alike = 0, seen = 0, large = 0;
    for (int i = 0; i < SIZE_PX * SIZE_PX; i++) {
        const double x = (i % SIZE_PX + 0.5 - SIZE_PX / 2.0) / eye.focal_px * eye.far_m,
                     y = (SIZE_PX / 2.0 - i / SIZE_PX - 0.5) / eye.focal_px * eye.far_m;
        struct rainfall_vector to = rainfall_sum(eye.at, eye.ahead, eye.far_m);
        to = rainfall_sum(rainfall_sum(to, eye.right, x), eye.up, y);
        const struct met met = nearest_to(&faces, eye.at, to, 0);
        const uint32_t due = met.along < 0 ? 0 : (uint32_t)met.face + 1;
        seen += due > 0;
        large += due > 65535;
        alike += found[i] == due;
    }
    free(found);
    free((void *)eye.depth);
    free_faces(&faces);
    rig_close(c);
    if (seen < 100 || large < 5 || alike < SIZE_PX * SIZE_PX * 97 / 100)
        fail_msg("%d of %d pixels name the face; %d see one, %d a large number", alike,
                 SIZE_PX * SIZE_PX, seen, large);
}

// --- what is seen to hit ---

static void look_at_crossings(const struct rig_change *m, void *user)
{
    struct against_rays *n = user;
    if (!n->faces.count)
        n->faces = faces_of(m->c);
    for (int i = 0; i < m->is.drop_slots; i++) {
        if (!rig_fell(m, i))
            continue;
        const struct rainfall_vector from = rig_place(&m->was.drops[i]);
        const struct rainfall_vector to = rig_next_place(m->c, &m->was.drops[i]);
        const struct rainfall_spot before = rainfall_spot_of(&m->eye, from),
                                   after = rainfall_spot_of(&m->eye, to);
        if (!before.is_inside || !after.is_inside || before.is_at_border || after.is_at_border)
            continue;
        const struct met met = nearest_to(&n->faces, from, to, 0);
        if (met.along < 0)
            continue;
        const struct rainfall_vector place =
            rainfall_sum(from, rainfall_sum(to, from, -1), met.along);
        // A hidden drop may come out of a solid through the side that the eye sees.
        const bool is_from_before =
            rainfall_dot(met.normal, rainfall_sum(m->eye.at, place, -1)) > 0;
        if (!is_from_before || !is_seen(&n->faces, &m->eye, place))
            continue;
        n->seen++;
        n->missed += m->is.drops[i].state != CARTOON_COLLISION;
    }
}

// One in 40 may be missed: faces that lie between the centres of texels, and sheets that a step
// passes with both ends seen.
static void what_is_seen_to_hit_has_hit(void **state)
{
    (void)state;
    struct against_rays n = {0};
    rig_each_step(device, "scene=house2 drops_s=12000", 512, 70, 90, look_at_crossings, &n);
    free_faces(&n.faces);
    print_message("%d ways are seen to meet the mesh; %d did not hit\n", n.seen, n.missed);
    if (n.seen < 500 || n.missed > n.seen / 40)
        fail_msg("%d ways are seen to meet the mesh; %d did not hit", n.seen, n.missed);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_face_map_names_what_is_seen),
        cmocka_unit_test(hits_lie_on_the_mesh),
        cmocka_unit_test_setup_teardown(faces_have_two_sides, make_folder, remove_folder),
        cmocka_unit_test(what_is_seen_to_hit_has_hit),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
