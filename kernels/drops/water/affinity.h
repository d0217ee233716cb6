// Each cell's affinity to water (table 1: f), by which drops choose their way where all is dry. It
// is drawn once for each square of the pane; by the paper's rules a square is a cell.
#include "kernels/drops/chance.h"
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS  OUT(1, float, affinity)
#include "kernels/dialect/slots/slots.h"

RG_FN uint patch_of(drops_params p, int cell)
{
    return rg_to_uint(rg_to_int((rg_to_float(cell) + 0.5f) * p.cell_mm / p.patch_mm));
}

RG_GRID_KERNEL(drops_affinity)
{
    rg_uint4 words = rg_random(p.seed, patch_of(p, x), patch_of(p, y), DROPS_AFFINITY);
    affinity_put(rg, drops_cell(p, x, y), rg_clamp(drops_normal(words, 0.5f, 1.5f), 0.0f, 1.0f));
}
