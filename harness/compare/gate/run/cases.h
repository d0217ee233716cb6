// A cell of a gate and all that was found of it, and the case of a report that it makes.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_CASES_H
#define RG_HARNESS_COMPARE_GATE_RUN_CASES_H

#include "harness/compare/gate/pictures/pictures.h"
#include "harness/compare/gate/run/agree.h"
#include "harness/compare/gate/run/request.h"
#include "harness/compare/gate/run/times.h"

struct rg_gate_case {
    const struct rg_gate_cell *cell;
    char *name; // owned by the gate
    double seconds;
    // The sides, of which the last is held against what is before it, or against what was.
    const char *devices[RG_SIDES];
    int device_count;
    char driver[160];    // the last one's
    int64_t expectation; // of request->known; -1: none
    bool is_skipped, is_compared, is_timed;
    struct rg_agreement agreement;
    // Where it is timed.
    int timed; // its row
    struct rg_gate_rule rule;
    struct rg_gate_row row;
    struct rg_timed_cell times;
    // What its case of a report points to.
    char message[RG_AGREEMENT_TEXT + 400];
    char *details; // owned by the gate
    const char *pictures[RG_GATE_PICTURES];
    char (*paths)[PATH_MAX]; // of pictures that were written; owned by the gate
};

// The device that a case is of.
const char *rg_gate_case_device(const struct rg_gate_case *of);
// Finds what is expected of it, with its device, which is NULL where it is not there.
void rg_gate_case_expect(struct rg_gate_case *of, const struct rg_gate_request *request,
                         const struct rg_device *device);

// Whether its pictures were: what else ended it proves nothing.
bool rg_gate_case_was_compared(const struct rg_gate_case *of);

// Fills in its case, which points into it and into the request, and what the expectations are held
// against.
void rg_gate_case_tell(struct rg_gate_case *of, const struct rg_gate_request *request,
                       struct rg_report_case *told, struct rg_known_result *result);

#endif
