// The scene that rain falls on: the city, or a user's mesh in its place, as one instance draws it;
// what is large is shared by all instances on the device.
//
// Its faces lie in chunks; a draw leaves out chunks that the view does not touch, whose faces all
// turn away, or that buildings hide. Faces leave the number of their surface in each pixel; then
// every pixel is lit once (kernels/scenery/city.h, kernels/scenery/city_shade.h).
#ifndef RG_CORE_TECHNIQUES_SCENERY_SCENERY_H
#define RG_CORE_TECHNIQUES_SCENERY_SCENERY_H

#include "core/scene/city/city.h"
#include "core/techniques/scenery/lights/lights.h"
#include "core/techniques/scenery/settings.h"
#include "core/techniques/technique.h"
#include "kernels/dialect/matrix.h"
#include "kernels/scenery/sky.h"

struct scenery;

// Adds the scene's assets and stages to an instance, under names that begin with "scene.". NULL,
// and one logged line, on failure. scenery_close when it is no longer needed, before the instance's
// assets go.
struct scenery *scenery_open(struct rg_instance *instance, const struct scenery_settings *settings);
void scenery_close(struct scenery *scene);

// What it is: name, faces, bounds, hash, boxes. It lives as long as the scene.
const struct city *scenery_city(const struct scenery *scene);
// Its lamps, none on a user's mesh; returns how many.
int scenery_lamps(const struct scenery *scene, const struct city_lamp **lamps);
// The surfaces' words (kernels/scenery/surface.h), for kernels.
struct rg_buf *scenery_surfaces(const struct scenery *scene);

// The scene's lights for a camera, their shadow maps drawn: settings without the lamps, the place
// that these are chosen near and the bounds, which are the scene's. NULL, and one logged line, on
// failure; scenery_lights_close later.
struct scenery_lights *scenery_lit(struct scenery *scene, struct rg_device *device,
                                   const struct scenery_lights_settings *settings,
                                   const struct rg_camera *camera);

// How it looks at a time.
struct scenery_look {
    scenery_sky sky;
    float ambient; // the share of the sky's light that reaches surfaces which see all of the sky
    float bounced; // the share of the horizon's light that reaches those which see no sky
    float glow;    // light of lit windows
    float wet;     // 0 to 1: how wet the ground is
};
// Overcast day, or night with the lights of the city.
struct scenery_look scenery_day(void);
struct scenery_look scenery_night(void);

// Where colour and depth go: level 0, layer 0 of both, of one size.
struct scenery_view {
    m4 to_clip; // from the world, as rg_camera_matrix makes it: faces keep their turn
    float eye[3];
    struct rg_image *colour, *depth; // RGBA16F; D32F
    bool everything; // chunks that cannot be seen are drawn too, which changes no pixel: for tests
};

// Draws colour and depth in this light, whose shadow maps are drawn already; with `geometry` false,
// an even sky as bright as the horizon, and depth 1. The images need not be cleared.
bool scenery_draw(struct scenery *scene, const struct scenery_view *view,
                  const struct scenery_look *look, const struct scenery_lights *lights,
                  bool geometry);
// Draws depth alone, of both sides of faces: `onto` names the image and its layer. It is not
// cleared.
bool scenery_depth(struct scenery *scene, m4 to_clip, const struct rg_draw *onto);
// The same, and the number of each pixel's surface into onto->colour, an image of RGBA8.
bool scenery_numbers(struct scenery *scene, m4 to_clip, const struct rg_draw *onto);

// What the last draw left out, of how many.
struct scenery_work {
    int chunks_drawn, chunks;
    int blocks; // of SCENERY_BLOCK_FACES faces
};
struct scenery_work scenery_last(const struct scenery *scene);

#endif
