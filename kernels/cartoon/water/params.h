// Water that gathers on upward faces (Feng et al., future work). Each column of a grid over the
// ground holds a whole number of units of volume, so that nothing is lost to rounding.
#ifndef RG_KERNELS_CARTOON_WATER_PARAMS_H
#define RG_KERNELS_CARTOON_WATER_PARAMS_H

#include "kernels/dialect/matrix.h"

#define CARTOON_COLUMNS 128 // of the grid, each way

// Words of the account, in units, modulo 2^32: what has hit, evaporated, and run off.
#define CARTOON_WATER_HIT   0
#define CARTOON_WATER_DRIED 1
#define CARTOON_WATER_RUN   2
#define CARTOON_ACCOUNT     3

RG_STRUCT(cartoon_water_params)
{
    m4 from_pixel; // pixels and depth to the world, over w
    // the grid
    float low_x;
    float low_z;
    float per_column_x; // columns per metre
    float per_column_z;
    // volumes
    float units; // of the heaviest drop
    float least; // side that the lightest drop has, as a share of the heaviest's
    uint spread; // share that goes to each neighbour in a step, of 2^32
    uint dried;  // and that evaporates
    // pictures
    float per_unit; // depth of a unit in a column, as a share of the depth from which water is seen
    float eye_x;
    float eye_y;
    float eye_z;
    float px; // metres that a pixel spans at a distance of a metre
    float light_x;
    float light_z;
    float ink_r; // display values
    float ink_g;
    float ink_b;
};
RG_STRUCT_SIZE(cartoon_water_params, 16 + 18)

// Faces that are less steep hold water.
#define CARTOON_UPWARD 0.94f

#endif
