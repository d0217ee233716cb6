// Compares a cell's two sides. Only cells whose sides agree are timed.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_AGREE_H
#define RG_HARNESS_COMPARE_GATE_RUN_AGREE_H

#include "harness/compare/gate/run/cases.h"

// Runs a case's cell on its open sides, and compares its picture by the tier that the two owe each
// other, its states bit for bit where that is T0, and its counters and the work of a frame exactly.
// A baseline has a digest in place of a picture: if it differs, cpu:reference draws the true
// picture now. Fills in the agreement; if the case agrees, its message holds remarks. Pictures that
// differ are written into `folder` under the case's name (harness/compare/gate/pictures/); NULL:
// they are not.
void rg_gate_agree(struct rg_gate_case *of, struct rg_truth *truth, const char *folder);

// Ends a case with the last error, because its side could not be launched.
void rg_gate_agree_fails(struct rg_gate_case *of, const char *device);

// Adds how long a frame takes, compared with a baseline of another machine key by the yardsticks,
// which took `then` and take `now` (RG_YARDSTICKS of each). This is advice and fails nothing.
void rg_gate_advise(const struct rg_gate_row *row, const struct rg_timed_cell *timed,
                    const struct rg_launches *then, const struct rg_launches *now,
                    struct rg_agreement *agreement);

#endif
