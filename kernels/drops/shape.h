// A drop's shape on the height map: hemispheres (eqs. 7 to 9).
#ifndef RG_KERNELS_DROPS_SHAPE_H
#define RG_KERNELS_DROPS_SHAPE_H

#include "kernels/dialect/math.h"
#include "kernels/drops/params.h"

// Eq. 7: a hemisphere of water, 1 mg the cubic mm.
RG_FN float drops_radius_mm(uint mass)
{
    return rg_cbrt(drops_mg(mass) * 0.47746483f); // 3 / (2 pi)
}

// The squared distance of a cell's middle from a place.
RG_FN float drops_distance2(drops_params p, int column, int row, float x, float y)
{
    float dx = (rg_to_float(column) + 0.5f) * p.cell_mm - x;
    float dy = (rg_to_float(row) + 0.5f) * p.cell_mm - y;
    return dx * dx + dy * dy;
}

// A drop's way in a substep.
RG_STRUCT(drops_way)
{
    float x;
    float y;
    float along_x; // unit vector; 0 if the drop did not move
    float along_y;
    float far; // its length
    float radius;
    int places; // of hemispheres, the last one at the end of the way
};
RG_STRUCT_SIZE(drops_way, 7)

RG_FN drops_way drops_way_of(drops_params p, uint mass, float x0, float y0, float x1, float y1)
{
    float dx = x1 - x0;
    float dy = y1 - y0;
    drops_way w;
    w.x = x0;
    w.y = y0;
    w.far = rg_sqrt(dx * dx + dy * dy);
    float scale = w.far > 0.0f ? 1.0f / w.far : 0.0f;
    w.along_x = dx * scale;
    w.along_y = dy * scale;
    w.radius = drops_radius_mm(mass);
    w.places = p.lines != 0 ? 1 : rg_to_int(rg_min(w.far / p.spacing_mm, 4096.0f)) + 1;
    return w;
}

// The place of a hemisphere along the way.
RG_FN float drops_place_of(drops_params p, drops_way w, int place)
{
    return place == w.places - 1 ? w.far : rg_to_float(place + 1) * p.spacing_mm;
}

// The water's height at a cell: of one of the way's hemispheres, or of one swept along the way if
// p.lines. 0: none.
RG_FN float drops_height(drops_params p, drops_way w, int place, int column, int row)
{
    float t = drops_place_of(p, w, place);
    if (p.lines != 0) {
        float dx = (rg_to_float(column) + 0.5f) * p.cell_mm - w.x;
        float dy = (rg_to_float(row) + 0.5f) * p.cell_mm - w.y;
        t = rg_clamp(dx * w.along_x + dy * w.along_y, 0.0f, w.far);
    }
    float d2 = drops_distance2(p, column, row, w.x + w.along_x * t, w.y + w.along_y * t);
    float h2 = w.radius * w.radius - d2;
    return h2 > 0.0f ? rg_sqrt(h2) : 0.0f;
}

// The cells that a hemisphere, or one swept along the way, may cover.
RG_STRUCT(drops_block)
{
    int left;
    int top;
    int right; // the last column
    int bottom;
};
RG_STRUCT_SIZE(drops_block, 4)

RG_FN drops_block drops_block_around(drops_params p, float x0, float y0, float x1, float y1,
                                     float radius)
{
    float cells = 1.0f / p.cell_mm;
    drops_block b;
    b.left = rg_imax(rg_to_int(rg_floor(rg_max((rg_min(x0, x1) - radius) * cells, 0.0f))), 0);
    b.top = rg_imax(rg_to_int(rg_floor(rg_max((rg_min(y0, y1) - radius) * cells, 0.0f))), 0);
    b.right =
        rg_imin(rg_to_int(rg_clamp((rg_max(x0, x1) + radius) * cells, -1.0f, 1e6f)), p.columns - 1);
    b.bottom =
        rg_imin(rg_to_int(rg_clamp((rg_max(y0, y1) + radius) * cells, -1.0f, 1e6f)), p.rows - 1);
    return b;
}

RG_FN drops_block drops_block_of(drops_params p, drops_way w, int place)
{
    float t = drops_place_of(p, w, place);
    float from = p.lines != 0 ? 0.0f : t;
    return drops_block_around(p, w.x + w.along_x * from, w.y + w.along_y * from,
                              w.x + w.along_x * t, w.y + w.along_y * t, w.radius);
}

#endif
