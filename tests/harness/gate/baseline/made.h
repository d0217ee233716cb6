// A made baseline of two devices and two cells, whose numbers are all different.
#ifndef RG_TESTS_HARNESS_GATE_BASELINE_MADE_H
#define RG_TESTS_HARNESS_GATE_BASELINE_MADE_H

#include "harness/compare/gate/baseline/baseline.h"

#define SHA_A "0123456789abcdef"
#define SHA_B "fedcba9876543210"

// Rows: rain and flow on gl, rain and flow on vulkan. Each timed row has 24 launches that scatter
// by about a hundredth. The caller frees it.
struct rg_baseline made_baseline(void);
// The launches of a frame that takes about so long.
struct rg_launches made_launches(double ms);

#endif
