// The sum of each chunk: the way up of a prefix sum (core/device/scan.h).
#include "kernels/scan/params.h"

#define RG_PARAMS scan_params
#define RG_SLOTS  IN(1, uint, values) OUT(2, uint, sums)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(scan_sums)
{
    int end = scan_chunk_end(x, p.count);
    uint sum = 0u;
    for (int i = x * RG_SCAN_CHUNK; i < end; i++) {
        uint value = values_at(rg, i);
        sum += p.flags != 0 ? (value != 0u ? 1u : 0u) : value;
    }
    sums_put(rg, x, sum);
}
