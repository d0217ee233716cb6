// The grid of openness.h, for host and kernels alike. Word (x, z, level) holds the points
// (x, z), (x + 1, z), (x, z + 1) and (x + 1, z + 1), 8 bits each, the first lowest; a point is
// SCENERY_OPEN_CELL_M from the next, the first one at (LOW, 0, LOW).
#ifndef RG_KERNELS_SCENERY_OPENNESS_GRID_H
#define RG_KERNELS_SCENERY_OPENNESS_GRID_H

#define SCENERY_OPEN_SIDE   101
#define SCENERY_OPEN_LEVELS 60
#define SCENERY_OPEN_CELL_M 4.0f
#define SCENERY_OPEN_LOW_M  -200.0f
#define SCENERY_OPEN_WORDS  (SCENERY_OPEN_SIDE * SCENERY_OPEN_SIDE * SCENERY_OPEN_LEVELS)

#endif
