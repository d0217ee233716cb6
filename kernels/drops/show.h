// The height map in grey, or the ID map in colours that tell owners apart (figures 2 to 7).
#include "kernels/drops/params.h"
#include "kernels/drops/show_params.h"

#define RG_PARAMS drops_show_params
#define RG_SLOTS  IN(1, float, height) IN(2, uint, ids)
#include "kernels/dialect/draw/view_quad.h"

RG_FN float channel_of(uint id, uint shift)
{
    uint mixed = id * 2654435761u;
    mixed = (mixed ^ (mixed >> 15)) * 2246822519u;
    return 0.25f + 0.75f * rg_to_float((mixed >> shift) & 255u) * (1.0f / 255.0f);
}

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
    uint id = ids_at(rg, cell);
    rgba c = rg_rgba(grey, grey, grey, 1.0f);
    if (p.is_of_ids != 0)
        c = id == 0u ? rg_rgba(0.0f, 0.0f, 0.0f, 1.0f)
                     : rg_rgba(channel_of(id, 0u), channel_of(id, 8u), channel_of(id, 16u), 1.0f);
    return rg_fragment_make(is_on ? c : rg_rgba(0.02f, 0.02f, 0.02f, 1.0f), 1.0f);
}
