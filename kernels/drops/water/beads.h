// The water that the glass holds at each cell, where trails break into beads: caps of DROPS_BEAD
// widths and heights, one at a chance place in each square of the pane.
#include "kernels/dialect/rng.h"
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS  OUT(1, float, held)
#include "kernels/dialect/slots/slots.h"

// The height of a square's bead at a place: a parabola, which a flat cap is.
RG_FN float bead_at(drops_params p, int column, int row, float x_mm, float y_mm)
{
    rg_uint4 words = rg_random(p.seed, rg_to_uint(column + 1), rg_to_uint(row + 1), DROPS_BEADS);
    float dx = x_mm - (rg_to_float(column) + rg_uniform(words.x)) * DROPS_BEAD_SQUARE_MM;
    float dy = y_mm - (rg_to_float(row) + rg_uniform(words.y)) * DROPS_BEAD_SQUARE_MM;
    float size = DROPS_BEAD_LEAST + (1.0f - DROPS_BEAD_LEAST) * rg_uniform(words.z);
    float radius = DROPS_BEAD_RADIUS_MM * size;
    float inside = 1.0f - (dx * dx + dy * dy) / (radius * radius);
    return DROPS_BEAD_MM * size * rg_max(inside, 0.0f);
}

// Beads are smaller than squares, so that those of the squares around are all that may reach here.
RG_GRID_KERNEL(drops_beads)
{
    float x_mm = (rg_to_float(x) + 0.5f) * p.cell_mm;
    float y_mm = (rg_to_float(y) + 0.5f) * p.cell_mm;
    int column = rg_to_int(x_mm * (1.0f / DROPS_BEAD_SQUARE_MM));
    int row = rg_to_int(y_mm * (1.0f / DROPS_BEAD_SQUARE_MM));
    float most = 0.0f;
    for (int i = -1; i <= 1; i++)
        for (int k = -1; k <= 1; k++)
            most = rg_max(most, bead_at(p, column + k, row + i, x_mm, y_mm));
    held_put(rg, drops_cell(p, x, y), most);
}
