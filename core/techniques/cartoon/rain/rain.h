// Cartoon's rain: its two particle systems, their collisions and their drawing.
#ifndef RG_CORE_TECHNIQUES_CARTOON_RAIN_RAIN_H
#define RG_CORE_TECHNIQUES_CARTOON_RAIN_RAIN_H

#include "core/device/scan.h"
#include "core/scene/camera.h"
#include "core/scene/diorama/diorama.h"
#include "core/techniques/cartoon/rain/settings.h"
#include "core/techniques/cartoon/rain/wind.h"
#include "core/techniques/technique.h"
#include "kernels/cartoon/rain/params.h"

enum cartoon_rain_stage {
    CARTOON_RAIN_FREE,
    CARTOON_RAIN_LIST,
    CARTOON_RAIN_RELEASE,
    CARTOON_RAIN_MOVE,
    CARTOON_RAIN_AGE,
    CARTOON_RAIN_COUNT,
    CARTOON_RAIN_SPHERES,
    CARTOON_RAIN_SUM,
    CARTOON_RAIN_KEEP,
    CARTOON_RAIN_COLLIDE,
    CARTOON_RAIN_SPLASH,
    // pictures
    CARTOON_RAIN_DROPS,
    CARTOON_RAIN_SPLASHES,
    CARTOON_RAIN_STAGES
};

enum cartoon_rain_counter { CARTOON_DROPS_ASKED, CARTOON_RAIN_COUNTERS };

// The scene under the rain, and its camera, as of the current frame; the technique owns it.
struct cartoon_rain_scene {
    const struct diorama *diorama;
    const struct rg_camera *camera;
    const m4 *to_clip; // from the world
};

struct cartoon_rain {
    struct rg_instance *instance;
    const struct cartoon_rain_settings *settings;
    struct cartoon_rain_scene scene;
    cartoon_rain_params params;
    struct cartoon_wind_script script;
    int drops;         // length of the list of living drops in the last step
    int sprays_before; // length of the list of living splashes before the last step's hits
    double fall_m;     // height from which drops fall to the ground
    int first_stage;
    struct rg_scan *scan;
    struct rg_asset *raindrops, *sprays, *tally, *flags, *before, *counts, *hits, *hits_before;
};

// Adds the rain's assets and stages to an instance with the assets normal_map and depth_map.
// Settings and scene must outlive it. False, with one logged line, on failure.
bool cartoon_rain_open(struct cartoon_rain *r, struct rg_instance *instance,
                       const struct cartoon_rain_settings *settings, int seed,
                       const struct cartoon_rain_scene *scene);
void cartoon_rain_close(struct cartoon_rain *r);
// Makes a step of the rain, with the depth and normal map of the frame's camera.
bool cartoon_rain_step(struct cartoon_rain *r);
// Draws splashes and drops into the layer.
bool cartoon_rain_draw(struct cartoon_rain *r);

// The law: each released drop falls, sticks or is counted as gone, and likewise each splash. False
// if not; `detail` then says in one line what is wrong.
bool cartoon_rain_holds(const struct cartoon_rain *r, char *detail, size_t size);

// The following is for the files of this folder.

// Fills in the parameters that never change. False, with one logged line, where settings conflict.
bool cartoon_rain_fill(struct cartoon_rain *r, int seed);
// Fills in the parameters of the current frame: release, wind, view.
void cartoon_rain_refill(struct cartoon_rain *r);
// The number of drops released before this step: each step releases a whole number, and remainders
// carry over.
int64_t cartoon_released_before(const struct cartoon_rain_settings *settings, int64_t step);
// Adds the image `rain_textures` and the buffer `boxes` (kernels/cartoon/rain/draw/sprite.h).
// Returns the number of levels.
int cartoon_add_textures(struct rg_instance *instance);
// Hands over the layers as textures (core/techniques/technique.h): drops in a row, then each
// pattern of splashes.
bool cartoon_make_rain_textures(rg_take_texture *take, void *user);

#endif
