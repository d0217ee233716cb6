// The lights of a scene, and a user's own list of them (docs/lights.md).
#ifndef RG_CORE_SCENE_LIGHT_FILE_H
#define RG_CORE_SCENE_LIGHT_FILE_H

#include <stdbool.h>

#include "kernels/scenery/light.h"

struct rg_light {
    int kind;            // SCENERY_POINT, SCENERY_SPOT or SCENERY_SUN
    float position_m[3]; // in the world; of points and spots
    float direction[3];  // the direction in which light travels, of unit length; of spots and suns
    float colour[3];     // linear, times the intensity
    float inner_deg;     // from a spot's axis up to this angle it is fully bright
    float outer_deg;     // and from this angle on dark
    float near_m;        // things nearer to a point or spot cast no shadow
    bool shadows;
};

struct rg_lights {
    int count;
    struct rg_light lights[SCENERY_MAX_LIGHTS];
    float sky[3]; // linear; light that comes equally from everywhere
};

// Reads a file of lights. False, and one logged line that names the file, the light and the mend,
// if it is invalid; `lights` is then undefined.
bool rg_light_file_read(const char *path, struct rg_lights *lights);

#endif
