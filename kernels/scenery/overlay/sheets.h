// Flat sheets of one colour in the world: the planes of the overlay.
#include "kernels/scenery/overlay/lines_params.h"
#include "kernels/dialect/draw/triangle.h"

#define RG_PARAMS  scenery_lines_params
#define RG_SLOTS   IN(1, float, sheets)
#define RG_CORNERS 4

RG_STRUCT(scenery_sheet)
{
    rg_planes planes;
    rgba colour;
};
#define RG_RECORD scenery_sheet
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

RG_FN float scenery_sheet_word(rg_ctx rg, int i, int word)
{
    return sheets_at(rg, SCENERY_SHEET_WORDS * i + word);
}

RG_FN rg_corner scenery_sheet_corner(rg_ctx rg, scenery_lines_params p, int i, int corner)
{
    return m4_project(p.to_clip, v3_make(scenery_sheet_word(rg, i, 3 * corner),
                                         scenery_sheet_word(rg, i, 3 * corner + 1),
                                         scenery_sheet_word(rg, i, 3 * corner + 2)));
}

RG_DRAW_ITEM(streaks_sheets)
{
    rg_item t;
    t.alive = 1;
    t.a = scenery_sheet_corner(rg, p, i, 0);
    t.b = scenery_sheet_corner(rg, p, i, 1);
    t.c = scenery_sheet_corner(rg, p, i, 2);
    t.d = scenery_sheet_corner(rg, p, i, 3);
    return t;
}

RG_DRAW_RECORD(streaks_sheets)
{
    rg_item t;
    t.alive = 1;
    t.a = scenery_sheet_corner(rg, p, i, 0);
    t.b = scenery_sheet_corner(rg, p, i, 1);
    t.c = scenery_sheet_corner(rg, p, i, 2);
    t.d = t.c;
    scenery_sheet s;
    s.planes = rg_planes_of(draw, t);
    s.planes.nearest = 0.0f; // the fourth corner may be nearer, or farther
    s.planes.farthest = 1.0f;
    s.colour = rg_rgba(scenery_sheet_word(rg, i, 12), scenery_sheet_word(rg, i, 13),
                       scenery_sheet_word(rg, i, 14), scenery_sheet_word(rg, i, 15));
    return s;
}

RG_DRAW_FRAGMENT(streaks_sheets)
{
    return rg_fragment_make(r.colour, rg_planes_depth(r.planes, px, py));
}
