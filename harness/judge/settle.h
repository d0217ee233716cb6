// Settles over launches whether quantities lie where a claim needs them.
//
// The unit is a launch: a new process, which gives one value for each part of the claim. A part
// holds if its median lies between two bounds. The interval is that of the sign test, over groups
// of launches if neighbours are correlated. A claim is looked at after 12, 24, 48 and 96 launches,
// which share the error. If it holds or fails, as many launches again have to confirm it. The
// caller leaves out launches that others disturbed.
#ifndef RG_HARNESS_JUDGE_SETTLE_H
#define RG_HARNESS_JUDGE_SETTLE_H

#include <stdbool.h>

#include "core/base/stats.h"

enum { RG_SETTLE_LOOKS = 4, RG_SETTLE_LAUNCHES = 192 };

// How to settle; fixed before the first launch.
struct rg_settle_rule {
    double error; // probability, two-sided, that a claim is wrongly found to hold or to fail in one
                  // course without its confirmation; looks share it
    double near;  // log of the factor within which an interval is at the bound: log 1.05
    int look_count, looks[RG_SETTLE_LOOKS]; // rising: numbers of launches
};
extern const struct rg_settle_rule rg_settle_rule;

// A part of a claim. It holds if the median of its values is between the bounds.
struct rg_settle_part {
    const double *values; // logarithms of ratios, one a launch, in the order of launches
    double least, most;   // -INFINITY, INFINITY: no such bound
};

// How a claim's parts are joined.
enum rg_settle_join {
    RG_SETTLE_ALL, // the claim holds if all parts do
    RG_SETTLE_ANY, // it holds if one part does not: the opposite of ALL
};

enum rg_settled {
    RG_SETTLED_HOLDS,
    RG_SETTLED_FAILS,
    RG_SETTLED_AT_BOUND, // its intervals lie within `near` of the bounds that they contain
    RG_SETTLED_OPEN,
};

struct rg_settling {
    enum rg_settled settled;
    int launches;          // launches that were looked at
    int more;              // open: launches until the next look; 0: no look is left
    int part;              // the part that decided, or that is still open
    struct rg_interval of; // its median and interval at the last look; ends NAN: too few launches
    double spread;         // robust standard deviation of a launch's value, of that part
    int needed;            // open: launches that would probably settle it, a look's number
    bool is_unconfirmed;   // open: the second half contradicts the first, or does not settle
};

// Settles a claim by its parts (at least one), all of them with values of the same launches, of
// which at most RG_SETTLE_LAUNCHES count.
struct rg_settling rg_settle(const struct rg_settle_rule *rule, enum rg_settle_join join,
                             const struct rg_settle_part *parts, int part_count, int launches);

// The same for a single launch, or for medians: without interval, course and confirmation. HOLDS,
// FAILS, or AT_BOUND if a part that decides is within `near` of its bound.
enum rg_settled rg_settle_once(const struct rg_settle_rule *rule, enum rg_settle_join join,
                               const struct rg_settle_part *parts, int part_count, int *part);

#endif
