// What a verification runs: techniques on devices, divided into units.
#ifndef RG_HARNESS_COMPARE_VERIFY_COURSE_H
#define RG_HARNESS_COMPARE_VERIFY_COURSE_H

#include "harness/compare/verify/shards.h"

struct rg_verify_subject {
    const struct rg_technique *technique;
    void *settings; // owned by the caller
};

struct rg_verify_course {
    const struct rg_verify_subject *subjects;
    int count;
    const struct rg_devices *devices;
    bool stages;             // only stages are compared
    struct rg_verify verify; // what all subjects have in common
    struct rg_verify_units units;
};

// Lists the units of a course, and chooses those of a shard. False, with one logged line, without
// memory.
bool rg_verify_choose(struct rg_verify_course *course, const struct rg_shard *shard);
// Reports the missing devices among the chosen units, and verifies the others.
void rg_verify_run_all(const struct rg_verify_course *course);

#endif
