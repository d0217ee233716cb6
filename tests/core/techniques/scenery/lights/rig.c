#include "tests/core/techniques/scenery/lights/rig.h"

#include <stdlib.h>
#include <string.h>

#include "kernels/dialect/rng.h"

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

// Corner k has the high x, y or z if bit 0, 1 or 2 of k is set.
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

// Clips a ray to a slab of one axis.
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

bool rig_is_blocked(struct vec from, struct vec to)
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

// --- the lights ---

const struct scenery_lights_settings rig_bounds = {
    .low_m = {-20, -1, -20}, .high_m = {20, 9, 20}, .shadows = true, .shadow_map_px = MAP_PX};

const struct rg_light rig_lights[LIGHTS] = {
    {.kind = SCENERY_SUN,
     .direction = {-0.48f, -0.64f, 0.6f},
     .colour = {1, 2, 3},
     .shadows = true},
    {.kind = SCENERY_SPOT,
     .position_m = {9, 8, 11},
     .direction = {-0.6f, -0.48f, -0.64f},
     .colour = {30, 20, 10},
     .inner_deg = 20,
     .outer_deg = 50,
     .near_m = 0.1f,
     .shadows = true},
    {.kind = SCENERY_POINT,
     .position_m = {-0.5f, 5.5f, 4},
     .colour = {9, 8, 7},
     .near_m = 0.1f,
     .shadows = true},
    {.kind = SCENERY_SUN, .direction = {0, -1, 0}, .colour = {1, 1, 1}, .shadows = true},
    {.kind = SCENERY_SPOT,
     .position_m = {3, 6.5f, 0},
     .direction = {0, -1, 0},
     .colour = {5, 5, 5},
     .inner_deg = 0,
     .outer_deg = 60,
     .near_m = 0.3f,
     .shadows = true},
    {.kind = SCENERY_POINT, .position_m = {10, 2, 0}, .colour = {1, 1, 1}},
};

struct vec rig_place_of(const struct rg_light *light)
{
    return (struct vec){(double)light->position_m[0], (double)light->position_m[1],
                        (double)light->position_m[2]};
}

struct vec rig_way_of(const struct rg_light *light)
{
    return (struct vec){(double)light->direction[0], (double)light->direction[1],
                        (double)light->direction[2]};
}

bool rig_is_in_cone(const struct rg_light *light, struct vec at)
{
    const struct vec off = minus(at, rig_place_of(light));
    return light->kind != SCENERY_SPOT ||
           dot(off, rig_way_of(light)) > length(off) * cos((double)light->outer_deg * degree);
}

// --- on a device ---

// Culls faces that turn away: a mirroring matrix would cull the wrong ones.
bool rig_draw_scene(void *user, const float to_clip[16], const struct rg_draw *onto)
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

struct rig rig_open(struct rg_device *device)
{
    struct rig rig = {.device = device};
    struct scenery_lights lights = {.count = LIGHTS};
    for (int i = 0; i < LIGHTS; i++) {
        const bool casts = rig_lights[i].shadows;
        lights.world[i] = scenery_light_of(&rig_lights[i], rig_bounds.low_m, rig_bounds.high_m,
                                           MAP_PX, casts ? lights.map_count : -1);
        lights.map_count += casts ? lights.world[i].shadow_faces : 0;
    }
    struct faces faces = make_boxes();
    faces_upload(device, &faces, &rig.scene);
    faces_free(&faces);
    rig.layers = lights.map_count;
    lights.shadows = rig.maps = rg_image_create(
        device, &(struct rg_image_desc){RG_D32F, MAP_PX, MAP_PX, rig.layers, 1}, "maps");
    assert_true(rig.maps && scenery_lights_shade(&lights, rig_draw_scene, &rig));
    memcpy(rig.lights, lights.world, sizeof(rig.lights));
    return rig;
}

void rig_close(struct rig *rig)
{
    faces_close(&rig->scene);
    rg_image_destroy(rig->maps);
}

test_streaks_lit *rig_light_points(const struct rig *rig, const scenery_light *lights, int count,
                                   const float *points, int point_count)
{
    const int64_t out_bytes = (int64_t)count * point_count * (int64_t)sizeof(test_streaks_lit);
    struct rg_buf *in = rg_buf_create_with(rig->device, points, point_count * 12ll, "points"),
                  *by = rg_buf_create_with(rig->device, lights, count * (int64_t)sizeof(*lights),
                                           "lights"),
                  *out = rg_buf_create(rig->device, out_bytes, "lit");
    struct rg_pass *pass = rg_pass_create(rig->device, "test_scenery_lights");
    const test_scenery_lights_params p = {.points = point_count};
    test_streaks_lit *lit = malloc((size_t)out_bytes);
    assert_true(
        in && by && out &&
        rg_pass_run(pass,
                    &(struct rg_run){
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

float *rig_make_points(void)
{
    float *points = malloc(POINTS * 3 * sizeof(float));
    for (uint32_t i = 0; i < POINTS; i++) {
        points[3 * i] = (float)(38 * uniform(i, 0) - 19);
        points[3 * i + 1] = (float)(9 * uniform(i, 1));
        points[3 * i + 2] = (float)(38 * uniform(i, 2) - 19);
    }
    return points;
}

struct vec rig_point_at(const float *points, int i)
{
    return (struct vec){(double)points[3 * i], (double)points[3 * i + 1],
                        (double)points[3 * i + 2]};
}
