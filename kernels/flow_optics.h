// What flow's lighting passes read from the slots normals and environment of the kernel that
// includes this: the water's normal anywhere on a pane, and the light that comes from anywhere.
#ifndef RG_KERNELS_FLOW_OPTICS_H
#define RG_KERNELS_FLOW_OPTICS_H

#include "cube.h"

// The environment's light from a direction of any length but zero, in one of its levels, which is
// `size` texels along a face, between four texels. The outermost texels of a face have their
// centres on the cube's edges (core/scene/cube.h), so that light is the same from both sides of an
// edge.
RG_FN v3 light_from(rg_ctx rg, v3 d, int level, int size)
{
    cube_point c = cube_locate(d, size - 1);
    float texel = 1.0f / rg_to_float(size);
    rgba light = environment_linear(rg, (c.x + 0.5f) * texel, (c.y + 0.5f) * texel, c.face, level);
    return v3_make(light.r, light.g, light.b);
}

#endif
