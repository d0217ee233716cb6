// The depth map: the scene seen along the fall, which shows where drops hit (Creus, sections 4.2
// and 4.4.2). If splashes need it, the map also has the number of the surface there.
//
// A static map covers the rain space and is shared by instances on a device that need the same one.
// A dynamic map covers the surroundings of the observer.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/device/shared.h"
#include "core/scene/matrix.h"
#include "core/techniques/streaks/instance.h"

static bool is_around(const struct streaks *s)
{
    return s->settings.dynamic_map && s->settings.limits;
}

static void set_extent(struct streaks *s)
{
    streaks_params *p = &s->params;
    const double radius_m = s->settings.culling_radius_m;
    const bool around = is_around(s);
    p->around = around;
    p->map_x = (float)(around ? (double)p->eye_x - radius_m : -s->space.half_x_m);
    p->map_y = (float)(around ? (double)p->eye_y - radius_m : -s->space.half_y_m);
    p->map_per_x = (float)(0.5 / (around ? radius_m : s->space.half_x_m));
    p->map_per_y = (float)(0.5 / (around ? radius_m : s->space.half_y_m));
    p->map_top = 0;
    p->map_height = (float)s->space.height_m;
    p->ground = (float)s->space.height_m;
    p->narrowing = (float)streaks_narrowing(s);
}

// The matrix from the rain frame to the map's clip space: rows run along y, depth along s. w is 1
// on the ground.
static m4 matrix_of(const struct streaks *s)
{
    const streaks_params *p = &s->params;
    float to_map[16] = {0}, world_to_rain[16];
    to_map[0] = 2 * p->map_per_x;
    to_map[3] = -2 * p->map_per_x * p->map_x - 1;
    to_map[5] = 2 * p->map_per_y;
    to_map[7] = -2 * p->map_per_y * p->map_y - 1;
    to_map[10] = 1 / p->map_height;
    to_map[11] = -p->map_top / p->map_height;
    to_map[14] = p->narrowing;
    to_map[15] = 1 - p->narrowing * p->map_height;
    rg_rain_matrices(&s->space, world_to_rain, NULL);
    rg_matrix_multiply(to_map, world_to_rain, to_map);
    return rg_m4_of(to_map);
}

static bool is_numbered(const struct streaks *s)
{
    return s->settings.splash_materials || !s->settings.splashes_upright;
}

static const uint32_t no_surface = SCENERY_NO_SURFACE;
static const float farthest = 1;

static bool draw(struct streaks *s, const struct streaks_map *map)
{
    const struct rg_draw onto = {
        .colour = map->numbers, .depth = map->depths, .depth_mode = RG_DEPTH_WRITE};
    if (!rg_image_clear(map->depths, &farthest))
        return false;
    if (!is_numbered(s))
        return scenery_depth(s->scene, matrix_of(s), &onto);
    return rg_image_clear(map->numbers, &no_surface) &&
           scenery_numbers(s->scene, matrix_of(s), &onto);
}

static void destroy(void *thing)
{
    struct streaks_map *map = thing;
    if (!map)
        return;
    rg_image_destroy(map->depths);
    rg_image_destroy(map->numbers);
    free(map);
}

static struct streaks_map *create(const struct streaks *s)
{
    struct streaks_map *map = rg_alloc(1, sizeof(*map), "depth map");
    const int side_px = s->settings.map_px, numbers_px = is_numbered(s) ? side_px : 1;
    const struct rg_image_desc depths = {RG_D32F, side_px, side_px, 1, 1};
    const struct rg_image_desc numbers = {RG_RGBA8, numbers_px, numbers_px, 1, 1};
    if (map &&
        (map->depths = rg_image_create_with(s->base.device, &depths, &farthest, "depth map")) &&
        (map->numbers = rg_image_create_with(s->base.device, &numbers, &no_surface,
                                             "map of surfaces' numbers")))
        return map;
    destroy(map);
    return NULL;
}

// --- the static map, which instances share ---

static void *make(struct rg_device *device, const void *arg)
{
    (void)device;
    struct streaks *const *s = arg;
    struct streaks_map *map = create(*s);
    if (map && draw(*s, map))
        return map;
    destroy(map);
    return NULL;
}

static const struct rg_shared_kind kind = {.name = "depth map", .make = make, .destroy = destroy};

// The static map's key must hold everything that decides its contents.
static struct streaks_map *get_static(struct streaks *s)
{
    const struct rg_rain_space *space = &s->space;
    const double numbers[] = {space->origin_m[0],  space->origin_m[1], space->origin_m[2],
                              space->s[0],         space->s[1],        space->s[2],
                              space->half_x_m,     space->half_y_m,    space->height_m,
                              streaks_narrowing(s)};
    char key[400];
    int length = snprintf(key, sizeof(key), "%016" PRIx64 " %d %d", scenery_city(s->scene)->hash,
                          s->settings.map_px, is_numbered(s));
    for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++)
        length += snprintf(key + length, sizeof(key) - (size_t)length, " %a", numbers[i]);
    return rg_shared_get(s->base.device, key, &kind, &s);
}

bool streaks_map_open(struct streaks *s)
{
    set_extent(s);
    s->map = s->settings.dynamic_map ? create(s) : get_static(s);
    return s->map;
}

void streaks_map_close(struct streaks *s)
{
    if (s->settings.dynamic_map)
        destroy(s->map);
    else
        rg_shared_put(s->base.device, s->map);
}

bool streaks_map_renew(struct streaks *s)
{
    if (!s->settings.dynamic_map || s->base.frame < s->map_due)
        return true;
    s->map_due = s->base.frame + s->settings.map_period;
    set_extent(s);
    return draw(s, s->map);
}
