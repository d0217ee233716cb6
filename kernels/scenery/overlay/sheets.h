// streaks: flat sheets of one colour through the world: the planes of the overlay.
#include "kernels/scenery/overlay/lines_params.h"
#include "kernels/dialect/draw/triangle.h"

#define RG_PARAMS  streaks_lines_params
#define RG_SLOTS   IN(1, float, sheets)
#define RG_CORNERS 4

RG_STRUCT(streaks_sheet)
{
    rg_planes planes;
    rgba colour;
};
#define RG_RECORD streaks_sheet
#include "kernels/dialect/draw/draw.h"

RG_FN float streaks_sheet_word(rg_ctx rg, int i, int word)
{
    return sheets_at(rg, STREAKS_SHEET_WORDS * i + word);
}

RG_FN rg_corner streaks_sheet_corner(rg_ctx rg, streaks_lines_params p, int i, int corner)
{
    return m4_project(p.to_clip, v3_make(streaks_sheet_word(rg, i, 3 * corner),
                                         streaks_sheet_word(rg, i, 3 * corner + 1),
                                         streaks_sheet_word(rg, i, 3 * corner + 2)));
}

RG_DRAW_ITEM(streaks_sheets)
{
    rg_item t;
    t.alive = 1;
    t.a = streaks_sheet_corner(rg, p, i, 0);
    t.b = streaks_sheet_corner(rg, p, i, 1);
    t.c = streaks_sheet_corner(rg, p, i, 2);
    t.d = streaks_sheet_corner(rg, p, i, 3);
    return t;
}

RG_DRAW_RECORD(streaks_sheets)
{
    rg_item t;
    t.alive = 1;
    t.a = streaks_sheet_corner(rg, p, i, 0);
    t.b = streaks_sheet_corner(rg, p, i, 1);
    t.c = streaks_sheet_corner(rg, p, i, 2);
    t.d = t.c;
    streaks_sheet s;
    s.planes = rg_planes_of(draw, t);
    s.planes.nearest = 0.0f; // the fourth corner may be nearer, or farther
    s.planes.farthest = 1.0f;
    s.colour = rg_rgba(streaks_sheet_word(rg, i, 12), streaks_sheet_word(rg, i, 13),
                       streaks_sheet_word(rg, i, 14), streaks_sheet_word(rg, i, 15));
    return s;
}

RG_DRAW_FRAGMENT(streaks_sheets)
{
    return rg_fragment_make(r.colour, rg_planes_depth(r.planes, px, py));
}
