// For tests of streaks' lights: boxes over a floor with all kinds of light around them, and the
// light at points in the air on a device.
#ifndef RG_TESTS_CORE_TECHNIQUES_SCENERY_LIGHTS_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_SCENERY_LIGHTS_RIG_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

#include "core/techniques/scenery/lights/lights.h"
#include "tests/core/techniques/rigs/scene.h"
#include "tests/kernels/scenery_lights_params.h"

enum { POINTS = 6000, MAP_PX = 512, LIGHTS = 6, UNSHADOWED = LIGHTS - 1 };
static const double degree = 3.14159265358979323846 / 180;

struct vec {
    double x, y, z;
};

static inline struct vec minus(struct vec a, struct vec b)
{
    return (struct vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline struct vec along(struct vec a, double s, struct vec b)
{
    return (struct vec){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static inline double length(struct vec a)
{
    return sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

static inline double dot(struct vec a, struct vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// All kinds of light, with plain cases last: straight down, along an axis. The last casts no
// shadow.
extern const struct rg_light rig_lights[LIGHTS];
extern const struct scenery_lights_settings rig_bounds; // of the boxes, with shadow maps of MAP_PX

struct vec rig_place_of(const struct rg_light *light);
struct vec rig_way_of(const struct rg_light *light);
// Whether a box is between two points.
bool rig_is_blocked(struct vec from, struct vec to);
// Whether a point is in a spot's cone; true for other lights.
bool rig_is_in_cone(const struct rg_light *light, struct vec at);

// The boxes and the lights on a device, with their shadow maps drawn.
struct rig {
    struct rg_device *device;
    struct faces_on scene;
    struct rg_image *maps;
    int layers;
    scenery_light lights[LIGHTS];
};
struct rig rig_open(struct rg_device *device);
void rig_close(struct rig *rig);
// Draws the boxes of the rig `user`, for scenery_lights_shade.
bool rig_draw_scene(void *user, const float to_clip[16], const struct rg_draw *onto);

// POINTS places in the air, three floats each; the caller frees them.
float *rig_make_points(void);
struct vec rig_point_at(const float *points, int i);
// The effect of `count` lights at `points`, by light, then point. The caller frees it.
test_streaks_lit *rig_light_points(const struct rig *rig, const scenery_light *lights, int count,
                                   const float *points, int point_count);

#endif
