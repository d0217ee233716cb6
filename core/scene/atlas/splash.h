// The animation of a splash: a drop of 3.2 mm hits a surface and throws up a crown and droplets,
// which fall back. 21 frames of 6 ms show it from 15 degrees above. The picture spans 60 x 40 mm;
// the drop hits in the middle of its width, 8 mm above its lower edge.
#ifndef RG_CORE_SCENE_ATLAS_SPLASH_H
#define RG_CORE_SCENE_ATLAS_SPLASH_H

#include <stdbool.h>

#include "core/scene/atlas/atlas.h"

// The height of the impact above the picture's lower edge.
#define RG_SPLASH_FOOT_SHARE (8.0 / 40)

enum { RG_SPLASH_WIDTH_PX = 48, RG_SPLASH_HEIGHT_PX = 32, RG_SPLASH_LEVELS = 6 };

// The crown at one moment, in metres: its radius at the foot, the height of the sheet's upper edge.
struct rg_splash_crown {
    double radius_m, height_m, thickness_m;
};

// The crown of a material at a time after the impact.
struct rg_splash_crown rg_splash_crown(int material, double time_s);

// Draws a frame of a material as opacity, 0 to 1; row 0 on top. False, and one logged line, when
// memory runs out.
bool rg_splash_draw(int material, int frame,
                    float texels[RG_SPLASH_HEIGHT_PX * RG_SPLASH_WIDTH_PX]);

#endif
