// A drop's distance down the pane, as a word that rises with it.
#ifndef RG_KERNELS_DROPS_MERGING_DEPTH_H
#define RG_KERNELS_DROPS_MERGING_DEPTH_H

#include "kernels/drops/params.h"

RG_FN uint drops_depth(drops_params p, drops_drop d)
{
    return rg_float_bits(rg_max(d.x * p.down_x + d.y * p.down_y + 65536.0f, 0.0f));
}

#endif
