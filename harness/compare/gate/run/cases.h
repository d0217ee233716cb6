// What a gate is asked, and of each of its cells all that was found, which makes a case of a
// report.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_CASES_H
#define RG_HARNESS_COMPARE_GATE_RUN_CASES_H

#include "harness/compare/gate/baseline/baseline.h"
#include "harness/compare/gate/expected/expected.h"
#include "harness/compare/gate/pictures/pictures.h"
#include "harness/compare/gate/report/gtest.h"
#include "harness/compare/gate/sides/alike.h"
#include "harness/compare/gate/sides/pairs.h"
#include "harness/compare/gate/sides/times.h"

// Nothing in it is owned.
struct rg_gate_request {
    const struct rg_gate_cells *cells;
    // What B is held against: the other side of each pair, one pair after the other, or what a
    // baseline has of a device, whose cells are those above (rg_baseline_fits).
    const struct rg_gate_pairs *pairs;
    const struct rg_baseline *baseline; // NULL: pairs
    const char *devices;                // of the baseline, names with commas; NULL: all
    const struct rg_known *known;       // what is expected to go wrong
    const char *require; // names of devices or of backends that must be there; NULL: none
    // Devices that it could be of and that it was not asked for: what is expected of them stays.
    struct rg_gate_left left;
    int today;          // harness/compare/gate/text/date.h
    double margin;      // 0.05 for 5 %
    double budget_s;    // for times; no launch is begun behind it, which pairs share; 0: none
    bool pictures_only; // nothing is timed
    const char *filter; // of googletest, for names of cases; NULL: all
    struct rg_gtest_shards shards; // of what it lets through
    const char *pictures;          // a folder for those that differ, which is made; NULL: none
    const char *folder;            // where times are kept, which is there; NULL: nowhere
    bool fresh;                    // what is kept there is not gone on with
};

struct rg_gate_case {
    const struct rg_gate_cell *cell;
    char *name; // owned by the gate
    double seconds;
    int pair; // of the request's, 0 with a baseline
    // B is held against A, or against what a baseline has of it: then A is NULL.
    struct rg_side *sides[RG_SIDES];
    const struct rg_baseline_row *before;
    const char *devices[RG_SIDES]; // names of the sides that there are
    int device_count;
    char driver[160];    // B's
    int64_t expectation; // of request->known; -1: none
    bool is_skipped, is_compared;
    bool is_timed, is_advised; // its times decide, or are told alone
    struct rg_agreement agreement;
    // Where it is timed.
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
// Finds what is expected of it, by B's driver where that is open.
void rg_gate_case_expect(struct rg_gate_case *of, const struct rg_gate_request *request);

// Whether its pictures were: what else ended it proves nothing.
bool rg_gate_case_was_compared(const struct rg_gate_case *of);

// Fills in its case, which points into it and into the request, and what the expectations are held
// against.
void rg_gate_case_tell(struct rg_gate_case *of, const struct rg_gate_request *request,
                       struct rg_report_case *told, struct rg_known_result *result);

#endif
