// The search for the smallest run: the best one so far, and attempts at smaller ones. For this
// folder's files alone.
#ifndef RG_HARNESS_COMPARE_SHRINK_SEARCH_H
#define RG_HARNESS_COMPARE_SHRINK_SEARCH_H

#include "harness/compare/blame/fall.h"
#include "harness/compare/shrink/shrink.h"
#include "harness/devices/frames/session.h"

struct rg_search {
    const struct rg_shrink_request *asked;
    struct rg_digest_run best;  // its settings are owned
    struct rg_blame blame;      // of the best run
    struct rg_fall fall;        // how the device fails, if that is the difference
    struct rg_session *held[2]; // of the best run, so that instances' shared parts are made once
    double end_ms;
    int tried;
    int files;     // number of files made
    bool is_over;  // a device has failed
    bool has_none; // nothing differs that could be reduced
    char why[300];
};

// Begins with the requested run. False, and one logged line, if nothing differs or a device fails.
// Call rg_search_end in either case; the best run's settings stay the caller's.
bool rg_search_begin(struct rg_search *search, const struct rg_shrink_request *asked);
void rg_search_end(struct rg_search *search);

// Makes a run the best if it has the same difference and weighs at most most_weight. It owns the
// run's settings; NULL: they were refused.
bool rg_search_try(struct rg_search *search, struct rg_digest_run run, int64_t most_weight);
// Tries the best run with another value of a parameter, unless it has that value.
bool rg_search_value(struct rg_search *search, const struct rg_param *param, const char *value,
                     int64_t most_weight);

// Reduces the user's own file that a parameter names, as long as the difference remains: an array's
// elements in a JSON file, lines of another text.
void rg_search_entries(struct rg_search *search, const struct rg_param *param);

#endif
