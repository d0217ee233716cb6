// The scene that rain falls on, the city or a user's mesh, as one instance draws it; large data is
// shared by all instances on the device.
//
// Faces are grouped in chunks; a draw skips chunks that are outside the view, whose faces all turn
// away, or that buildings hide. Faces write their surface's number into each pixel; then every
// pixel is lit once (kernels/scenery/city.h, kernels/scenery/city_shade.h).
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
// and one logged line, on failure. Call scenery_close before the instance's assets are freed.
struct scenery *scenery_open(struct rg_instance *instance, const struct scenery_settings *settings);
void scenery_close(struct scenery *scene);

// Name, faces, bounds, hash and boxes of the scene, for as long as it lives.
const struct city *scenery_city(const struct scenery *scene);
// The scene's lamps, none for a user's mesh; returns their number.
int scenery_lamps(const struct scenery *scene, const struct city_lamp **lamps);
// The surfaces' words (kernels/scenery/surface.h), for kernels.
struct rg_buf *scenery_surfaces(const struct scenery *scene);

// Makes the scene's lights for a camera, with their shadow maps drawn. Lamps, the place near which
// they are chosen, and bounds are the scene's, whatever the settings say. NULL, and one logged
// line, on failure; close them with scenery_lights_close.
struct scenery_lights *scenery_lit(struct scenery *scene, struct rg_device *device,
                                   const struct scenery_lights_settings *settings,
                                   const struct rg_camera *camera);

// The scene's look at a time of day.
struct scenery_look {
    scenery_sky sky;
    float ambient; // share of the sky's light at surfaces that see the whole sky
    float bounced; // share of the horizon's light at surfaces that see no sky
    float glow;    // light of lit windows
    float wet;     // wetness of the ground, 0 to 1
};
// Overcast day, or night with the lights of the city.
struct scenery_look scenery_day(void);
struct scenery_look scenery_night(void);

// The draw targets for colour and depth: level 0, layer 0 of both, of one size.
struct scenery_view {
    m4 to_clip; // from the world, as rg_camera_matrix makes it: it must not mirror faces
    float eye[3];
    struct rg_image *colour, *depth; // RGBA16F; D32F
    bool everything; // also draws invisible chunks, which changes no pixel: for tests
};

// Draws colour and depth in this light, whose shadow maps are drawn already. If `geometry` is
// false, draws an even sky as bright as the horizon, and depth 1. The images need no clearing.
bool scenery_draw(struct scenery *scene, const struct scenery_view *view,
                  const struct scenery_look *look, const struct scenery_lights *lights,
                  bool geometry);
// Draws depth alone, of both sides of faces, into the image and layer of `onto`, which must be
// cleared before.
bool scenery_depth(struct scenery *scene, m4 to_clip, const struct rg_draw *onto);
// The same, and writes each pixel's surface number into onto->colour, an image of RGBA8.
bool scenery_numbers(struct scenery *scene, m4 to_clip, const struct rg_draw *onto);

// The work of the last draw.
struct scenery_work {
    int chunks_drawn, chunks;
    int blocks; // of SCENERY_BLOCK_FACES faces
};
struct scenery_work scenery_last(const struct scenery *scene);

#endif
