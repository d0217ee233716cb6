// What tells how fast the machine is at the moment: the same work, over and over.
#ifndef RG_HARNESS_MEASURE_CALIBRATION_H
#define RG_HARNESS_MEASURE_CALIBRATION_H

#include "harness/record/record.h"

// Work of a few milliseconds that is always the same, of arithmetic and of memory.
void rg_calibration_load(void);

// How long the load took in the course of a measurement.
struct rg_calibration {
    void (*load)(void); // NULL: nothing is calibrated
    int count;
    double ms[RG_MAX_SAMPLES + 1];
};

// Runs the load three times, and keeps their median. Nothing where there is no load, or no room.
void rg_calibration_take(struct rg_calibration *calibration);
// What the load took at the beginning and in the end: the medians of the first and the last third
// of its times; both 0 without any.
void rg_calibration_tell(const struct rg_calibration *calibration, double *begin_ms,
                         double *end_ms);

#endif
