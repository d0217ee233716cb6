// Measurements of a device, as messages between processes.
//
// Received values are safe to print and compute with: counts are within their totals, and numbers
// are finite and in range. Derived values are not sent.
#ifndef RG_HARNESS_DEVICES_MEASURE_SERVING_MESSAGES_H
#define RG_HARNESS_DEVICES_MEASURE_SERVING_MESSAGES_H

#include "harness/devices/workers/fields.h"

// Fields of RG_PROBE_COUNT struct rg_probe_result, of struct rg_drawing, of struct rg_timer_audit
// without `trusted`, and of struct rg_ceilings. Names and kinds of operations are not sent: both
// processes know them (rg_probe_name).
extern const struct rg_field rg_probe_fields[], rg_drawing_fields[], rg_audit_fields[],
    rg_ceilings_fields[];

#endif
