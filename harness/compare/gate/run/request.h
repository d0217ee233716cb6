// What a gate is asked. Nothing in it is owned.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_REQUEST_H
#define RG_HARNESS_COMPARE_GATE_RUN_REQUEST_H

#include "harness/compare/gate/cells/cells.h"
#include "harness/compare/gate/expected/expected.h"
#include "harness/compare/gate/report/gtest.h"
#include "harness/compare/gate/report/report.h"
#include "harness/compare/gate/run/pairs.h"

struct rg_gate_request {
    const struct rg_gate_pairs *pairs; // one after the other
    const struct rg_gate_cells *cells;
    const struct rg_known *known; // what is expected to go wrong
    const char *require;          // names of devices or of backends that must be there; NULL: none
    // Devices that it could be of and that it was not asked for: what is expected of them stays.
    struct rg_gate_left left;
    int today;       // harness/compare/gate/text/date.h
    double margin;   // 0.05 for 5 %
    double budget_s; // for times; no launch is begun behind it, which pairs share; 0: there is none
    bool pictures_only;            // nothing is timed
    const char *filter;            // of googletest, for names of cases; NULL: all
    struct rg_gtest_shards shards; // of what it lets through
    const char *pictures;          // a folder for those that differ, which is made; NULL: none
    const char *folder;            // where times are kept, which is there; NULL: nowhere
    bool fresh;                    // what is kept there is not gone on with
    // Told of each case before it is begun and when it has ended; NULL: nobody asks. A case that is
    // timed ends with all others.
    void (*tell)(const struct rg_report_case *told, void *user);
    void *user;
};

#endif
