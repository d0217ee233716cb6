// The slopes of puddles (kernels/cartoon/water/puddles.h) are those of their level, by differences
// between places beside each other.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "backends/cpu/kernels/notes.h"
#include "kernels/cartoon/water/puddles.h"
#include "tests/tools/expect.h"

enum { COLUMNS = CARTOON_COLUMNS * CARTOON_COLUMNS, PLACES = 2000 };

static double level_at(rg_ctx rg, cartoon_water_params p, double x, double z)
{
    return (double)cartoon_puddle_at(rg, p, v3_make((float)x, 0, (float)z)).level;
}

static void slopes_are_those_of_the_level(void **state)
{
    (void)state;
    static uint water[COLUMNS];
    static float beds[COLUMNS];
    struct rg_notes notes = {0};
    uint chance = 1;
    for (int i = 0; i < COLUMNS; i++) {
        chance = chance * 1664525u + 1013904223u;
        water[i] = chance >> 22;
        beds[i] = 0.5f + (float)(chance >> 8 & 255) / 256;
    }
    const rg_ctx rg = {.water = water, .beds = beds, .notes = &notes};
    // Columns of 1/8 and 1/4 m, so that all places are exact.
    const cartoon_water_params p = {
        .low_x = -8, .low_z = -16, .per_column_x = 8, .per_column_z = 4, .per_unit = 0.01f};
    for (int i = 0; i < PLACES; i++) {
        chance = chance * 1664525u + 1013904223u;
        // Inside a square between the middles of four columns, an eighth of a column from its sides
        // at least.
        const double u = (double)(chance >> 25) + 0.625 + (double)(chance >> 8 & 63) / 84;
        const double v = (double)(chance >> 18 & 127) + 0.625 + (double)(chance >> 2 & 63) / 84;
        const double x = -8 + u / 8, z = -16 + v / 4, step = 1 / 16.0; // of a column
        const cartoon_puddle w = cartoon_puddle_at(rg, p, v3_make((float)x, 0, (float)z));
        const double along_x =
            (level_at(rg, p, x + step / 8, z) - level_at(rg, p, x - step / 8, z)) / (step / 4);
        const double along_z =
            (level_at(rg, p, x, z + step / 4) - level_at(rg, p, x, z - step / 4)) / (step / 2);
        assert_at_most(fabs((double)w.slope_x - along_x), 0.01 * (1 + fabs(along_x)));
        assert_at_most(fabs((double)w.slope_z - along_z), 0.01 * (1 + fabs(along_z)));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(slopes_are_those_of_the_level)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
