// The verdicts of a bisect on disk, so that the same command goes on where it was interrupted.
#ifndef RG_HARNESS_COMPARE_BISECT_KEPT_H
#define RG_HARNESS_COMPARE_BISECT_KEPT_H

#include "harness/compare/bisect/bisect.h"

// Where those of a bisect lie: a file in raingauge's folder of the user's state (XDG_STATE_HOME)
// whose name has a hash of the command, its settings, the candidates and the current folder. It is
// a sealed document (harness/record/disk/seal.h), with a key: all of these, this raingauge, the
// machine and its environment. "": nowhere.
struct rg_bisect_kept {
    char folder[1024], name[64];
};
void rg_bisect_kept_find(const struct rg_bisect *bisect, struct rg_bisect_kept *kept);

// Takes the verdicts that are there, in their order, and tells how many. A file that is damaged or
// of another key is not taken, nor is the verdict of a candidate that has changed on disk since; of
// the good end, none is.
int64_t rg_bisect_kept_take(const struct rg_bisect_kept *kept, struct rg_bisect *bisect);
// Writes all that there are. False, and one logged line, where it cannot.
bool rg_bisect_kept_write(const struct rg_bisect_kept *kept, const struct rg_bisect *bisect);
void rg_bisect_kept_remove(const struct rg_bisect_kept *kept);

#endif
