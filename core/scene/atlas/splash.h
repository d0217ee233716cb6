// The animation of a splash: a drop of 3.2 mm hits a surface at 8.16 m/s and throws up a crown of
// clear water, whose fingers and droplets fall back. 21 frames of 6 ms show it from 15 degrees
// above. The picture spans 60 x 40 mm; the drop hits in the middle of its width, 8 mm above its
// lower edge. docs/atlas.md has the model and its sources.
#ifndef RG_CORE_SCENE_ATLAS_SPLASH_H
#define RG_CORE_SCENE_ATLAS_SPLASH_H

#include <stdbool.h>

#include "core/scene/atlas/atlas.h"
#include "core/scene/atlas/optics/water.h"

// The height of the impact above the picture's lower edge, the angle from above, and the width.
#define RG_SPLASH_FOOT_SHARE (8.0 / 40)
#define RG_SPLASH_TILT_DEG   15.0
#define RG_SPLASH_PICTURE_M  0.06

enum { RG_SPLASH_WIDTH_PX = 48, RG_SPLASH_HEIGHT_PX = 32, RG_SPLASH_LEVELS = 6 };

// The crown at one moment, in metres: its radius at the foot, the height of the sheet's upper edge.
struct rg_splash_crown {
    double radius_m, height_m;
};

// Light from above the horizon, by its direction in the atlas' cells.
struct rg_splash_light {
    double cells[RG_ATLAS_LIGHTS][RG_ATLAS_PHIS];
};

// The crown of a material at a time after the impact. Sets differ in the puddle: that of the
// database, with which tables are measured, is not as measured.
struct rg_splash_crown rg_splash_crown(enum rg_swings set, int material, double time_s);
// All its water; no byte of it is left undefined.
void rg_splash_water(enum rg_swings set, int material, double time_s, struct rg_water *water);
// That of a frame. Returns the share of it that is shown: it fades out in the end.
double rg_splash_frame(enum rg_swings set, int material, int frame, struct rg_water *water);

// Draws water: the share of the light at each texel that it brings there from above the horizon, 0
// to 1; row 0 on top. The rest comes from behind the splash, or from the ground, which looks the
// same. Adds that light to `light`, unless it is NULL. False, and one logged line, when memory runs
// out.
bool rg_splash_see(const struct rg_water *water,
                   float texels[RG_SPLASH_HEIGHT_PX * RG_SPLASH_WIDTH_PX],
                   struct rg_splash_light *light);

// The same of a frame of a material.
bool rg_splash_draw(enum rg_swings set, int material, int frame,
                    float texels[RG_SPLASH_HEIGHT_PX * RG_SPLASH_WIDTH_PX],
                    struct rg_splash_light *light);

// The parts in which light from each direction shows on a splash, per steradian: an even sky's
// make 1 together. All are 0 where no light shows.
void rg_splash_parts(const struct rg_splash_light *light,
                     float parts[RG_ATLAS_LIGHTS][RG_ATLAS_PHIS]);

#endif
