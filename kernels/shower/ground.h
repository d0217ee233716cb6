// The height of the scene at a place. Kernels include this file after their slots, which have
//   IMAGE(3, D32F, heights)  the scene seen from above; one texel: there is none
#ifndef RG_KERNELS_SHOWER_GROUND_H
#define RG_KERNELS_SHOWER_GROUND_H

#include "kernels/shower/heights.h"

RG_FN float shower_ground(rg_ctx rg, shower_params p, float x, float z)
{
    shower_map_place m = shower_map_place_at(p, x, z, heights_width(rg, 0), heights_height(rg, 0));
    return shower_height(p, heights_texel(rg, m.x, m.z, 0, 0).r, m.outside);
}

#endif
