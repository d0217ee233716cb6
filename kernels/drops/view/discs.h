// Drops as discs of their radius over the height map (figure 2): running ones are orange, resting
// ones blue.
#include "kernels/drops/shape.h"
#include "kernels/drops/view/params.h"

#define RG_PARAMS drops_view_params
#define RG_SLOTS  IN(1, drops_drop, drops) IN(2, uint, tally)

RG_STRUCT(drops_disc)
{
    float x_px; // of its middle
    float y_px;
    float radius_px;
    int runs;
};
#define RG_CORNERS 4
#define RG_RECORD  drops_disc
#include "kernels/dialect/draw/draw.h"

RG_FN drops_disc disc_of(drops_view_params p, drops_drop d)
{
    float px_mm = 1.0f / (p.cell_mm * p.cells_per_px);
    drops_disc c;
    c.x_px = d.x * px_mm - p.first_column / p.cells_per_px;
    c.y_px = d.y * px_mm - p.first_row / p.cells_per_px;
    c.radius_px = rg_max(drops_radius_mm(d.mass) * px_mm, p.least_px);
    c.runs = d.mass > p.critical ? 1 : 0;
    return c;
}

RG_FN rg_corner disc_corner(drops_view_params p, drops_disc c, float right, float down)
{
    float x = c.x_px + right * (c.radius_px + 1.0f);
    float y = c.y_px + down * (c.radius_px + 1.0f);
    return rg_corner_make(2.0f * x / rg_to_float(p.width) - 1.0f,
                          2.0f * y / rg_to_float(p.height) - 1.0f, 0.5f, 1.0f);
}

RG_DRAW_ITEM(drops_discs)
{
    drops_disc c = disc_of(p, drops_at(rg, i));
    rg_item t;
    t.alive = i < rg_to_int(tally_at(rg, DROPS_COUNT)) ? 1 : 0;
    t.a = disc_corner(p, c, -1.0f, -1.0f);
    t.b = disc_corner(p, c, -1.0f, 1.0f);
    t.c = disc_corner(p, c, 1.0f, 1.0f);
    t.d = disc_corner(p, c, 1.0f, -1.0f);
    return t;
}

RG_DRAW_RECORD(drops_discs)
{
    return disc_of(p, drops_at(rg, i));
}

RG_DRAW_FRAGMENT(drops_discs)
{
    float dx = rg_to_float(px) + 0.5f - r.x_px;
    float dy = rg_to_float(py) + 0.5f - r.y_px;
    float alpha = 0.9f * rg_clamp(r.radius_px + 0.5f - rg_sqrt(dx * dx + dy * dy), 0.0f, 1.0f);
    float red = r.runs != 0 ? 1.0f : 0.02f;
    float green = r.runs != 0 ? 0.25f : 0.2f;
    float blue = r.runs != 0 ? 0.02f : 1.0f;
    return rg_fragment_make(rg_rgba(red * alpha, green * alpha, blue * alpha, alpha), 0.0f);
}
