// A device's measured ceilings, with which docs/performance.md compares frames.
#ifndef RG_HARNESS_DEVICES_MEASURE_CEILINGS_H
#define RG_HARNESS_DEVICES_MEASURE_CEILINGS_H

#include <stdbool.h>

struct rg_device;

struct rg_ceilings {
    double memory_gb_s;      // bytes read and written by a large copy, 10^9 a second
    double cache_gb_s;       // the same of a copy of 1 MiB or a little more, which stays in caches
    double arithmetic_gop_s; // single-precision multiplications and additions, 10^9 a second
};

// Takes the best of several runs after warm-up, of twice the work until the rate changes by less
// than 5 %; copies of at least 64 MiB, on a GPU of at most 1 GiB; about a second. False, and one
// logged line, when the device failed.
bool rg_ceilings_measure(struct rg_device *device, struct rg_ceilings *ceilings);

#endif
