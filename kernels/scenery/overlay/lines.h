// Lines of a width in pixels, through the world: edges of boxes and frusta. Ends are
// square, and reach half a width further, so that edges meet; sides and ends are smooth.
#include "kernels/scenery/overlay/lines_params.h"

#define RG_PARAMS  scenery_lines_params
#define RG_SLOTS   IN(1, float, lines)
#define RG_CORNERS 4

// A line as the viewer sees it: pixels from the target's corner.
RG_STRUCT(scenery_line)
{
    rgba colour;
    float x; // where it begins
    float y;
    float along_x; // its direction, of unit length
    float along_y;
    float length_px;
    float reach;       // from the axis to where the smooth side ends
    float depth;       // where it begins
    float depth_there; // where it ends
    int alive;
};
#define RG_RECORD scenery_line
#include "kernels/dialect/draw/draw.h"

// The part of a line that planes have left, from 0 to 1.
RG_STRUCT(scenery_part)
{
    float from;
    float to;
};

// Cuts off what lies outside of a plane: `a` and `b` tell how far inside the ends are.
RG_FN scenery_part scenery_part_inside(scenery_part part, float a, float b)
{
    float fall = a - b;
    float at = a / (rg_abs(fall) > 1e-30f ? fall : 1.0f);
    scenery_part inside;
    inside.from = rg_max(part.from, a < 0.0f ? (b < 0.0f ? 2.0f : at) : 0.0f);
    inside.to = rg_min(part.to, b < 0.0f ? at : 1.0f);
    return inside;
}

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

// What is seen of line i: cut at the near plane and a little beyond the target's sides, so that the
// rest is near enough for a float to place it.
RG_FN scenery_line scenery_line_seen(rg_ctx rg, rg_draw_state draw, scenery_lines_params p, int i)
{
    rg_corner a = scenery_line_end(rg, p, i, 0);
    rg_corner b = scenery_line_end(rg, p, i, 3);
    float across = (draw.half_width + SCENERY_WIDEST_PX) / draw.half_width;
    float down = (draw.half_height + SCENERY_WIDEST_PX) / draw.half_height;
    scenery_part part;
    part.from = 0.0f;
    part.to = 1.0f;
    part = scenery_part_inside(part, a.z, b.z);
    part = scenery_part_inside(part, a.w * across + a.x, b.w * across + b.x);
    part = scenery_part_inside(part, a.w * across - a.x, b.w * across - b.x);
    part = scenery_part_inside(part, a.w * down + a.y, b.w * down + b.y);
    part = scenery_part_inside(part, a.w * down - a.y, b.w * down - b.y);
    float from_w = 1.0f / rg_max(a.w + (b.w - a.w) * part.from, RG_LEAST_W);
    float to_w = 1.0f / rg_max(a.w + (b.w - a.w) * part.to, RG_LEAST_W);
    scenery_line s;
    s.colour = rg_rgba(scenery_line_word(rg, i, 6), scenery_line_word(rg, i, 7),
                       scenery_line_word(rg, i, 8), scenery_line_word(rg, i, 9));
    s.x = ((a.x + (b.x - a.x) * part.from) * from_w + 1.0f) * draw.half_width;
    s.y = ((a.y + (b.y - a.y) * part.from) * from_w + 1.0f) * draw.half_height;
    float x = ((a.x + (b.x - a.x) * part.to) * to_w + 1.0f) * draw.half_width - s.x;
    float y = ((a.y + (b.y - a.y) * part.to) * to_w + 1.0f) * draw.half_height - s.y;
    s.length_px = rg_sqrt(x * x + y * y);
    float over_length = 1.0f / rg_max(s.length_px, 1e-6f);
    s.along_x = s.length_px > 1e-6f ? x * over_length : 1.0f;
    s.along_y = s.length_px > 1e-6f ? y * over_length : 0.0f;
    s.reach = 0.5f * rg_min(scenery_line_word(rg, i, 10), SCENERY_WIDEST_PX) + 0.5f;
    s.depth = (a.z + (b.z - a.z) * part.from) * from_w;
    s.depth_there = (a.z + (b.z - a.z) * part.to) * to_w;
    s.alive = part.from <= part.to ? 1 : 0;
    return s;
}

// A corner of the line's rectangle, so far along it and beside it from its beginning.
RG_FN rg_corner scenery_line_corner(rg_draw_state draw, scenery_line s, float along, float beside)
{
    float x = s.x + s.along_x * along - s.along_y * beside;
    float y = s.y + s.along_y * along + s.along_x * beside;
    return rg_corner_make(x / draw.half_width - 1.0f, y / draw.half_height - 1.0f, 0.5f, 1.0f);
}

RG_DRAW_ITEM(streaks_lines)
{
    scenery_line s = scenery_line_seen(rg, draw, p, i);
    float end = s.length_px + s.reach;
    rg_item t;
    t.alive = s.alive;
    t.a = scenery_line_corner(draw, s, -s.reach, -s.reach);
    t.b = scenery_line_corner(draw, s, -s.reach, s.reach);
    t.c = scenery_line_corner(draw, s, end, s.reach);
    t.d = scenery_line_corner(draw, s, end, -s.reach);
    return t;
}

RG_DRAW_RECORD(streaks_lines)
{
    return scenery_line_seen(rg, draw, p, i);
}

RG_DRAW_FRAGMENT(streaks_lines)
{
    float x = rg_to_float(px) + 0.5f - r.x;
    float y = rg_to_float(py) + 0.5f - r.y;
    float along = x * r.along_x + y * r.along_y;
    float beside = rg_abs(y * r.along_x - x * r.along_y);
    float beyond = rg_max(-along, along - r.length_px);
    float covered = rg_clamp(r.reach - beside, 0.0f, 1.0f) * rg_clamp(r.reach - beyond, 0.0f, 1.0f);
    float part = rg_clamp(along / rg_max(r.length_px, 1e-6f), 0.0f, 1.0f);
    return rg_fragment_make(rg_rgba(r.colour.r * covered, r.colour.g * covered,
                                    r.colour.b * covered, r.colour.a * covered),
                            r.depth + (r.depth_there - r.depth) * part);
}
