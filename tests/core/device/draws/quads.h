// Seeded quads of every kind that a rasteriser may get wrong, for tests of DRAW passes.
#ifndef RG_TESTS_CORE_DEVICE_DRAWS_QUADS_H
#define RG_TESTS_CORE_DEVICE_DRAWS_QUADS_H

#include "tests/kernels/drawing/quads_params.h"

enum quad_kind {
    QUAD_STREAK,     // 0.2 to 2 px wide, inside
    QUAD_ON_CENTRES, // axis-aligned, edges on pixel centres
    QUAD_LARGE,      // up to 400 px
    QUAD_CROSSING,   // over an edge or a corner of the target
    QUAD_DEGENERATE, // no area: points, lines, folded
    QUAD_OFF,        // off the target
    QUAD_BEHIND,     // in perspective, some corners behind the eye
    QUAD_HUGE,       // coordinates up to a million times the target
    QUAD_NO_NUMBER,  // NaN and infinite corners
    QUAD_KINDS
};

// Fills `count` quads of TEST_QUAD_WORDS floats for a target of width x height. All are of kind
// `only`, or a mix of all kinds if it is QUAD_KINDS.
void quads_fill(float *quads, int count, int width, int height, enum quad_kind only, uint32_t seed);

#endif
