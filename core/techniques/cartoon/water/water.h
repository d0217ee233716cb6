// Accumulated water where drops have hit (kernels/cartoon/water/params.h), an option of cartoon.
#ifndef RG_CORE_TECHNIQUES_CARTOON_WATER_WATER_H
#define RG_CORE_TECHNIQUES_CARTOON_WATER_WATER_H

#include "core/techniques/cartoon/rain/rain.h"
#include "kernels/cartoon/water/params.h"

#define CARTOON_UNIT_M3 1e-10 // the volume of a unit

// Each frame's data from the scene: the place of pixels, the light and the ink.
struct cartoon_water_view {
    m4 from_pixel;
    float to_light[3];
    double ink[3];
};

enum cartoon_water_stage {
    CARTOON_WATER_GATHER,
    CARTOON_WATER_SPREAD,
    CARTOON_WATER_PUDDLES,
    CARTOON_WATER_STAGES
};

struct cartoon_water {
    const struct cartoon_rain *rain; // the rain whose hits it collects
    const struct cartoon_water_settings *settings;
    cartoon_water_params params;
    int first_stage;
    struct rg_asset *now, *next, *account;
};

// Adds the buffers `water`, `water_next` and `account` to an instance with rain, unless the setting
// is off; then the other functions do nothing. False, with one logged line, on failure.
bool cartoon_water_open(struct cartoon_water *w, const struct cartoon_rain *rain,
                        const struct cartoon_water_settings *settings);
// Makes a step, after the rain's.
bool cartoon_water_step(struct cartoon_water *w);
// Draws puddles into the layer.
bool cartoon_water_draw(struct cartoon_water *w, const struct cartoon_water_view *view);

// The law: water that has hit is in columns, has evaporated or has run off, exact to the unit.
// False if not; `detail` then says in one line what is wrong.
bool cartoon_water_holds(const struct cartoon_water *w, char *detail, size_t size);

#endif
