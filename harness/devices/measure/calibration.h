// A fixed load that shows how fast the machine currently is.
#ifndef RG_HARNESS_DEVICES_MEASURE_CALIBRATION_H
#define RG_HARNESS_DEVICES_MEASURE_CALIBRATION_H

#include "harness/record/record.h"

// Does a fixed amount of arithmetic and memory work, a few milliseconds.
void rg_calibration_load(void);

// The load's times in the course of a measurement.
struct rg_calibration {
    void (*load)(void); // NULL: no calibration
    int count;
    double ms[RG_MAX_SAMPLES + 1];
};

// Runs the load three times, and records the median. Does nothing without a load, or when the list
// is full.
void rg_calibration_take(struct rg_calibration *calibration);
// The load's time at the beginning and at the end: the medians of the first and the last third;
// both 0 if there are none.
void rg_calibration_tell(const struct rg_calibration *calibration, double *begin_ms,
                         double *end_ms);

#endif
