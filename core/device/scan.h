// Prefix sums and stable compaction on a device: how items find their place without atomics.
//
// The dialect has no memory shared by a work group, so each item sums a chunk of RG_SCAN_CHUNK
// elements one after the other. The chunks' sums are scanned in the same way, level by level. The
// result is the same in any order of the items. Buffers hold uints, one word for each element.
#ifndef RG_CORE_DEVICE_SCAN_H
#define RG_CORE_DEVICE_SCAN_H

#include <stdbool.h>

struct rg_buf;
struct rg_device;
struct rg_scan;

// Kernels and scratch buffers (about max_count / 16 bytes) for up to `max_count` elements,
// 1 to 2^30. NULL, and one logged line, on failure. A scan can be used again, for one run after the
// other. Both functions below return false, with one logged line, when the device failed.
struct rg_scan *rg_scan_create(struct rg_device *device, int max_count);
void rg_scan_destroy(struct rg_scan *scan);

// sums[i] = values[0] + ... + values[i - 1], modulo 2^32, for 0 <= i <= count; so sums[count] is
// the total. `values` holds at least `count` words (1 when it is 0), `sums` at least count + 1.
bool rg_scan_sum(struct rg_scan *scan, struct rg_buf *values, struct rg_buf *sums, int count);

// Writes the indices of the `count` flags that are not 0, ascending, to `indices`, and their number
// to found[0]. Indices beyond the size of `indices` are counted but not written.
bool rg_scan_compact(struct rg_scan *scan, struct rg_buf *flags, struct rg_buf *indices,
                     struct rg_buf *found, int count);

#endif
