// Splashes by the surface that is hit: materials DEVICE. Devices' materials against faces seen
// along the fall, in double precision and without kernels/; and their effect on pictures.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/techniques/streaks/instance.h"
#include "tests/core/techniques/rigs/scene.h"
#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"

enum { WIDTH = 96, HEIGHT = 54, HALVES = WIDTH * HEIGHT * 4, MAP_PX = 1024 };
enum { FILM, PUDDLE, ROUGH, SMOOTH, MATERIALS };

// Rain over the middle of the small city, from the streets to the roofs.
#define SMALL                                                                                      \
    "atlas=small city=small depth_map_px=1024 shadow_map_px=16 rain_width_m=160 rain_depth_m=160 " \
    "camera=free eye_y_m=35 target_y_m=20 local_height_m=70 culling_radius_m=75 drops_m2_s=12 "    \
    "spectrum=off splash_gain=4 state=on "

static struct streaks *open_rain(struct rg_device *device, const char *settings)
{
    const struct rg_technique *technique = rg_technique_find("streaks");
    char all[1024];
    snprintf(all, sizeof(all), SMALL "%s", settings);
    void *defaults = rg_settings_create(technique);
    void *copy = rg_settings_copy(technique, defaults, all);
    assert_non_null(copy);
    struct rg_instance *instance = rg_instance_open(technique, device, copy, WIDTH, HEIGHT);
    assert_non_null(instance);
    free(copy);
    free(defaults);
    assert_true(technique->step(instance));
    return (struct streaks *)instance;
}

static void close_rain(struct streaks *s)
{
    rg_instance_close(&s->base);
}

// --- faces seen along the fall ---

// A face in the rain frame: x and y across the fall, s along it.
struct hit_face {
    double corners[12], low[2], high[2];
    int material;
};
struct hit_faces {
    int count;
    struct hit_face *faces;
    double height; // s of the ground plane
};

// By the table of docs/streaks.md, in the order of kinds.
static int material_of(uint32_t look)
{
    static const int of_kinds[] = {ROUGH,  SMOOTH, PUDDLE, FILM,   FILM,
                                   SMOOTH, ROUGH,  SMOOTH, PUDDLE, SMOOTH};
    return of_kinds[look / 256 % 16];
}

static struct hit_face face_of(const struct streaks *s, const struct city_faces *from, int i)
{
    struct hit_face f = {.low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
    f.material = material_of(from->surfaces[4 * from->surface_of[i] + 3]);
    for (int k = 0; k < 12; k += 3) {
        const float *corner = from->corners + (size_t)i * 12 + k;
        const double world[3] = {(double)corner[0], (double)corner[1], (double)corner[2]};
        rg_rain_point(&s->space, world, f.corners + k);
        for (int c = 0; c < 2; c++) {
            f.low[c] = fmin(f.low[c], f.corners[k + c]);
            f.high[c] = fmax(f.high[c], f.corners[k + c]);
        }
    }
    return f;
}

static struct hit_faces faces_of(const struct streaks *s)
{
    const struct city_faces *from = &scenery_city(s->scene)->faces;
    struct hit_faces f = {from->face_count,
                          malloc((size_t)from->face_count * sizeof(struct hit_face)),
                          s->space.height_m};
    assert_non_null(f.faces);
    for (int i = 0; i < f.count; i++)
        f.faces[i] = face_of(s, from, i);
    return f;
}

// Whether a line along the fall meets a triangle, and at which s.
static bool meets(const double *a, const double *b, const double *c, double x, double y, double *s)
{
    const double *const p[3] = {a, b, c};
    double side[3], all = 0, sum = 0;
    for (int j = 0; j < 3; j++) {
        const double *from = p[(j + 1) % 3], *to = p[(j + 2) % 3];
        side[j] = (from[0] - x) * (to[1] - y) - (to[0] - x) * (from[1] - y);
        all += side[j];
        sum += side[j] * p[j][2];
    }
    *s = fabs(all) > 1e-9 ? sum / all : -1;
    return *s >= 0 && ((side[0] >= 0 && side[1] >= 0 && side[2] >= 0) ||
                       (side[0] <= 0 && side[1] <= 0 && side[2] <= 0));
}

static bool is_near(const struct hit_face *f, double x, double y)
{
    return x >= f->low[0] && x <= f->high[0] && y >= f->low[1] && y <= f->high[1];
}

// The materials of the first faces met, one bit each: several if faces overlap. The ground plane,
// and everything below it, has a film.
static int met_first(const struct hit_faces *f, double x, double y)
{
    const double same = 2e-3;
    double first = f->height - same;
    int materials = 1 << FILM;
    for (int i = 0; i < f->count; i++) {
        const double *c = f->faces[i].corners;
        for (int k = 0; k < 2 && is_near(&f->faces[i], x, y); k++) {
            double s;
            if (!meets(c, c + 3 + 3 * k, c + 6 + 3 * k, x, y, &s) || s > first + same)
                continue;
            materials = (s < first - same ? 0 : materials) | 1 << f->faces[i].material;
            first = fmin(first, s);
        }
    }
    return materials;
}

// The place of a map in the rain frame.
struct extent {
    double x, y, wide_x, wide_y;
};

static struct extent extent_of(const struct streaks *s, bool around)
{
    double eye[3];
    rg_rain_eye(&s->space, &s->observer.camera, eye);
    const double r = s->settings.culling_radius_m, x = s->space.half_x_m, y = s->space.half_y_m;
    return around ? (struct extent){eye[0] - r, eye[1] - r, 2 * r, 2 * r}
                  : (struct extent){-x, -y, 2 * x, 2 * y};
}

// Whether the map's texel under a place shows a material. An edge may be on either side of the
// texel's centre, by the grid of 1/256 texel.
static bool shows(const struct hit_faces *f, const struct extent *map, double u, double v,
                  int material)
{
    static const double beside[][2] = {{0, 0}, {0.01, 0}, {-0.01, 0}, {0, 0.01}, {0, -0.01}};
    bool shown = false;
    for (int k = 0; k < 5 && !shown; k++)
        shown = met_first(f, map->x + (floor(u) + 0.5 + beside[k][0]) / MAP_PX * map->wide_x,
                          map->y + (floor(v) + 0.5 + beside[k][1]) / MAP_PX * map->wide_y) >>
                    material &
                1;
    return shown;
}

// --- materials on devices ---

// The device's count of particles over each material, both drops and splashes.
static void count_materials(const struct streaks *s, int counts[MATERIALS])
{
    const struct rain_places places = rain_read_places(s);
    memset(counts, 0, MATERIALS * sizeof(*counts));
    for (int64_t i = 0; i < places.count; i++) {
        const float *place = places.words + i * STREAKS_STATE_WORDS;
        assert_between(place[6], 0, MATERIALS - 1);
        counts[(int)place[6]] += (int)place[5] != STREAKS_NOTHING;
    }
    free(places.words);
}

// The materials of the compared particles, and how many are outside the map.
struct compared {
    int counts[MATERIALS], outside;
};

static void compare_one(const struct hit_faces *faces, const struct extent *map, const float *place,
                        struct compared *all)
{
    const int material = (int)place[6];
    const double u = ((double)place[0] - map->x) / map->wide_x * MAP_PX;
    const double v = ((double)place[1] - map->y) / map->wide_y * MAP_PX;
    const bool outside = u < 0 || v < 0 || u > MAP_PX || v > MAP_PX;
    if (fabs(u - round(u)) < 1e-2 || fabs(v - round(v)) < 1e-2)
        return; // it may be in either texel
    if (!(outside ? material == FILM : shows(faces, map, u, v, material)))
        fail_msg("at %g %g: material %d", (double)place[0], (double)place[1], material);
    all->counts[material]++;
    all->outside += outside;
}

// Compares some particles with the scene's faces; those of a dynamic map are around the observer.
static struct compared compare(struct rg_device *device, const char *settings, bool around)
{
    enum { SOME = 2500 };
    struct streaks *s = open_rain(device, settings);
    struct hit_faces faces = faces_of(s);
    const struct extent map = extent_of(s, around);
    const struct rain_places places = rain_read_places(s);
    struct compared all = {{0}, 0};
    int64_t seen = 0;
    for (int64_t i = 0; i < places.count; i++)
        seen += (int)places.words[i * STREAKS_STATE_WORDS + 5] != STREAKS_NOTHING;
    assert_above(seen, SOME);
    for (int64_t i = 0, n = 0; i < places.count; i++) {
        const float *place = places.words + i * STREAKS_STATE_WORDS;
        if ((int)place[5] != STREAKS_NOTHING && n++ % (seen / SOME) == 0)
            compare_one(&faces, &map, place, &all);
    }
    free(places.words);
    free(faces.faces);
    close_rain(s);
    return all;
}

static void splashes_are_of_what_is_hit(void **state)
{
    const struct compared all = compare(*state, "splash_materials=on", false);
    for (int m = 0; m < MATERIALS; m++)
        assert_above(all.counts[m], 20);
}

static void a_dynamic_map_too(void **state)
{
    const struct compared all = compare(
        *state,
        "splash_materials=on depth_map=dynamic culling_radius_m=40 walk_m_s=900 slant_deg=25",
        true);
    assert_above(all.counts[FILM], 100);
    assert_above(all.counts[PUDDLE], 20);
    assert_int_equal(all.outside, 0); // outside the map it would fall through roofs
}

static void rain_that_leans_too(void **state)
{
    const struct compared all =
        compare(*state, "splash_materials=on slant_deg=25 slant_azimuth_deg=40", false);
    assert_above(all.counts[FILM], 100);
    assert_above(all.counts[PUDDLE], 20);
    assert_above(all.counts[SMOOTH], 20);
}

// A user's mesh is rough, and its ground is wet.
static void a_mesh_too(void **state)
{
    const struct compared all =
        compare(*state,
                "splash_materials=on scene=torus rain_width_m=420 rain_depth_m=420 drops_m2_s=1 "
                "local_height_m=200 culling_radius_m=200",
                false);
    assert_above(all.counts[FILM], 100);
    assert_above(all.counts[ROUGH], 100);
    assert_equals(all.counts[PUDDLE], 0);
    assert_equals(all.counts[SMOOTH], 0);
}

static void off_all_are_of_one(void **state)
{
    int counts[MATERIALS];
    struct streaks *s = open_rain(*state, "splash_materials=off splash_up=vertical");
    count_materials(s, counts);
    assert_above(counts[FILM], 1000);
    for (int m = 1; m < MATERIALS; m++)
        assert_int_equal(counts[m], 0);
    assert_int_equal(s->map->numbers->desc.width, 1); // a single texel: nothing is kept
    close_rain(s);
}

// Instances with and without surfaces share no map; instances with the same needs do.
static void maps_are_shared_by_what_they_hold(void **state)
{
    static const char *const ways[] = {"splash_materials=off splash_up=vertical",
                                       "splash_materials=on", "splash_materials=on",
                                       "splash_materials=off splash_up=vertical"};
    struct streaks *s[4];
    for (int i = 0; i < 4; i++)
        s[i] = open_rain(*state, ways[i]);
    assert_ptr_equal(s[0]->map, s[3]->map);
    assert_ptr_equal(s[1]->map, s[2]->map);
    assert_ptr_not_equal(s[0]->map, s[1]->map);
    for (int i = 0; i < 4; i++)
        close_rain(s[i]);
}

// --- materials in pictures ---

static void draw(struct streaks *s, uint16_t picture[HALVES])
{
    assert_true(s->base.technique->draw(&s->base));
    assert_true(rg_image_read(s->base.target, 0, 0, picture));
}

// Makes all crowns of a material blank.
static void blank(struct streaks *s, int material)
{
    const struct rg_image_desc *desc = &s->textures->crowns->desc;
    const int frames = desc->layers / MATERIALS;
    uint16_t *nothing = calloc((size_t)desc->width * (size_t)desc->height, sizeof(*nothing));
    assert_non_null(nothing);
    for (int frame = 0; frame < frames; frame++)
        for (int level = 0; level < desc->levels; level++)
            assert_true(
                rg_image_write(s->textures->crowns, material * frames + frame, level, nothing));
    free(nothing);
}

#define NEAR                                                                                       \
    "drops=off cull=exact culling_radius_m=2 drops_m2_s=300 local_height_m=8 rain_width_m=180 "    \
    "rain_depth_m=180 splash_gain=30 splash_opacity=30 "
#define STREET NEAR "eye_x_m=1 eye_y_m=3 eye_z_m=1 target_x_m=1 target_y_m=0 target_z_m=2 "
#define ROOF   NEAR "eye_x_m=-56 eye_y_m=73 eye_z_m=16 target_x_m=-56 target_y_m=70 target_z_m=17 "

// As faint as water is.
#define FAINT "splash_gain=4 splash_opacity=1 "

static void expect_only(const struct streaks *s, int material)
{
    int counts[MATERIALS];
    count_materials(s, counts);
    for (int m = 0; m < MATERIALS; m++)
        assert_true(m == material ? counts[m] > 20 : counts[m] == 0);
}

// If all surfaces have one material, its crowns are seen, and no others.
static void check_crowns(struct rg_device *device, const char *settings, int material)
{
    static uint16_t whole[HALVES], picture[HALVES];
    struct streaks *s = open_rain(device, settings);
    expect_only(s, material);
    draw(s, whole);
    for (int m = 0; m < MATERIALS; m++)
        if (m != material)
            blank(s, m);
    draw(s, picture);
    assert_memory_equal(picture, whole, sizeof(whole));
    blank(s, material);
    draw(s, picture);
    assert_memory_not_equal(picture, whole, sizeof(whole));
    memcpy(whole, picture, sizeof(whole));
    s->params.splashes = 0;
    draw(s, picture);
    assert_memory_equal(picture, whole, sizeof(whole));
    close_rain(s);
}

static void crowns_are_of_the_material(void **state)
{
    check_crowns(*state, STREET "splash_materials=on", FILM);
    check_crowns(*state, ROOF "splash_materials=on", PUDDLE);
    check_crowns(*state, ROOF "splash_materials=off", FILM);
    check_crowns(*state, STREET FAINT "splash_materials=on", FILM);
    check_crowns(*state, ROOF FAINT "splash_materials=on", PUDDLE);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(splashes_are_of_what_is_hit),
        cmocka_unit_test(a_dynamic_map_too),
        cmocka_unit_test(rain_that_leans_too),
        cmocka_unit_test(a_mesh_too),
        cmocka_unit_test(off_all_are_of_one),
        cmocka_unit_test(maps_are_shared_by_what_they_hold),
        cmocka_unit_test(crowns_are_of_the_material),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
