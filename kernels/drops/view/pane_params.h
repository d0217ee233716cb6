// The parameters of the lit pane's picture. Directions on the pane are (right, down, towards the
// viewer); the viewer is inside, the water on the far side.
#ifndef RG_KERNELS_DROPS_VIEW_PANE_PARAMS_H
#define RG_KERNELS_DROPS_VIEW_PANE_PARAMS_H

#include "kernels/dialect/matrix.h"

RG_STRUCT(drops_pane_params)
{
    m4 to_world; // turns directions on the pane to the world's
    int columns; // cells of the pane
    int rows;
    int stride;
    int rays;      // of a pixel, along a side
    float cell_mm; // side of a cell
    float mm_px;   // of the pane in a pixel
    float left_mm; // the picture's left edge on the pane
    float top_mm;
    float middle_x_mm; // the pane's middle, before which the camera is
    float middle_y_mm;
    float distance_mm;  // of the camera
    float contact_mm;   // lower water does not bend light
    float index;        // of refraction
    int environment_px; // texels along a face
    // The background: a picture behind the pane, upright in the world.
    int has_background; // 0: the environment's own view
    float background_mm;
    float per_width; // 1 over its size in mm
    float per_height;
    float texels_mm; // of its level 0
    float right_x;   // its right and its down, on the pane
    float right_y;
    float down_x;
    float down_y;
};
RG_STRUCT_SIZE(drops_pane_params, 39)

#endif
