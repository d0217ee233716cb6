// A device's measured ceilings, with which docs/performance.md compares frames.
#ifndef RG_HARNESS_DEVICES_MEASURE_CEILINGS_H
#define RG_HARNESS_DEVICES_MEASURE_CEILINGS_H

#include <stdbool.h>

struct rg_device;

struct rg_ceilings {
    double memory_gb_s;      // bytes read and written by a copy of 64 MiB, 10^9 a second
    double cache_gb_s;       // the same of 1 MiB, which stays in the caches
    double arithmetic_gop_s; // single-precision multiplications and additions, 10^9 a second
};

// Takes the best of several runs after warm-up; about a second. False, and one logged line, when
// the device failed.
bool rg_ceilings_measure(struct rg_device *device, struct rg_ceilings *ceilings);

#endif
