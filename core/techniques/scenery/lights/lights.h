// The lights of a scene: choosing them, their data for kernels, and their shadow maps.
// docs/lights.md explains.
#ifndef RG_CORE_TECHNIQUES_SCENERY_LIGHTS_LIGHTS_H
#define RG_CORE_TECHNIQUES_SCENERY_LIGHTS_LIGHTS_H

#include "core/device/device.h"
#include "core/scene/city/city.h"
#include "core/scene/light_file.h"

enum scenery_time { SCENERY_DAY, SCENERY_NIGHT };
enum { SCENERY_USUAL_LIGHTS = -1 };

struct scenery_lights_settings {
    const char *file; // the user's lights, which replace all others; NULL or "": none
    // Without a file: the number of lights, 0 to 16; by day a sun and lamps, by night lamps and a
    // moon. SCENERY_USUAL_LIGHTS: a sun by day, and by night as many as there are.
    int count;
    enum scenery_time time;
    const struct city_lamp *lamps; // the scene's lamps; the caller owns them
    int lamp_count;
    float about_m[3]; // lamps nearest to this place are chosen first
    // Shadows.
    bool shadows;
    int shadow_map_px;         // width and height of a map
    float low_m[3], high_m[3]; // the scene's bounds, of positive volume
    float world_to_frame[16];  // row by row, a rotation and translation to the technique's frame
};

struct scenery_lights {
    int count;
    scenery_light world[SCENERY_MAX_LIGHTS]; // in the world
    float sky[3];                            // linear: light that comes equally from everywhere
    struct rg_buf *in_world, *in_frame;      // at least one scenery_light each, `count` used
    struct rg_image *shadows;                // D32F: all maps; one texel where there are none
    int map_count;                           // number of layers drawn
};

// Makes the lights, with empty maps. NULL, and one logged line, on failure.
struct scenery_lights *scenery_lights_open(struct rg_device *device,
                                           const struct scenery_lights_settings *settings);
void scenery_lights_close(struct scenery_lights *lights);

// Draws the depth of shadow casters onto a layer of an image, with a matrix from the world to clip
// space, which does not mirror faces.
typedef bool (*scenery_depth_fn)(void *user, const float to_clip[16], const struct rg_draw *onto);
// Draws all shadow maps; call it again when the scene has changed.
bool scenery_lights_shade(struct scenery_lights *lights, scenery_depth_fn draw, void *user);

// --- the steps of scenery_lights_open ---

// Chooses lights by the settings. False, and one logged line, where the file is invalid or the
// scene has too few lamps.
bool scenery_lights_choose(const struct scenery_lights_settings *settings,
                           struct rg_lights *lights);
// A light's data for kernels, in world coordinates; its shadow layers begin at `layer`, -1: no
// shadows.
scenery_light scenery_light_of(const struct rg_light *light, const float low_m[3],
                               const float high_m[3], int map_px, int layer);
// The same light in another frame; `matrix` is a rotation and translation to it.
scenery_light scenery_light_moved(const scenery_light *light, const float matrix[16]);
// The matrix from the light's frame to clip space, for face 0 .. shadow_faces - 1 of its map.
void scenery_light_to_clip(const scenery_light *light, int face, float matrix[16]);

#endif
