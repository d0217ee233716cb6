// Does an API's own timer tell the truth? Compared with wall clock over a known load.
#ifndef RG_HARNESS_MEASURE_TIMER_AUDIT_H
#define RG_HARNESS_MEASURE_TIMER_AUDIT_H

#include <stdbool.h>

struct rg_device;

struct rg_timer_audit {
    int passes;           // of the load, between two syncs
    double wall_ms;       // of the load, from sync to sync: the time that raingauge goes by
    bool has_timer;       // the API's timer could be read
    double api_ms;        // the same load by the API's timer
    double ratio;         // api_ms / wall_ms
    bool trusted;         // 0.8 <= ratio <= 1.05
    double sync_us;       // a sync with nothing to wait for
    double dispatch_us;   // one of many one-item passes in a row
    double round_trip_us; // a one-item pass and a sync
};

// Medians of several repetitions, after warm-up; takes about half a second. False, and one logged
// line, when the device failed. A timer that cannot be read is a result, not a failure.
bool rg_timer_audit(struct rg_device *device, struct rg_timer_audit *audit);

// Whether an API's time by wall clock is one that an honest timer gives: 0.8 to 1.05.
bool rg_timer_is_trusted(double ratio);

#endif
