// A search for the least: the best run until now, and tries of other ones. Only files of this
// folder include this.
#ifndef RG_HARNESS_COMPARE_SHRINK_SEARCH_H
#define RG_HARNESS_COMPARE_SHRINK_SEARCH_H

#include "harness/compare/blame/fall.h"
#include "harness/compare/shrink/shrink.h"
#include "harness/devices/frames/session.h"

struct rg_search {
    const struct rg_shrink_request *asked;
    struct rg_digest_run best;  // its settings are owned
    struct rg_blame blame;      // of the best
    struct rg_fall fall;        // how the device fails, where that is the difference
    struct rg_session *held[2]; // of the best, so that what instances share is made once
    double end_ms;
    int tried;
    int files;     // that have been made
    bool is_over;  // a device has failed
    bool has_none; // nothing differs that could be reduced
    char why[300];
};

// Begins with what is asked for. False, and one logged line, where nothing differs or a device
// fails. rg_search_end in either case; the best's settings stay the caller's.
bool rg_search_begin(struct rg_search *search, const struct rg_shrink_request *asked);
void rg_search_end(struct rg_search *search);

// Takes a run for the best if the difference is still the same and it weighs at most so much. It
// owns the run's settings, NULL where they were refused.
bool rg_search_try(struct rg_search *search, struct rg_digest_run run, int64_t most_weight);
// The best with another value of a parameter, unless it has it already.
bool rg_search_value(struct rg_search *search, const struct rg_param *param, const char *value,
                     int64_t most_weight);

// Makes a user's own file smaller that a parameter names: entries of the arrays of a JSON file,
// lines of another text, as long as that keeps the difference.
void rg_search_entries(struct rg_search *search, const struct rg_param *param);

#endif
