// The parameters of flow's two lighting passes, flow_normals.h and flow_light.h.
#ifndef RG_KERNELS_FLOW_LIGHT_PARAMS_H
#define RG_KERNELS_FLOW_LIGHT_PARAMS_H

#include "lang.h"

RG_STRUCT(flow_light_params)
{
    int size;                  // texels along a side of the pane
    float slope_per_height;    // slope of the water for a difference of 1 over two texels
    float wet_per_height;      // wetness a unit of water, until it is 1
    float texels_x, texels_y;  // of the pane, a pixel of the target
    float view_x, view_y;      // what a pixel adds to the view's direction, whose z is -1
    float view_left, view_top; // that of the target's corner, negated
    float fresnel_bias, fresnel_scale;
    int fresnel_power;         // 1 to 15
    float refraction_strength; // how far a normal bends the view of what lies behind
    float reflectivity;        // of the dry mirror
    int environment_size;      // texels along a face
    int reflection_level;      // of the environment, for what drops reflect
    int reflection_size;       // its texels along a face
    // The pane's tangent, binormal (down) and normal in the world.
    float tx, ty, tz;
    float bx, by, bz;
    float nx, ny, nz;
};
RG_STRUCT_SIZE(flow_light_params, 26)

#endif
