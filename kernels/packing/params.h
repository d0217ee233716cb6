// The parameters of ranges.h.
#ifndef RG_KERNELS_PACKING_PARAMS_H
#define RG_KERNELS_PACKING_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(packing_params)
{
    int chunks;         // of items, RG_DRAW_CHUNK each
    int chunks_a_query; // the last query may have fewer
    int vertices;       // of a primitive
};
RG_STRUCT_SIZE(packing_params, 3)

#endif
