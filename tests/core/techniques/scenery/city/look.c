// Pixels of the city: look DEVICE. A model in double precision casts one ray a pixel. It has sky,
// textures, wet ground, openness to the sky, haze, and lights of each kind.
#include "tests/core/techniques/scenery/city/stage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/scenery/openness_grid.h"
#include "tests/oracle/vectors.h"
#include "tests/tools/expect.h"

// --- the oracle's inputs ---

// Levels of textures from the device, read when first needed.
struct texels {
    struct rg_image *image;
    uint32_t *levels[CITY_TEXTURES][16];
};

static uint32_t texel_of(void *user, int texture, int level, int x, int y)
{
    struct texels *t = user;
    const int size = t->image->desc.width >> level;
    uint32_t **texels = &t->levels[texture][level];
    if (!*texels) {
        *texels = malloc((size_t)size * (size_t)size * 4);
        assert_true(rg_image_read(t->image, texture, level, *texels));
    }
    return (*texels)[y * size + x];
}

struct given {
    struct scene scene;
    struct texels texels;
    uint32_t *openness;
    struct scene_light lights[SCENERY_MAX_LIGHTS];
};

static struct scene_light light_of(const scenery_light *l)
{
    return (struct scene_light){.kind = l->kind,
                                .place_m = {(double)l->x, (double)l->y, (double)l->z},
                                .way = {(double)l->dx, (double)l->dy, (double)l->dz},
                                .colour = {(double)l->r, (double)l->g, (double)l->b},
                                .cos_inner = (double)l->cos_inner,
                                .cos_outer = (double)l->cos_outer,
                                .texel_m = (double)l->shadow_texel};
}

static struct given *make_given(struct stage *stage, const struct scenery_look *look)
{
    struct given *g = calloc(1, sizeof(*g));
    const scenery_sky *sky = &look->sky;
    g->scene = stage_faces(stage);
    g->texels.image = rg_asset_find(&stage->instance, "scene.textures")->image;
    g->openness = malloc(SCENERY_OPEN_WORDS * sizeof(*g->openness));
    assert_true(city_openness(scenery_city(stage->scene), g->openness));
    for (int i = 0; i < stage->lights->count; i++)
        g->lights[i] = light_of(&stage->lights->world[i]);
    g->scene.openness = g->openness;
    g->scene.texel = texel_of;
    g->scene.user = &g->texels;
    g->scene.texture_px = g->texels.image->desc.width;
    g->scene.texture_levels = g->texels.image->desc.levels;
    const float zenith[3] = {sky->zenith_r, sky->zenith_g, sky->zenith_b},
                horizon[3] = {sky->horizon_r, sky->horizon_g, sky->horizon_b};
    for (int c = 0; c < 3; c++) {
        g->scene.zenith[c] = (double)zenith[c];
        g->scene.horizon[c] = (double)horizon[c];
    }
    g->scene.clouds = (double)sky->clouds;
    g->scene.haze_per_m = (double)sky->haze_per_m;
    g->scene.ambient = (double)look->ambient;
    g->scene.bounced = (double)look->bounced;
    g->scene.glow = (double)look->glow;
    g->scene.wet = (double)look->wet;
    g->scene.light_count = stage->lights->count;
    g->scene.lights = g->lights;
    return g;
}

static void free_given(struct given *g)
{
    for (int i = 0; i < CITY_TEXTURES; i++)
        for (int level = 0; level < 16; level++)
            free(g->texels.levels[i][level]);
    free(g->openness);
    free(g);
}

// --- pixels ---

struct tally {
    int compared, sky, shadowed, unsure, edges, off;
    double worst, drawn, due;
};

// A pixel is on an edge if a place beside its centre shows another surface. The edge may be on
// either side of the centre.
static bool on_edge(const struct scene *scene, const double from[3], const struct rg_camera *camera,
                    double x, double y)
{
    int first = -2;
    for (int k = 0; k < 4; k++) {
        double way[3], distance;
        stage_ray(camera, x + (k & 1 ? 0.02 : -0.02), y + (k & 2 ? 0.02 : -0.02), way);
        const int face = scene_meet(scene, from, way, false, &distance);
        const int surface = face < 0 ? -1 : (int)scene->surface_of[face];
        if (first != -2 && surface != first)
            return true;
        first = surface;
    }
    return false;
}

static void compare_pixel(const struct given *g, const struct rg_camera *camera,
                          const struct picture *picture, int pixel, struct tally *tally)
{
    const double from[3] = {(double)camera->position[0], (double)camera->position[1],
                            (double)camera->position[2]};
    const double x = pixel % WIDTH + 0.5, y = (int)(pixel / WIDTH) + 0.5;
    const double pixel_m = 2 * tan((double)camera->angle_deg * 3.141592653589793 / 360) / HEIGHT;
    double way[3];
    if (on_edge(&g->scene, from, camera, x, y)) {
        tally->edges++;
        return;
    }
    stage_ray(camera, x, y, way);
    const double ahead = sqrt(dot(way, way));
    make_unit(way);
    const struct scene_pixel due = scene_see(&g->scene, from, way, pixel_m, ahead);
    if (due.unsure) {
        tally->unsure++;
        return;
    }
    double off = 0, bright = 0;
    for (int c = 0; c < 3; c++) {
        off = fmax(off, fabs(stage_light(picture, pixel, c) - due.light[c]) - due.slack[c]);
        bright = fmax(bright, due.light[c]);
        tally->drawn += stage_light(picture, pixel, c);
        tally->due += due.light[c];
    }
    tally->compared++;
    tally->sky += due.sky;
    tally->shadowed += due.shadowed;
    tally->off += off > 0.01 * bright;
    tally->worst = fmax(tally->worst, off / bright);
}

struct look_case {
    struct stage_settings stage;
    int every;    // every n-th pixel
    int compared; // at least this many
    int shadowed;
};

static void compare_view(struct stage *stage, const struct given *g,
                         const struct scenery_look *look, const struct rg_camera *camera, int every,
                         struct tally *tally)
{
    struct picture *picture = malloc(sizeof(*picture));
    stage_draw(stage, camera, look, false, picture);
    for (int i = every / 2; i < WIDTH * HEIGHT; i += every)
        compare_pixel(g, camera, picture, i, tally);
    free(picture);
}

// So near to the first face of a kind that the face fills most of the picture.
static struct rg_camera before(const struct scene *scene, uint32_t kind, float distance_m)
{
    for (int i = 0; i < scene->face_count; i++) {
        const float *c = scene->corners + (size_t)i * SCENERY_FACE_WORDS;
        const uint32_t *words =
            scene->surfaces + (size_t)scene->surface_of[i] * SCENERY_SURFACE_WORDS;
        const v3 n = mesh_normal_unpack(words[SCENERY_NORMAL]);
        if (scenery_kind(words[SCENERY_LOOK]) != kind || fabsf(n.y) > 0.5f)
            continue;
        const float from[3] = {c[0] + distance_m * n.x, c[1] + distance_m * n.y,
                               c[2] + distance_m * n.z};
        return stage_camera(from, c);
    }
    fail_msg("no face of kind %u", kind);
    return city_first_camera;
}

// The views of all tests, then leaves, which alone have a tint, and a glowing lamp.
static struct rg_camera camera_of(const struct scene *scene, int view)
{
    if (view < VIEWS)
        return stage_camera(stage_views[view][0], stage_views[view][1]);
    return view == VIEWS ? before(scene, SCENERY_KIND_LEAVES, 5)
                         : before(scene, SCENERY_KIND_LIGHT, 0.7f);
}

static void compare(struct rg_device *device, const struct look_case *c)
{
    struct stage stage;
    struct tally tally = {0};
    const struct scenery_look look = c->stage.time == SCENERY_DAY ? scenery_day() : scenery_night();
    stage_open(device, &c->stage, &stage);
    struct given *g = make_given(&stage, &look);
    g->scene.shadows = !c->stage.unshadowed;
    for (int view = 0; view < VIEWS + 2; view++) {
        const struct rg_camera camera = camera_of(&g->scene, view);
        compare_view(&stage, g, &look, &camera, c->every, &tally);
    }
    print_message("%d pixels, %d of sky, %d in shadow; %d on edges, %d unsure; %d off, worst %.3f "
                  "%%, bias %.3f %%\n",
                  tally.compared, tally.sky, tally.shadowed, tally.edges, tally.unsure, tally.off,
                  100 * tally.worst, 100 * (tally.drawn / tally.due - 1));
    assert_above(tally.compared, c->compared);
    assert_at_least(tally.shadowed, c->shadowed);
    assert_at_most(tally.off * 200, tally.compared);
    assert_below(fabs(tally.drawn / tally.due - 1), 0.002);
    free_given(g);
    stage_close(&stage);
}

static void by_day(void **state)
{
    compare(*state, &(struct look_case){{.lights = 1, .unshadowed = true}, 97, 800, 0});
}

static void by_night_under_lamps(void **state)
{
    compare(*state, &(struct look_case){
                        {.time = SCENERY_NIGHT, .lights = 7, .unshadowed = true}, 97, 800, 0});
}

static void in_shadow(void **state)
{
    compare(*state, &(struct look_case){{.lights = 4}, 307, 200, 20});
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_day),
        cmocka_unit_test(by_night_under_lamps),
        cmocka_unit_test(in_shadow),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
