// What is found out about a device, from one process to the other.
//
// What is taken can be printed and reckoned with: counts are within what is counted, and numbers
// are finite and no less than they can be. What follows from what is taken is found here and not
// sent.
#ifndef RG_HARNESS_MEASURE_MESSAGES_H
#define RG_HARNESS_MEASURE_MESSAGES_H

#include "core/device/probe.h"
#include "harness/devices/workers/message.h"
#include "harness/measure/ceilings.h"
#include "harness/measure/timer_audit.h"

void rg_put_probe(struct rg_message *message, const struct rg_probe_result results[RG_PROBE_COUNT]);
bool rg_take_probe(struct rg_message *message, struct rg_probe_result results[RG_PROBE_COUNT]);

void rg_put_audit(struct rg_message *message, const struct rg_timer_audit *audit);
bool rg_take_audit(struct rg_message *message, struct rg_timer_audit *audit);

void rg_put_ceilings(struct rg_message *message, const struct rg_ceilings *ceilings);
bool rg_take_ceilings(struct rg_message *message, struct rg_ceilings *ceilings);

#endif
