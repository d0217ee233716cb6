// Holds a device's fixed functions against the digests in a baseline, or against another driver's.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_FIXED_H
#define RG_HARNESS_COMPARE_GATE_RUN_FIXED_H

#include "harness/compare/gate/run/timing.h"

// Draws them on each device whose case is chosen, and adds to the report: a case for all of a
// device's, and one for each whose digest is another or that an expectation names. They are not
// compared, and their case is skipped, where processor, vector width or settings, on which bits may
// depend, are others. Two drivers' pictures may differ as the APIs allow: such a case passes, and
// says so, unless the gate is strict. Call it behind rg_gate_report. False, and one logged
// line, without memory.
bool rg_gate_hold_fixed(struct rg_running_gate *run);

#endif
