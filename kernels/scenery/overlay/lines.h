// Lines of a width in pixels, through the world: edges of boxes and frusta. Ends are
// square, and reach half a width further, so that edges meet; sides and ends are smooth.
#include "kernels/dialect/draw/line.h"
#include "kernels/scenery/overlay/lines_params.h"

#define RG_PARAMS  scenery_lines_params
#define RG_SLOTS   IN(1, float, lines)
#define RG_CORNERS 4

RG_STRUCT(scenery_line)
{
    rgba colour;
    rg_line line;
    float reach; // from the axis to where the smooth side ends
};
#define RG_RECORD scenery_line
#include "kernels/dialect/draw/draw.h"

RG_FN float scenery_line_word(rg_ctx rg, int i, int word)
{
    return lines_at(rg, SCENERY_LINE_WORDS * i + word);
}

RG_FN rg_corner scenery_line_end(rg_ctx rg, scenery_lines_params p, int i, int word)
{
    return m4_project(p.to_clip,
                      v3_make(scenery_line_word(rg, i, word), scenery_line_word(rg, i, word + 1),
                              scenery_line_word(rg, i, word + 2)));
}

// The visible part of line i.
RG_FN scenery_line scenery_line_seen(rg_ctx rg, rg_draw_state draw, scenery_lines_params p, int i)
{
    scenery_line s;
    s.colour = rg_rgba(scenery_line_word(rg, i, 6), scenery_line_word(rg, i, 7),
                       scenery_line_word(rg, i, 8), scenery_line_word(rg, i, 9));
    s.line = rg_line_seen(draw, scenery_line_end(rg, p, i, 0), scenery_line_end(rg, p, i, 3),
                          SCENERY_WIDEST_PX);
    s.reach = 0.5f * rg_min(scenery_line_word(rg, i, 10), SCENERY_WIDEST_PX) + 0.5f;
    return s;
}

RG_DRAW_ITEM(streaks_lines)
{
    scenery_line s = scenery_line_seen(rg, draw, p, i);
    return rg_line_item(draw, s.line, s.reach);
}

RG_DRAW_RECORD(streaks_lines)
{
    return scenery_line_seen(rg, draw, p, i);
}

RG_DRAW_FRAGMENT(streaks_lines)
{
    float covered = rg_line_covered(r.line, px, py, r.reach);
    return rg_fragment_make(rg_rgba(r.colour.r * covered, r.colour.g * covered,
                                    r.colour.b * covered, r.colour.a * covered),
                            rg_line_depth(r.line, px, py));
}
