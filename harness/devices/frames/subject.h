// The input of opening a session, and the account that a session gives.
#ifndef RG_HARNESS_DEVICES_FRAMES_SUBJECT_H
#define RG_HARNESS_DEVICES_FRAMES_SUBJECT_H

#include "core/techniques/technique.h"
#include "harness/record/passport/program.h"

// The technique, settings and image size of a session. Owns nothing.
struct rg_subject {
    const struct rg_technique *technique;
    const void *settings;
    int width, height; // pixels
};

// An instance's current account of itself.
struct rg_account {
    int64_t frame; // frames simulated
    int counter_count;
    struct rg_counter counters[RG_MAX_COUNTERS];
    int fact_count;
    struct rg_fact facts[RG_MAX_FACTS];
};

// Identifies the code that runs for an instance; equal code gives equal values. It is for
// information only.
struct rg_session_code {
    char program[RG_BUILD_ID_SIZE]; // raingauge itself
    uint64_t libraries;             // including drivers
    struct {
        uint64_t hash;
        int64_t bytes; // 0: the API returns none
    } passes;          // code that the driver's compiler has made
};

// --- files of the user's own that its settings name ---

// Whether a parameter's value is a file of the user's, rather than a model or map of a package.
bool rg_file_is_own(const char *value);
// Finds the next parameter with such a file, from index `at` in the technique's table on, and
// advances `at`; `value` gets the file. NULL: there is none.
const struct rg_param *rg_file_own_next(const struct rg_subject *subject, int *at,
                                        char value[RG_PATH_SIZE]);
// Whether writing `output` replaces none of these files. False, and one logged line, if it does.
bool rg_files_spared_by(const struct rg_subject *subject, const char *output);

#endif
