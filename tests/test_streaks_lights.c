// Lights of streaks and their shadow maps: test_streaks_lights DEVICE. Lights against closed forms
// in double precision; shadows of boxes against rays through them; everything against
// cpu:reference.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/log.h"
#include "core/techniques/streaks_lights.h"
#include "kernels/rng.h"
#include "kernels/test_streaks_lights_params.h"
#include "tests/mesh_scene.h"

enum { POINTS = 6000, MAP_PX = 512 };
static const double degree = 3.14159265358979323846 / 180;

struct vec {
    double x, y, z;
};

static struct vec minus(struct vec a, struct vec b)
{
    return (struct vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static struct vec along(struct vec a, double s, struct vec b)
{
    return (struct vec){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static double length(struct vec a)
{
    return sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

static double dot(struct vec a, struct vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double uniform(uint32_t item, uint32_t step)
{
    return (double)rg_uniform(rg_random(5, item, step, 3).x);
}

// --- the scene: a floor with boxes over it, beside a wall ---

static const struct box {
    struct vec low, high;
} boxes[] = {
    {{-20, -1, -20}, {20, 0, 20}}, {{-2, 2, -1.5}, {1, 3, 2}},   {{4, 0, -6}, {6, 5, -4}},
    {{-8, 0, 3}, {-5, 1, 7}},      {{-12, 0, -15}, {-11, 9, 9}}, {{-3, 7, -3}, {3, 7.5, 3}},
    {{7, 0.5, 5}, {7.5, 6, 8}},    {{0, 4.5, 6}, {2, 5, 9}},
};
enum { BOXES = sizeof(boxes) / sizeof(boxes[0]) };

static void put_face(struct faces *faces, int face, int a, int b, int c)
{
    const uint32_t three[3] = {(uint32_t)a, (uint32_t)b, (uint32_t)c};
    memcpy(faces->indices + 3 * (size_t)face, three, sizeof(three));
}

// Corner k has its high x, y or z where bit 0, 1 or 2 of k is set.
static struct faces make_boxes(void)
{
    static const int sides[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1},
                                    {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};
    struct faces faces = faces_make(8 * BOXES, 12 * BOXES);
    for (int i = 0; i < BOXES; i++) {
        for (int k = 0; k < 8; k++) {
            float *p = faces.positions + 3 * (8 * i + k);
            p[0] = (float)(k & 1 ? boxes[i].high.x : boxes[i].low.x);
            p[1] = (float)(k & 2 ? boxes[i].high.y : boxes[i].low.y);
            p[2] = (float)(k & 4 ? boxes[i].high.z : boxes[i].low.z);
        }
        for (int side = 0; side < 6; side++) {
            const int *s = sides[side];
            put_face(&faces, 12 * i + 2 * side, 8 * i + s[0], 8 * i + s[2], 8 * i + s[1]);
            put_face(&faces, 12 * i + 2 * side + 1, 8 * i + s[0], 8 * i + s[3], 8 * i + s[2]);
        }
    }
    return faces;
}

// The part of one axis of a ray inside a slab.
static void cut(double from, double way, double low, double high, double *enter, double *leave)
{
    if (way == 0) {
        if (from < low || from > high)
            *enter = INFINITY;
        return;
    }
    const double a = (low - from) / way, b = (high - from) / way;
    *enter = fmax(*enter, fmin(a, b));
    *leave = fmin(*leave, fmax(a, b));
}

// Whether a box stands between two points.
static bool is_blocked(struct vec from, struct vec to)
{
    const struct vec way = minus(to, from);
    for (int i = 0; i < BOXES; i++) {
        double enter = 0, leave = 1;
        cut(from.x, way.x, boxes[i].low.x, boxes[i].high.x, &enter, &leave);
        cut(from.y, way.y, boxes[i].low.y, boxes[i].high.y, &enter, &leave);
        cut(from.z, way.z, boxes[i].low.z, boxes[i].high.z, &enter, &leave);
        if (enter <= leave)
            return true;
    }
    return false;
}

static const struct streaks_lights_settings bounds = {
    .low_m = {-20, -1, -20}, .high_m = {20, 9, 20}, .shadows = true, .shadow_map_px = MAP_PX};

// All kinds, with the plain cases last: straight down, along an axis.
static const struct rg_light test_lights[] = {
    {.kind = STREAKS_SUN,
     .direction = {-0.48f, -0.64f, 0.6f},
     .colour = {1, 2, 3},
     .shadows = true},
    {.kind = STREAKS_SPOT,
     .position_m = {9, 8, 11},
     .direction = {-0.6f, -0.48f, -0.64f},
     .colour = {30, 20, 10},
     .inner_deg = 20,
     .outer_deg = 50,
     .near_m = 0.1f,
     .shadows = true},
    {.kind = STREAKS_POINT,
     .position_m = {-0.5f, 5.5f, 4},
     .colour = {9, 8, 7},
     .near_m = 0.1f,
     .shadows = true},
    {.kind = STREAKS_SUN, .direction = {0, -1, 0}, .colour = {1, 1, 1}, .shadows = true},
    {.kind = STREAKS_SPOT,
     .position_m = {3, 6.5f, 0},
     .direction = {0, -1, 0},
     .colour = {5, 5, 5},
     .inner_deg = 0,
     .outer_deg = 60,
     .near_m = 0.3f,
     .shadows = true},
    {.kind = STREAKS_POINT, .position_m = {10, 2, 0}, .colour = {1, 1, 1}},
};
enum { LIGHTS = sizeof(test_lights) / sizeof(test_lights[0]), UNSHADOWED = LIGHTS - 1 };

static struct vec place_of(const struct rg_light *light)
{
    return (struct vec){(double)light->position_m[0], (double)light->position_m[1],
                        (double)light->position_m[2]};
}

static struct vec way_of(const struct rg_light *light)
{
    return (struct vec){(double)light->direction[0], (double)light->direction[1],
                        (double)light->direction[2]};
}

// --- the lights on a device ---

struct rig {
    struct rg_device *device;
    struct faces_on scene;
    struct rg_image *maps;
    int layers;
    streaks_light lights[LIGHTS];
};

// Faces that turn away are left out: a matrix that mirrored would leave the wrong ones.
static bool draw_scene(void *user, const float to_clip[16], const struct rg_draw *onto)
{
    const struct rig *rig = user;
    struct rg_draw draw = *onto;
    draw.cull = RG_CULL_BACK;
    raster_mesh_params p = {0};
    memcpy(&p.to_clip, to_clip, sizeof(p.to_clip));
    return rg_pass_run(rig->scene.raster, &(struct rg_run){.params = &p,
                                                           .slots = {[1].buf = rig->scene.positions,
                                                                     [2].buf = rig->scene.normals,
                                                                     [3].buf = rig->scene.indices},
                                                           .extent = {rig->scene.face_count, 1, 1},
                                                           .draw = &draw});
}

static struct rig rig_open(struct rg_device *device)
{
    struct rig rig = {.device = device};
    struct streaks_lights lights = {.count = LIGHTS};
    for (int i = 0; i < LIGHTS; i++) {
        const bool casts = test_lights[i].shadows;
        lights.world[i] = streaks_light_of(&test_lights[i], bounds.low_m, bounds.high_m, MAP_PX,
                                           casts ? lights.map_count : -1);
        lights.map_count += casts ? lights.world[i].shadow_faces : 0;
    }
    struct faces faces = make_boxes();
    faces_upload(device, &faces, &rig.scene);
    faces_free(&faces);
    rig.layers = lights.map_count;
    lights.shadows = rig.maps = rg_image_create(
        device, &(struct rg_image_desc){RG_D32F, MAP_PX, MAP_PX, rig.layers, 1}, "maps");
    assert_true(rig.maps && streaks_lights_shade(&lights, draw_scene, &rig));
    memcpy(rig.lights, lights.world, sizeof(rig.lights));
    return rig;
}

static void rig_close(struct rig *rig)
{
    faces_close(&rig->scene);
    rg_image_destroy(rig->maps);
}

// What `count` lights do at `points` points; by light, then point. The caller frees it.
static test_streaks_lit *light_points(const struct rig *rig, const streaks_light *lights, int count,
                                      const float *points, int point_count)
{
    const int64_t out_bytes = (int64_t)count * point_count * (int64_t)sizeof(test_streaks_lit);
    struct rg_buf *in = rg_buf_create(rig->device, (int64_t)point_count * 12, "points"),
                  *by = rg_buf_create(rig->device, count * (int64_t)sizeof(*lights), "lights"),
                  *out = rg_buf_create(rig->device, out_bytes, "lit");
    struct rg_pass *pass = rg_pass_create(rig->device, "test_streaks_lights");
    const test_streaks_lights_params p = {.points = point_count};
    test_streaks_lit *lit = malloc((size_t)out_bytes);
    assert_true(rg_buf_write(in, 0, points, (int64_t)point_count * 12) &&
                rg_buf_write(by, 0, lights, count * (int64_t)sizeof(*lights)));
    assert_true(rg_pass_run(
        pass, &(struct rg_run){
                  .params = &p,
                  .slots = {[1].buf = in, [2].buf = by, [3].image = rig->maps, [4].buf = out},
                  .extent = {point_count, count, 1}}));
    assert_true(rg_buf_read(out, 0, lit, out_bytes));
    rg_pass_destroy(pass);
    rg_buf_destroy(in);
    rg_buf_destroy(by);
    rg_buf_destroy(out);
    return lit;
}

// Points in the air.
static float *make_points(void)
{
    float *points = malloc(POINTS * 3 * sizeof(float));
    for (uint32_t i = 0; i < POINTS; i++) {
        points[3 * i] = (float)(38 * uniform(i, 0) - 19);
        points[3 * i + 1] = (float)(9 * uniform(i, 1));
        points[3 * i + 2] = (float)(38 * uniform(i, 2) - 19);
    }
    return points;
}

static struct vec point_at(const float *points, int i)
{
    return (struct vec){(double)points[3 * i], (double)points[3 * i + 1],
                        (double)points[3 * i + 2]};
}

// --- reach ---

static double share_due(const struct rg_light *light, struct vec at)
{
    if (light->kind == STREAKS_SUN)
        return 1;
    const struct vec off = minus(at, place_of(light));
    const double distance = length(off), fallen = 1 / (distance * distance);
    if (light->kind == STREAKS_POINT)
        return fallen;
    const double cosine = dot(off, way_of(light)) / distance,
                 inner = cos((double)light->inner_deg * degree),
                 outer = cos((double)light->outer_deg * degree);
    const double t = fmin(fmax((cosine - outer) / (inner - outer), 0), 1);
    return fallen * (3 * t * t - 2 * t * t * t);
}

static void lights_reach_as_the_closed_forms_say(void **state)
{
    struct rig rig = rig_open(*state);
    float *points = make_points();
    test_streaks_lit *lit = light_points(&rig, rig.lights, LIGHTS, points, POINTS);
    int dark = 0, bright = 0;
    for (int k = 0; k < LIGHTS; k++) {
        for (int i = 0; i < POINTS; i++) {
            const test_streaks_lit *l = &lit[k * POINTS + i];
            const struct vec at = point_at(points, i), off = minus(place_of(&test_lights[k]), at),
                             to = test_lights[k].kind == STREAKS_SUN
                                      ? along((struct vec){0, 0, 0}, -1, way_of(&test_lights[k]))
                                      : along((struct vec){0, 0, 0}, 1 / length(off), off);
            const double share = share_due(&test_lights[k], at);
            // a cone's edge is as steep as its width allows, and its cosine rounds to 1e-7
            assert_true(fabs((double)l->share - share) <= 2e-6 * share + 1e-6 / dot(off, off));
            assert_true(length(minus((struct vec){(double)l->to_light.x, (double)l->to_light.y,
                                                  (double)l->to_light.z},
                                     to)) < 1e-6);
            if (test_lights[k].kind == STREAKS_SPOT) {
                dark += l->share == 0;
                bright += l->share > 0;
            }
        }
    }
    assert_true(dark > POINTS / 10 && bright > POINTS / 10);
    free(lit);
    free(points);
    rig_close(&rig);
}

// On the axis and within the inner cone all of it, from the outer cone on nothing, between the two
// ever less; and no stronger than at the nearest distance, even in the light itself.
static void cones_and_near_points_have_their_bounds(void **state)
{
    enum { STEPS = 89 };
    struct rig rig = rig_open(*state);
    float points[3 * (STEPS + 3)];
    const struct rg_light *light = &test_lights[4]; // straight down
    for (int i = 0; i <= STEPS; i++) {
        points[3 * i] = light->position_m[0] + (float)(2 * sin(i * degree));
        points[3 * i + 1] = light->position_m[1] - (float)(2 * cos(i * degree));
        points[3 * i + 2] = light->position_m[2];
    }
    memcpy(points + 3 * (STEPS + 1), light->position_m, sizeof(light->position_m));
    memcpy(points + 3 * (STEPS + 2), light->position_m, sizeof(light->position_m));
    points[3 * (STEPS + 2) + 1] -= 0.05f;
    test_streaks_lit *lit = light_points(&rig, &rig.lights[4], 1, points, STEPS + 3);
    assert_float_equal(lit[0].share, 0.25f, 1e-6f);
    for (int i = 1; i <= STEPS; i++) {
        if (i > light->outer_deg)
            assert_true(lit[i].share == 0);
        else if (i < light->outer_deg)
            assert_true(lit[i].share > 0 && lit[i].share < lit[i - 1].share);
    }
    assert_true(lit[STEPS + 1].share >= 0 && lit[STEPS + 1].share <= 100.0001f);
    assert_float_equal(lit[STEPS + 2].share, 100, 1e-3f);
    free(lit);
    rig_close(&rig);
}

// --- shadows ---

// Whether a light reaches a point; -1 where that changes within `margin` of it.
static int reached_about(const struct rg_light *light, struct vec at, double bias, double margin)
{
    int lit = 0, tried = 0;
    for (int x = -1; x <= 1; x++)
        for (int y = -1; y <= 1; y++)
            for (int z = -1; z <= 1; z++) {
                const struct vec p = {at.x + x * margin, at.y + y * margin, at.z + z * margin};
                const struct vec off = light->kind == STREAKS_SUN
                                           ? along((struct vec){0, 0, 0}, -100, way_of(light))
                                           : minus(place_of(light), p);
                const double all = length(off), near = (double)light->near_m;
                lit += !is_blocked(along(p, bias / all, off), along(p, (all - near) / all, off));
                tried++;
            }
    return lit == tried ? 1 : lit == 0 ? 0 : -1;
}

struct seen {
    int lit, shadowed, wrong, soft_wrong, unsure;
};

static void check_point(const struct rg_light *light, const streaks_light *l, struct vec at,
                        const test_streaks_lit *lit, struct seen *seen)
{
    const double away = light->kind == STREAKS_SUN ? 1 : length(minus(at, place_of(light)));
    // A texel's half diagonal, twice as much between four texels, and some.
    const int due = reached_about(light, at, (double)l->shadow_bias_m,
                                  2 * (double)l->shadow_texel * away + 0.01);
    seen->lit += due == 1;
    seen->shadowed += due == 0;
    seen->unsure += due < 0;
    seen->wrong += due >= 0 && lit->unshadowed != (float)due;
    seen->soft_wrong += due >= 0 && lit->soft != (float)due;
}

// Within a spot's cone; of others everywhere.
static bool is_in_cone(const struct rg_light *light, struct vec at)
{
    const struct vec off = minus(at, place_of(light));
    return light->kind != STREAKS_SPOT ||
           dot(off, way_of(light)) > length(off) * cos((double)light->outer_deg * degree);
}

static void shadows_fall_where_rays_are_blocked(void **state)
{
    struct rig rig = rig_open(*state);
    float *points = make_points();
    test_streaks_lit *lit = light_points(&rig, rig.lights, LIGHTS, points, POINTS);
    for (int k = 0; k < UNSHADOWED; k++) {
        struct seen seen = {0};
        int inside = 0;
        for (int i = 0; i < POINTS; i++) {
            if (!is_in_cone(&test_lights[k], point_at(points, i)))
                continue;
            inside++;
            check_point(&test_lights[k], &rig.lights[k], point_at(points, i), &lit[k * POINTS + i],
                        &seen);
        }
        print_message("light %d: %d lit, %d shadowed, %d on an edge, %d and %d wrong\n", k,
                      seen.lit, seen.shadowed, seen.unsure, seen.wrong, seen.soft_wrong);
        assert_true(seen.lit > inside / 5 && seen.shadowed > inside / 50);
        assert_true(seen.unsure < inside / 2);
        assert_int_equal(seen.wrong, 0);
        assert_int_equal(seen.soft_wrong, 0);
    }
    free(lit);
    free(points);
    rig_close(&rig);
}

// A floor is not shaded by itself, but by what stands on it.
static void floors_do_not_shade_themselves(void **state)
{
    struct rig rig = rig_open(*state);
    float *points = make_points();
    for (int i = 0; i < POINTS; i++)
        points[3 * i + 1] = 0;
    test_streaks_lit *lit = light_points(&rig, rig.lights, LIGHTS, points, POINTS);
    for (int k = 0; k < UNSHADOWED; k++) {
        int bright = 0, dark = 0;
        for (int i = 0; i < POINTS; i++) {
            struct vec at = point_at(points, i);
            const double away = test_lights[k].kind == STREAKS_SUN
                                    ? 1
                                    : length(minus(at, place_of(&test_lights[k])));
            const double texel = (double)rig.lights[k].shadow_texel * away;
            at.y = 4 * texel + 0.05; // the oracle's margin stays off the floor
            const int due = reached_about(&test_lights[k], at, 0, 3 * texel + 0.02);
            if (due < 0 || !is_in_cone(&test_lights[k], at))
                continue;
            bright += due;
            dark += !due;
            assert_true(lit[k * POINTS + i].surface == (float)due);
        }
        assert_true(bright > POINTS / 20 && dark > POINTS / 500);
    }
    free(lit);
    free(points);
    rig_close(&rig);
}

// The bias is metres of the ray: so far into the floor a point is lit yet, and farther in it is
// not.
static void the_bias_is_metres_along_the_ray(void **state)
{
    struct rig rig = rig_open(*state);
    float *points = make_points();
    int checked[LIGHTS] = {0};
    for (int k = 3; k <= 4; k++) { // these look straight down, so that the floor's depth is all one
        const struct rg_light *light = &test_lights[k];
        for (int i = 0; i < POINTS; i++) {
            const struct vec at = {(double)points[3 * i], 0, (double)points[3 * i + 2]};
            const struct vec off = minus(at, place_of(light));
            const struct vec way = light->kind == STREAKS_SUN
                                       ? way_of(light)
                                       : along((struct vec){0, 0, 0}, 1 / length(off), off);
            const double deep = (double)rig.lights[k].shadow_bias_m * (i % 2 ? 0.9 : 1.1);
            const struct vec in = along(at, deep, way);
            points[3 * i] = (float)in.x;
            points[3 * i + 1] = (float)in.y;
            points[3 * i + 2] = (float)in.z;
        }
        test_streaks_lit *lit = light_points(&rig, &rig.lights[k], 1, points, POINTS);
        for (int i = 0; i < POINTS; i++) {
            struct vec at = point_at(points, i);
            at.y = 0.3;
            if (reached_about(light, at, 0, 0.25) != 1 || !is_in_cone(light, at))
                continue;
            assert_true(lit[i].unshadowed == (i % 2 ? 1.0f : 0.0f));
            checked[k]++;
        }
        free(lit);
    }
    assert_true(checked[3] > POINTS / 2 && checked[4] > POINTS / 100);
    free(points);
    rig_close(&rig);
}

static void nothing_shades_where_no_map_is(void **state)
{
    struct rig rig = rig_open(*state);
    float *points = make_points();
    streaks_light lights[LIGHTS];
    memcpy(lights, rig.lights, sizeof(lights));
    for (int k = 0; k < LIGHTS; k++)
        lights[k].shadow_layer = -1;
    test_streaks_lit *lit = light_points(&rig, lights, LIGHTS, points, POINTS),
                     *with = light_points(&rig, rig.lights, LIGHTS, points, POINTS);
    for (int i = 0; i < LIGHTS * POINTS; i++)
        assert_true(lit[i].unshadowed == 1 && lit[i].soft == 1 && lit[i].surface == 1);
    int beside = 0;
    for (int i = 0; i < POINTS; i++) { // a frustum's corners are as far out as its diagonal
        const struct rg_light *spot = &test_lights[1];
        const struct vec off = minus(point_at(points, i), place_of(spot));
        const double corner = atan(1.42 * 1.01 * tan((double)spot->outer_deg * degree));
        if (dot(off, way_of(spot)) > length(off) * cos(corner))
            continue;
        beside++;
        assert_true(with[POINTS + i].unshadowed == 1 && with[POINTS + i].soft == 1);
    }
    assert_true(beside > POINTS / 10);
    free(lit);
    free(with);
    free(points);
    rig_close(&rig);
}

// --- the list of a scene ---

static const struct city_lamp lamps[] = {
    {CITY_STREET_LAMP, {9, 8, 11}, {0, -1, 0}},
    {CITY_TRAFFIC_RED, {3, 2, 3}, {0.6f, 0, 0.8f}},
};

static struct streaks_lights_settings three_lights(void)
{
    struct streaks_lights_settings s = bounds;
    static const float to_rain[16] = {1, 0, 0, 0, 0, 0, -1, 0, 0, -1, 0, 9, 0, 0, 0, 1};
    s.count = 3;
    s.lamps = lamps;
    s.lamp_count = 2;
    memcpy(s.world_to_rain, to_rain, sizeof(to_rain));
    return s;
}

// Rain falls along -y from 9 m up: (x, y, s) = (x, -z, 9 - y).
static void lights_open_in_both_frames(void **state)
{
    const struct streaks_lights_settings settings = three_lights();
    struct streaks_lights *lights = streaks_lights_open(*state, &settings);
    assert_non_null(lights);
    assert_int_equal(lights->count, 3);
    assert_int_equal(lights->map_count, 3);
    assert_int_equal(lights->shadows->desc.width, MAP_PX);
    assert_int_equal(lights->shadows->desc.layers, 3);
    streaks_light world[3], rain[3];
    assert_true(rg_buf_read(lights->in_world, 0, world, sizeof(world)) &&
                rg_buf_read(lights->in_rain, 0, rain, sizeof(rain)));
    assert_memory_equal(world, lights->world, sizeof(world));
    for (int i = 0; i < 3; i++) {
        assert_true(rain[i].x == world[i].x && rain[i].y == -world[i].z);
        assert_float_equal(rain[i].z, 9 - world[i].y, 1e-6f);
        assert_true(rain[i].dx == world[i].dx && rain[i].dy == -world[i].dz &&
                    rain[i].dz == -world[i].dy);
        assert_true(rain[i].r == world[i].r && rain[i].shadow_layer == i);
    }
    streaks_lights_close(lights);
}

static void each_light_draws_its_own_layers(void **state)
{
    struct rig rig = rig_open(*state);
    const struct streaks_lights_settings settings = three_lights();
    struct streaks_lights *lights = streaks_lights_open(*state, &settings);
    float *texels = malloc(MAP_PX * MAP_PX * sizeof(float));
    for (int again = 0; again < 2; again++) // drawn anew, maps hold the same
        assert_true(streaks_lights_shade(lights, draw_scene, &rig));
    for (int layer = 0; layer < 3; layer++) {
        int drawn = 0;
        assert_true(rg_image_read(lights->shadows, layer, 0, texels));
        for (int i = 0; i < MAP_PX * MAP_PX; i++)
            drawn += texels[i] < 1;
        assert_true(drawn > MAP_PX * MAP_PX / 4);
    }
    free(texels);
    streaks_lights_close(lights);
    rig_close(&rig);
}

static void without_shadows_no_map_is_drawn(void **state)
{
    struct streaks_lights_settings settings = three_lights();
    settings.shadows = false;
    struct streaks_lights *lights = streaks_lights_open(*state, &settings);
    assert_non_null(lights);
    assert_int_equal(lights->map_count, 0);
    assert_int_equal(lights->shadows->desc.width, 1);
    for (int i = 0; i < 3; i++)
        assert_int_equal(lights->world[i].shadow_layer, -1);
    assert_true(streaks_lights_shade(lights, NULL, NULL));
    streaks_lights_close(lights);
}

static void no_lights_are_none(void **state)
{
    struct streaks_lights_settings settings = three_lights();
    for (int time = STREAKS_DAY; time <= STREAKS_NIGHT; time++) {
        settings.count = 0;
        settings.time = (enum streaks_time)time;
        struct streaks_lights *lights = streaks_lights_open(*state, &settings);
        assert_true(lights && lights->count == 0 && lights->map_count == 0);
        assert_true(lights->in_world && lights->in_rain && lights->shadows && lights->sky[0] > 0);
        assert_true(streaks_lights_shade(lights, NULL, NULL));
        streaks_lights_close(lights);
    }
}

static void lights_that_cannot_be_are_refused(void **state)
{
    struct streaks_lights_settings settings = three_lights();
    settings.count = -1;
    assert_null(streaks_lights_open(*state, &settings));
    assert_non_null(strstr(rg_last_error(), "lights: -1 asked for"));
    settings.count = 17;
    assert_null(streaks_lights_open(*state, &settings));
    assert_non_null(strstr(rg_last_error(), "lights: 17 asked for"));
    settings.count = 3;
    settings.shadow_map_px = 15;
    assert_null(streaks_lights_open(*state, &settings));
    assert_non_null(strstr(rg_last_error(), "shadow_map_px: 15"));
    settings.shadow_map_px = 16384;
    assert_null(streaks_lights_open(*state, &settings));
    assert_non_null(strstr(rg_last_error(), "3 shadow maps of 16384 texels take 3072 MiB"));
}

// --- sums, frames, devices ---

// Lights do not know of each other: alone, and in any order, they give what they give together.
static void lights_add_up(void **state)
{
    struct rig rig = rig_open(*state);
    float *points = make_points();
    streaks_light turned[LIGHTS];
    for (int k = 0; k < LIGHTS; k++)
        turned[k] = rig.lights[LIGHTS - 1 - k];
    test_streaks_lit *all = light_points(&rig, rig.lights, LIGHTS, points, POINTS),
                     *back = light_points(&rig, turned, LIGHTS, points, POINTS);
    for (int k = 0; k < LIGHTS; k++) {
        test_streaks_lit *one = light_points(&rig, &rig.lights[k], 1, points, POINTS);
        assert_memory_equal(one, all + k * POINTS, POINTS * sizeof(*one));
        assert_memory_equal(one, back + (LIGHTS - 1 - k) * POINTS, POINTS * sizeof(*one));
        free(one);
    }
    free(all);
    free(back);
    free(points);
    rig_close(&rig);
}

// In a frame that is turned and moved the same light reaches the same points, but for rounding.
static void frames_do_not_matter(void **state)
{
    static const float matrix[16] = {0.8f,  0,     -0.6f, 10, 0.36f, 0.8f, 0.48f, -20,
                                     0.48f, -0.6f, 0.64f, 5,  0,     0,    0,     1};
    struct rig rig = rig_open(*state);
    float *points = make_points(), *moved = malloc(POINTS * 3 * sizeof(float));
    streaks_light lights[LIGHTS];
    for (int k = 0; k < LIGHTS; k++)
        lights[k] = streaks_light_moved(&rig.lights[k], matrix);
    for (int i = 0; i < POINTS; i++)
        for (int c = 0; c < 3; c++)
            moved[3 * i + c] = matrix[4 * c] * points[3 * i] +
                               matrix[4 * c + 1] * points[3 * i + 1] +
                               matrix[4 * c + 2] * points[3 * i + 2] + matrix[4 * c + 3];
    test_streaks_lit *here = light_points(&rig, rig.lights, LIGHTS, points, POINTS),
                     *there = light_points(&rig, lights, LIGHTS, moved, POINTS);
    int unequal = 0;
    for (int k = 0; k < LIGHTS; k++)
        for (int i = 0; i < POINTS; i++) {
            const test_streaks_lit *a = &here[k * POINTS + i], *b = &there[k * POINTS + i];
            const double d = length(minus(point_at(points, i), place_of(&test_lights[k])));
            assert_true(fabsf(a->share - b->share) <= 2e-5f * a->share + (float)(1e-5 / d / d));
            unequal += a->unshadowed != b->unshadowed;
        }
    assert_true(unequal < LIGHTS * POINTS / 2000); // on the edges of texels
    free(here);
    free(there);
    free(points);
    free(moved);
    rig_close(&rig);
}

static void all_bytes_are_those_of_the_reference(void **state)
{
    struct rg_device *reference = rg_device_open("cpu:reference", NULL);
    assert_non_null(reference);
    struct rig rigs[2] = {rig_open(*state), rig_open(reference)};
    float *points = make_points(), *texels[2];
    test_streaks_lit *lit[2];
    for (int r = 0; r < 2; r++) {
        lit[r] = light_points(&rigs[r], rigs[r].lights, LIGHTS, points, POINTS);
        texels[r] = malloc(MAP_PX * MAP_PX * sizeof(float));
    }
    assert_memory_equal(lit[0], lit[1], LIGHTS * POINTS * sizeof(*lit[0]));
    for (int layer = 0; layer < rigs[0].layers; layer++) {
        for (int r = 0; r < 2; r++)
            assert_true(rg_image_read(rigs[r].maps, layer, 0, texels[r]));
        assert_memory_equal(texels[0], texels[1], MAP_PX * MAP_PX * sizeof(float));
    }
    for (int r = 0; r < 2; r++) {
        free(lit[r]);
        free(texels[r]);
        rig_close(&rigs[r]);
    }
    free(points);
    assert_true(rg_device_close(reference));
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_reach_as_the_closed_forms_say),
        cmocka_unit_test(cones_and_near_points_have_their_bounds),
        cmocka_unit_test(shadows_fall_where_rays_are_blocked),
        cmocka_unit_test(floors_do_not_shade_themselves),
        cmocka_unit_test(the_bias_is_metres_along_the_ray),
        cmocka_unit_test(nothing_shades_where_no_map_is),
        cmocka_unit_test(lights_open_in_both_frames),
        cmocka_unit_test(each_light_draws_its_own_layers),
        cmocka_unit_test(without_shadows_no_map_is_drawn),
        cmocka_unit_test(no_lights_are_none),
        cmocka_unit_test(lights_that_cannot_be_are_refused),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(frames_do_not_matter),
        cmocka_unit_test(all_bytes_are_those_of_the_reference),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
