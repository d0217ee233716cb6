// For tests of the city's pictures: the small city with lights and a target on a device, and rays
// through places of a picture.
#ifndef RG_TESTS_CORE_TECHNIQUES_SCENERY_CITY_STAGE_H
#define RG_TESTS_CORE_TECHNIQUES_SCENERY_CITY_STAGE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "core/techniques/scenery/scenery.h"
#include "tests/core/techniques/rigs/scene.h"
#include "tests/oracle/scenery/scene.h"

enum { WIDTH = 160, HEIGHT = 90, VIEWS = 6 };

struct stage {
    struct rg_instance instance;
    struct scenery *scene;
    struct scenery_lights *lights;
    struct rg_image *colour, *depth;
};

struct stage_settings {
    const char *model; // NULL: the small city
    enum scenery_time time;
    int lights;
    bool unshadowed;
    bool whole; // the whole city instead of the small one
    bool bare;  // cannot be lit
};

// The caller closes the stage.
void stage_open(struct rg_device *device, const struct stage_settings *settings,
                struct stage *stage);
void stage_close(struct stage *stage);

struct picture {
    uint32_t colour[WIDTH * HEIGHT * 2], depth[WIDTH * HEIGHT];
};
void stage_draw(struct stage *stage, const struct rg_camera *camera,
                const struct scenery_look *look, bool everything, struct picture *picture);

// A pixel's red (0), green or blue light, or its alpha.
double stage_light(const struct picture *picture, int pixel, int c);

// Views of the streets, from roofs, along a wall and of a single tower: position and target.
extern const float stage_views[VIEWS][2][3];
struct rg_camera stage_camera(const float position[3], const float target[3]);

// The way to a place of the picture, in pixels, that is 1 m ahead; not of unit length.
void stage_ray(const struct rg_camera *camera, double px, double py, double way[3]);
// The scene's faces, for rays.
struct scene stage_faces(const struct stage *stage);

#endif
