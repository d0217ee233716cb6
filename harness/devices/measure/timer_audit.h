// Audits an API's timer: compares it with the wall clock over a known load.
#ifndef RG_HARNESS_DEVICES_MEASURE_TIMER_AUDIT_H
#define RG_HARNESS_DEVICES_MEASURE_TIMER_AUDIT_H

#include <stdbool.h>

struct rg_device;

struct rg_timer_audit {
    int passes;           // of the load, between two syncs
    double wall_ms;       // of the load between two syncs, by the clock that raingauge uses
    bool has_timer;       // the API's timer could be read
    double api_ms;        // the same load by the API's timer
    double ratio;         // api_ms / wall_ms
    bool trusted;         // 0.8 <= ratio <= 1.05
    double sync_us;       // a sync of an idle device
    double dispatch_us;   // one of many successive one-item passes
    double round_trip_us; // a one-item pass and a sync
};

// Takes medians of several repetitions after warm-up; about half a second. False, and one logged
// line, when the device failed. A timer that cannot be read is a result, not a failure.
bool rg_timer_audit(struct rg_device *device, struct rg_timer_audit *audit);

// Whether an API's time over wall time is plausible: 0.8 to 1.05.
bool rg_timer_is_trusted(double ratio);

#endif
