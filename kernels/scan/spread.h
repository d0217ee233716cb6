// Prefix sums within each chunk, starting with the sum of all chunks before it: the way down of a
// prefix sum (core/device/scan.h). The last chunk also writes the total, after its own sums.
#include "kernels/scan/params.h"

#define RG_PARAMS scan_params
#define RG_SLOTS  IN(1, uint, values) IN(2, uint, before) OUT(3, uint, sums)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(scan_spread)
{
    int end = scan_chunk_end(x, p.count);
    uint sum = before_at(rg, x);
    for (int i = x * RG_SCAN_CHUNK; i < end; i++) {
        sums_put(rg, i, sum);
        sum += values_at(rg, i);
    }
    if (end == p.count)
        sums_put(rg, p.count, sum);
}
