// The parameters of ink.h, and the layout of its buffer.
#ifndef RG_KERNELS_CARTOON_SCENE_INK_PARAMS_H
#define RG_KERNELS_CARTOON_SCENE_INK_PARAMS_H

#include "kernels/dialect/matrix.h"

// Numbers of an edge, each of all edges before the next: x, y, z of both ends, then the normals of
// both faces, of unit length. The normal of a missing second face is 0.
#define CARTOON_EDGE_WORDS 12

RG_STRUCT(cartoon_ink_params)
{
    m4 to_clip; // from the world
    float eye_x;
    float eye_y;
    float eye_z;
    float right_x; // change of a pixel's ray, which goes 1 ahead, to the next pixel on the right
    float right_y;
    float right_z;
    float down_x; // and to the one below
    float down_y;
    float down_z;
    float depth_fall; // fall of depth as 1 / distance ahead grows by 1
    float cos_crease; // faces that differ by more make a crease
    float contour_px; // width of lines
    float crease_px;
    float full_m; // distance ahead from which on lines get thinner
    int count;    // of edges
};
RG_STRUCT_SIZE(cartoon_ink_params, 31)

#endif
