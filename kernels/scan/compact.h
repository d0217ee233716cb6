// Writes the indices of the elements that are not 0, in order, and their number
// (core/device/scan.h).
#include "kernels/scan/params.h"

#define RG_PARAMS scan_params
#define RG_SLOTS  IN(1, uint, flags) IN(2, uint, before) OUT(3, uint, indices) OUT(4, uint, found)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(scan_compact)
{
    int end = scan_chunk_end(x, p.count);
    int place = rg_to_int(before_at(rg, x));
    for (int i = x * RG_SCAN_CHUNK; i < end; i++) {
        if (flags_at(rg, i) != 0u) {
            if (place < p.capacity)
                indices_put(rg, place, rg_to_uint(i));
            place++;
        }
    }
    if (end == p.count)
        found_put(rg, 0, rg_to_uint(place));
}
