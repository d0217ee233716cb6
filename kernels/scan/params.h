// The parameters of sums.h, spread.h and compact.h.
#ifndef RG_KERNELS_SCAN_PARAMS_H
#define RG_KERNELS_SCAN_PARAMS_H

#include "kernels/dialect/lang.h"

#define RG_SCAN_CHUNK 64 // elements for each item

RG_STRUCT(scan_params)
{
    int count;    // elements
    int flags;    // 1: an element counts as 1 if it is not 0
    int capacity; // of the indices of scan_compact
};
RG_STRUCT_SIZE(scan_params, 3)

RG_FN int scan_chunk_end(int chunk, int count)
{
    return rg_imin((chunk + 1) * RG_SCAN_CHUNK, count);
}

#endif
