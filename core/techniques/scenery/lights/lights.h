// The lights of a scene of streaks: which there are, what kernels read of them, and their shadow
// maps. docs/lights.md explains.
#ifndef RG_CORE_TECHNIQUES_SCENERY_LIGHTS_LIGHTS_H
#define RG_CORE_TECHNIQUES_SCENERY_LIGHTS_LIGHTS_H

#include "core/device/device.h"
#include "core/scene/city/city.h"
#include "core/scene/light_file.h"

enum streaks_time { STREAKS_DAY, STREAKS_NIGHT };

struct streaks_lights_settings {
    const char *file; // of the user's lights, which stand for all others; NULL or "": none
    // Without a file: so many lights, 0 to 16; by day a sun and lamps, by night lamps and a moon.
    int count;
    enum streaks_time time;
    const struct city_lamp *lamps; // the scene's; the caller's
    int lamp_count;
    float about_m[3]; // lamps nearest to this come first
    // Shadows.
    bool shadows;
    int shadow_map_px;         // width and height of a map
    float low_m[3], high_m[3]; // the scene's bounds: of positive volume
    float world_to_rain[16];   // row by row; turns and moves
};

struct streaks_lights {
    int count;
    streaks_light world[STREAKS_MAX_LIGHTS]; // in the world
    float sky[3];                            // linear: what comes from everywhere
    struct rg_buf *in_world, *in_rain;       // of `count` streaks_light each, at least one
    struct rg_image *shadows;                // D32F: all maps; of one texel where there are none
    int map_count;                           // layers that are drawn
};

// The lights, without their maps' contents. NULL, and one logged line, on failure.
struct streaks_lights *streaks_lights_open(struct rg_device *device,
                                           const struct streaks_lights_settings *settings);
void streaks_lights_close(struct streaks_lights *lights);

// Draws the scene's depth with a matrix from the world to clip space onto a layer of an image: what
// casts shadows. Faces keep their turn, as a camera's matrix leaves it.
typedef bool (*streaks_depth_fn)(void *user, const float to_clip[16], const struct rg_draw *onto);
// Draws all shadow maps: once, or again where the scene has changed.
bool streaks_lights_shade(struct streaks_lights *lights, streaks_depth_fn draw, void *user);

// What streaks_lights_open does step by step: --------------------------------------------------

// The lights that settings ask for. False, and one logged line, where the file is none or the scene
// has too few lamps.
bool streaks_lights_choose(const struct streaks_lights_settings *settings,
                           struct rg_lights *lights);
// A light as kernels read it, in the world; its shadow layers begin at `layer`, -1: it casts none.
streaks_light streaks_light_of(const struct rg_light *light, const float low_m[3],
                               const float high_m[3], int map_px, int layer);
// The same light in another frame, which a turning and moving matrix leads to.
streaks_light streaks_light_moved(const streaks_light *light, const float matrix[16]);
// The matrix from the light's frame to clip space of face 0 .. shadow_faces - 1 of its map.
void streaks_light_to_clip(const streaks_light *light, int face, float matrix[16]);

#endif
