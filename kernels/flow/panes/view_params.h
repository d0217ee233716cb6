// The parameters of flow's drawing passes: the view, the light and the look of the panes. The scene
// is a box of half side 1 about the world's origin.
#ifndef RG_KERNELS_FLOW_PANES_VIEW_PARAMS_H
#define RG_KERNELS_FLOW_PANES_VIEW_PARAMS_H

#include "kernels/dialect/matrix.h"

// enum flow_stage of core/techniques/flow/inputs/flow.h.
#define FLOW_SHOWS_HEIGHT  0
#define FLOW_SHOWS_BLURRED 1

RG_STRUCT(flow_view_params)
{
    m4 to_clip; // from the world, or from a model's own space
    m4 rays;    // (px, py, 1) to the ray through a pixel's centre; its length is 1 along the view's
                // axis. The fourth column is the eye.
    m4 turn;    // a model's directions to the world
    int size;   // texels along a side of a pane
    int environment_size; // texels along a face
    int reflection_level; // of the environment, for reflections
    int reflection_size;  // its texels along a face
    int ambient_level;    // for light on a matt surface from all sides
    int ambient_size;
    float fresnel_bias, fresnel_scale;
    int fresnel_power;               // 1 to 15
    float refraction_strength;       // how far a normal bends the view through it
    float refraction_px;             // the same in pixels of the picture behind
    float reflectivity;              // of the dry mirror
    float frame;                     // width of the bar along a pane's edges, in pane sides
    int stage;                       // the map that flow_stage shows
    float model_grey;                // share of the light that a model reflects
    float light;                     // of the lamp on a model that faces it
    float light_x, light_y, light_z; // towards the lamp, in the world
    float drop_shadow;               // share of the lamp's light that a drop blocks, 0 to 1
    float wet_per_height;            // wetness a unit of water, until it is 1
};
RG_STRUCT_SIZE(flow_view_params, 69)

#endif
