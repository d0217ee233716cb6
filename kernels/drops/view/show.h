// The height map in grey, or the ID map in colours that tell owners apart (figures 2 to 7).
#include "kernels/drops/params.h"
#include "kernels/drops/view/colour.h"
#include "kernels/drops/view/params.h"

#define RG_PARAMS drops_view_params
#define RG_SLOTS  IN(1, float, height) IN(2, uint, ids)
#include "kernels/dialect/draw/view_quad.h"

RG_DRAW_ITEM(drops_show)
{
    return view_quad();
}

RG_DRAW_RECORD(drops_show)
{
    return view_quad_record();
}

RG_DRAW_FRAGMENT(drops_show)
{
    int column = rg_to_int(rg_floor(p.first_column + (rg_to_float(px) + 0.5f) * p.cells_per_px));
    int row = rg_to_int(rg_floor(p.first_row + (rg_to_float(py) + 0.5f) * p.cells_per_px));
    bool is_on = column >= 0 && column < p.columns && row >= 0 && row < p.rows;
    int cell = (rg_iclamp(row, 0, p.rows - 1) + DROPS_MARGIN) * p.stride +
               rg_iclamp(column, 0, p.columns - 1) + DROPS_MARGIN;
    float grey = rg_min(height_at(rg, cell) / p.white_mm, 1.0f);
    rgba c = rg_rgba(grey, grey, grey, 1.0f);
    if (p.is_of_ids != 0)
        c = drops_colour_of(ids_at(rg, cell));
    return rg_fragment_make(is_on ? c : DROPS_BESIDE, 1.0f);
}
