// A gate's request, and all results of one of its cells, from which a report's case is made.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_CASES_H
#define RG_HARNESS_COMPARE_GATE_RUN_CASES_H

#include "harness/compare/gate/baseline/baseline.h"
#include "harness/compare/gate/expected/expected.h"
#include "harness/compare/gate/pictures/pictures.h"
#include "harness/compare/gate/report/gtest.h"
#include "harness/compare/gate/sides/alike.h"
#include "harness/compare/gate/sides/pairs.h"
#include "harness/compare/gate/sides/times.h"
#include "harness/record/shard.h"

// Owns nothing.
struct rg_gate_request {
    const struct rg_gate_cells *cells;
    // B is compared with the A of each pair, one pair after the other; or all with a baseline,
    // whose cells are those above (rg_baseline_fits).
    const struct rg_gate_pairs *pairs;
    const struct rg_baseline *baseline; // NULL: both sides of each pair run
    const struct rg_known *known;       // the expectations
    const char *require;                // devices or backends that must be there; NULL: none
    // Devices that could have been gated too; expectations of theirs stay.
    struct rg_gate_left left;
    int today;          // harness/compare/gate/text/date.h
    double margin;      // 0.05 for 5 %
    double begin_ms;    // of the command, by rg_now_ms
    double budget_s;    // from then on, shared by the pairs; nothing begins after it; 0: no limit
    bool pictures_only; // nothing is timed
    bool strict;        // fixed functions of two drivers may not differ as the APIs allow
    const char *filter; // of googletest, for case names; NULL: all
    // Of the cases that the filter selects. Shards share the error, and each leaves a part of one
    // report; `is_apart`: each is a gate of its own, as of googletest.
    struct rg_shard shard;
    bool is_apart;
    const json_t *times;  // seconds that cases take, by name; NULL: unknown
    const char *pictures; // folder for pictures that differ, created if missing; NULL: none
    const char *folder;   // existing folder for the journal; NULL: none
    bool fresh;           // ignores an existing journal
};

struct rg_gate_case {
    const struct rg_gate_cell *cell;
    char *name; // owned by the gate
    int place;  // among the cases that the filter selects
    double seconds;
    int pair; // index in the request's pairs; 0 with a baseline
    // B is compared with A, or with its row of a baseline; A is NULL then.
    struct rg_side *sides[RG_SIDES];
    const struct rg_baseline_row *before;
    const char *devices[RG_SIDES]; // names of the sides that exist
    int device_count;
    char driver[160];    // B's
    int64_t expectation; // of request->known; -1: none
    bool is_skipped, is_compared;
    bool is_over;              // the time was over before it was compared
    bool is_timed, is_advised; // the times decide, or are only reported
    struct rg_agreement agreement;
    // Valid if it is timed.
    struct rg_gate_rule rule;
    struct rg_gate_row row;
    struct rg_timed_cell times;
};

// The name of a cell's case on B: "streaks/rain.vulkan@VK_DRIVER_FILES=new.json". Characters that a
// report cannot hold are replaced, so that filters use the names that lists show. The caller frees
// it. NULL, and one logged line, without memory.
char *rg_gate_case_name(const char *cell, const char *device);

// The device whose case this is.
const char *rg_gate_case_device(const struct rg_gate_case *of);
// Finds the case's expectation, by B's driver if B is open.
void rg_gate_case_expect(struct rg_gate_case *of, const struct rg_gate_request *request);

// Whether its pictures were compared; any other end proves nothing.
bool rg_gate_case_was_compared(const struct rg_gate_case *of);

// Adds the case to the report, and fills in the result that is compared with expectations, which
// points into `of`. False, and one logged line, without memory.
bool rg_gate_case_tell(const struct rg_gate_case *of, const struct rg_gate_request *request,
                       struct rg_report *report, struct rg_known_result *result);

#endif
