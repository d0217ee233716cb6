// What is found out about a device, from one process to the other.
//
// What is taken can be printed and reckoned with: counts are within what is counted, and numbers
// are finite and no less than they can be. What follows from what is taken is not sent.
#ifndef RG_HARNESS_MEASURE_MESSAGES_H
#define RG_HARNESS_MEASURE_MESSAGES_H

#include "harness/devices/workers/fields.h"

// Of RG_PROBE_COUNT struct rg_probe_result, whose names and kinds are the same in both processes
// (rg_probe_name), of struct rg_drawing, of struct rg_timer_audit without `trusted`, and of struct
// rg_ceilings.
extern const struct rg_field rg_probe_fields[], rg_drawing_fields[], rg_audit_fields[],
    rg_ceilings_fields[];

#endif
