// The lights of a scene: which there are, what kernels read of them, and their shadow maps.
// docs/lights.md explains.
#ifndef RG_CORE_TECHNIQUES_SCENERY_LIGHTS_LIGHTS_H
#define RG_CORE_TECHNIQUES_SCENERY_LIGHTS_LIGHTS_H

#include "core/device/device.h"
#include "core/scene/city/city.h"
#include "core/scene/light_file.h"

enum scenery_time { SCENERY_DAY, SCENERY_NIGHT };

struct scenery_lights_settings {
    const char *file; // of the user's lights, which stand for all others; NULL or "": none
    // Without a file: so many lights, 0 to 16; by day a sun and lamps, by night lamps and a moon.
    int count;
    enum scenery_time time;
    const struct city_lamp *lamps; // the scene's; the caller's
    int lamp_count;
    float about_m[3]; // lamps nearest to this come first
    // Shadows.
    bool shadows;
    int shadow_map_px;         // width and height of a map
    float low_m[3], high_m[3]; // the scene's bounds: of positive volume
    float world_to_frame[16];  // row by row, turns and moves: the technique's own frame
};

struct scenery_lights {
    int count;
    scenery_light world[SCENERY_MAX_LIGHTS]; // in the world
    float sky[3];                            // linear: what comes from everywhere
    struct rg_buf *in_world, *in_frame;      // of `count` scenery_light each, at least one
    struct rg_image *shadows;                // D32F: all maps; of one texel where there are none
    int map_count;                           // layers that are drawn
};

// The lights, without their maps' contents. NULL, and one logged line, on failure.
struct scenery_lights *scenery_lights_open(struct rg_device *device,
                                           const struct scenery_lights_settings *settings);
void scenery_lights_close(struct scenery_lights *lights);

// Draws the scene's depth with a matrix from the world to clip space onto a layer of an image: what
// casts shadows. Faces keep their turn, as a camera's matrix leaves it.
typedef bool (*scenery_depth_fn)(void *user, const float to_clip[16], const struct rg_draw *onto);
// Draws all shadow maps: once, or again where the scene has changed.
bool scenery_lights_shade(struct scenery_lights *lights, scenery_depth_fn draw, void *user);

// --- the steps of scenery_lights_open ---

// The lights that settings ask for. False, and one logged line, where the file is none or the scene
// has too few lamps.
bool scenery_lights_choose(const struct scenery_lights_settings *settings,
                           struct rg_lights *lights);
// A light as kernels read it, in the world; its shadow layers begin at `layer`, -1: it casts none.
scenery_light scenery_light_of(const struct rg_light *light, const float low_m[3],
                               const float high_m[3], int map_px, int layer);
// The same light in another frame, which a turning and moving matrix leads to.
scenery_light scenery_light_moved(const scenery_light *light, const float matrix[16]);
// The matrix from the light's frame to clip space of face 0 .. shadow_faces - 1 of its map.
void scenery_light_to_clip(const scenery_light *light, int face, float matrix[16]);

#endif
