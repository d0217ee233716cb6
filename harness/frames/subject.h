// What a session is opened with, and what it tells of itself.
#ifndef RG_HARNESS_FRAMES_SUBJECT_H
#define RG_HARNESS_FRAMES_SUBJECT_H

#include "core/techniques/technique.h"
#include "harness/record/passport/program.h"

// What is opened, and for how large an image. Nothing in it is owned.
struct rg_subject {
    const struct rg_technique *technique;
    const void *settings;
    int width, height; // pixels
};

// What an instance tells of itself now.
struct rg_account {
    int64_t frame; // frames simulated
    int counter_count;
    struct rg_counter counters[RG_MAX_COUNTERS];
    int fact_count;
    struct rg_fact facts[RG_MAX_FACTS];
};

// What runs for an instance: equal where the same code does. It is told of, and decides nothing.
struct rg_session_code {
    char program[RG_BUILD_ID_SIZE]; // raingauge itself
    uint64_t libraries;             // drivers among them
    struct {
        uint64_t hash;
        int64_t bytes; // 0: the API hands none out
    } passes;          // what the driver's compiler has made of them
};

// --- files of the user's own that its settings name ---

// Whether a value of a parameter names a file of the user's own, and not a model or a map.
bool rg_file_is_own(const char *value);
// The next parameter that names such a file, from the place `at` in the technique's table on, which
// is moved behind it; `value` gets the file. NULL: there is none.
const struct rg_param *rg_file_own_next(const struct rg_subject *subject, int *at,
                                        char value[RG_PATH_SIZE]);
// Whether what is written there replaces none of them. False, and one logged line.
bool rg_files_spared_by(const struct rg_subject *subject, const char *output);

#endif
