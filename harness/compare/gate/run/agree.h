// Compares a cell's two sides. Only cells whose sides agree are timed.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_AGREE_H
#define RG_HARNESS_COMPARE_GATE_RUN_AGREE_H

#include "harness/compare/gate/run/cases.h"

// Runs a case's cell on its open sides and compares them: the picture by the tier that the two owe
// each other, states bit for bit if that is T0, counters and a frame's work exactly. A baseline has
// a digest in place of a picture; if it differs, cpu:reference draws the true picture now.
//
// Fills in the agreement; if the case agrees, its message holds remarks. Pictures that differ are
// written into `folder` under the case's name (harness/compare/gate/pictures/); NULL: none are.
void rg_gate_agree(struct rg_gate_case *of, struct rg_truth *truth, const char *folder);

// Ends a case with the last error, because its side could not be launched.
void rg_gate_agree_fails(struct rg_gate_case *of, const char *device);

// Adds a frame's time compared with a baseline of another comparison key. Yardsticks, which took
// `then` and take `now` (RG_YARDSTICKS of each), make the times comparable. This is advice and
// fails nothing.
void rg_gate_advise(const struct rg_gate_row *row, const struct rg_timed_cell *timed,
                    const struct rg_launches *then, const struct rg_launches *now,
                    struct rg_agreement *agreement);

#endif
