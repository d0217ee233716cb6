// Writes the arguments of an indirect draw for each occlusion query, which draws its items'
// primitives: vertices, instances, first vertex, first instance (core/device/packing.h).
#include "kernels/packing/params.h"

#define RG_PARAMS packing_params
#define RG_SLOTS  IN(1, uint, before) OUT(2, uint, query_args)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(packing_ranges)
{
    int begin = x * p.chunks_a_query;
    int end = rg_imin(begin + p.chunks_a_query, p.chunks);
    uint vertices = rg_to_uint(p.vertices);
    uint first = before_at(rg, begin);
    query_args_put(rg, 4 * x, (before_at(rg, end) - first) * vertices);
    query_args_put(rg, 4 * x + 1, 1u);
    query_args_put(rg, 4 * x + 2, first * vertices);
    query_args_put(rg, 4 * x + 3, 0u);
}
