// A ray tracer of the lit pane in double precision, written from docs/drops.md without anything of
// kernels/ or core/.
#ifndef RG_TESTS_ORACLE_DROPS_PANE_PANE_H
#define RG_TESTS_ORACLE_DROPS_PANE_PANE_H

#include "tests/oracle/drops/pane/water.h"
#include "tests/oracle/flow/light.h"

enum { PANE_LEVELS = 16 };

// A picture's level, borrowed: red, green and blue of each texel, the top row first.
struct pane_picture {
    const float *light;
    int width, height;
};

struct pane_oracle {
    struct water_map water;
    int width, height; // of the picture, in pixels
    int rays;          // along each side of a pixel
    double distance_mm, index, contact_mm;
    double tilt_deg, turn_deg;
    struct light_cube environment[PANE_LEVELS];
    int environment_levels;
    // Levels of the background; none: the environment is seen.
    struct pane_picture background[PANE_LEVELS];
    int background_levels;
    double background_mm, background_deg;
};

// The light of a pixel. `margin_mm`: the smallest difference of a height from `contact_mm`, at
// which water begins to bend light.
void pane_oracle_pixel(const struct pane_oracle *pane, int x, int y, double light[3],
                       double *margin_mm);

#endif
