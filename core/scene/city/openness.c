// The visible share of the sky at the points of a grid over the city, which is also the share of an
// overcast sky's light there.
#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/scene/city/city.h"
#include "kernels/scenery/openness_grid.h"

enum { SIDE = SCENERY_OPEN_SIDE, LEVELS = SCENERY_OPEN_LEVELS, WAYS = 16, FARTHEST_CELLS = 30 };

// The height of the geometry at each grid point.
static void find_heights(const struct city *city, float heights[SIDE][SIDE])
{
    for (int z = 0; z < SIDE; z++) {
        for (int x = 0; x < SIDE; x++) {
            const float at[2] = {SCENERY_OPEN_LOW_M + SCENERY_OPEN_CELL_M * (float)x,
                                 SCENERY_OPEN_LOW_M + SCENERY_OPEN_CELL_M * (float)z};
            heights[z][x] = 0;
            for (int i = 0; i < city->box_count; i++) {
                const struct city_box *b = &city->boxes[i];
                if (at[0] >= b->low[0] && at[0] <= b->high[0] && at[1] >= b->low[2] &&
                    at[1] <= b->high[2])
                    heights[z][x] = rg_max(heights[z][x], b->high[1]);
            }
        }
    }
}

// The share of the sky over each level of a grid point: in each direction the sky begins above the
// steepest thing in sight.
static void find_column(float heights[SIDE][SIDE], int x, int z, float open[LEVELS])
{
    for (int level = 0; level < LEVELS; level++)
        open[level] = 0;
    for (int way = 0; way < WAYS; way++) {
        const float angle = (float)(2 * M_PI) * ((float)way + 0.5f) / WAYS;
        const float dx = (float)cos((double)angle), dz = (float)sin((double)angle);
        float steepest[LEVELS] = {0};
        for (int step = 1; step <= FARTHEST_CELLS; step++) {
            const int at_x = (int)lrintf((float)x + dx * (float)step);
            const int at_z = (int)lrintf((float)z + dz * (float)step);
            if (at_x < 0 || at_x >= SIDE || at_z < 0 || at_z >= SIDE)
                break;
            const float height = heights[at_z][at_x];
            const float over = 1 / (SCENERY_OPEN_CELL_M * (float)step);
            // Things that end below a level hide no sky from it, and most points are streets.
            for (int level = 0; level < LEVELS && height > SCENERY_OPEN_CELL_M * (float)level;
                 level++)
                steepest[level] =
                    rg_max(steepest[level], (height - SCENERY_OPEN_CELL_M * (float)level) * over);
        }
        for (int level = 0; level < LEVELS; level++)
            open[level] += 1 - steepest[level] / sqrtf(1 + steepest[level] * steepest[level]);
    }
}

bool city_openness(const struct city *city, uint32_t *words)
{
    uint8_t *points = rg_alloc(SCENERY_OPEN_WORDS, 1, "city");
    float(*heights)[SIDE] = points ? rg_alloc(SIDE, sizeof(*heights), "city") : NULL;
    if (heights)
        find_heights(city, heights);
#pragma omp parallel for schedule(dynamic, 1)
    for (int z = 0; z < (heights ? SIDE : 0); z++) {
        for (int x = 0; x < SIDE; x++) {
            float open[LEVELS];
            find_column(heights, x, z, open);
            for (int level = 0; level < LEVELS; level++)
                points[(level * SIDE + z) * SIDE + x] =
                    (uint8_t)(open[level] * (255.0f / WAYS) + 0.5f);
        }
    }
    for (int i = 0; heights && i < SCENERY_OPEN_WORDS; i++) {
        const int right = i % SIDE < SIDE - 1 ? 1 : 0,
                  below = i / SIDE % SIDE < SIDE - 1 ? SIDE : 0;
        words[i] = points[i] | (uint32_t)points[i + right] << 8 |
                   (uint32_t)points[i + below] << 16 | (uint32_t)points[i + below + right] << 24;
    }
    const bool ok = heights != NULL;
    free(heights);
    free(points);
    return ok;
}
