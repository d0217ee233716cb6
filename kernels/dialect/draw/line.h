// A line between two points in clip space, as the viewer sees it: in pixels, cut to the part that
// can be drawn. It has no width; programs give it one.
#ifndef RG_KERNELS_DIALECT_DRAW_LINE_H
#define RG_KERNELS_DIALECT_DRAW_LINE_H

#include "kernels/dialect/draw/clip.h"

RG_STRUCT(rg_line)
{
    float x; // its beginning, in pixels from the target's corner
    float y;
    float along_x; // its direction, of unit length
    float along_y;
    float length_px;
    float depth;       // at its beginning
    float depth_there; // at its end
    float from;        // the part of it that is seen, 0 to 1: none if this is more than `to`
    float to;
};
RG_STRUCT_SIZE(rg_line, 9)

// The part of a line inside the planes so far, from 0 to 1.
RG_STRUCT(rg_line_part)
{
    float from;
    float to;
};

// Cuts off the part outside a plane; `a` and `b` are the distances of the ends inside it.
RG_FN rg_line_part rg_part_inside(rg_line_part part, float a, float b)
{
    float fall = a - b;
    float at = a / (rg_abs(fall) > 1e-30f ? fall : 1.0f);
    rg_line_part inside;
    inside.from = rg_max(part.from, a < 0.0f ? (b < 0.0f ? 2.0f : at) : 0.0f);
    inside.to = rg_min(part.to, b < 0.0f ? at : 1.0f);
    return inside;
}

// The part of the line from a to b that is seen. It is cut at the near plane, and `beyond_px`
// outside the target's sides, so that the rest is near enough for a float to place it.
RG_FN rg_line rg_line_seen(rg_draw_state draw, rg_corner a, rg_corner b, float beyond_px)
{
    float across = (draw.half_width + beyond_px) / draw.half_width;
    float down = (draw.half_height + beyond_px) / draw.half_height;
    rg_line_part part;
    part.from = 0.0f;
    part.to = 1.0f;
    part = rg_part_inside(part, a.z, b.z);
    part = rg_part_inside(part, a.w * across + a.x, b.w * across + b.x);
    part = rg_part_inside(part, a.w * across - a.x, b.w * across - b.x);
    part = rg_part_inside(part, a.w * down + a.y, b.w * down + b.y);
    part = rg_part_inside(part, a.w * down - a.y, b.w * down - b.y);
    float from_w = 1.0f / rg_max(a.w + (b.w - a.w) * part.from, RG_LEAST_W);
    float to_w = 1.0f / rg_max(a.w + (b.w - a.w) * part.to, RG_LEAST_W);
    rg_line s;
    s.x = ((a.x + (b.x - a.x) * part.from) * from_w + 1.0f) * draw.half_width;
    s.y = ((a.y + (b.y - a.y) * part.from) * from_w + 1.0f) * draw.half_height;
    float x = ((a.x + (b.x - a.x) * part.to) * to_w + 1.0f) * draw.half_width - s.x;
    float y = ((a.y + (b.y - a.y) * part.to) * to_w + 1.0f) * draw.half_height - s.y;
    s.length_px = rg_sqrt(x * x + y * y);
    float over_length = 1.0f / rg_max(s.length_px, 1e-6f);
    s.along_x = s.length_px > 1e-6f ? x * over_length : 1.0f;
    s.along_y = s.length_px > 1e-6f ? y * over_length : 0.0f;
    s.depth = (a.z + (b.z - a.z) * part.from) * from_w;
    s.depth_there = (a.z + (b.z - a.z) * part.to) * to_w;
    s.from = part.from;
    s.to = part.to;
    return s;
}

// A corner, by its distances from the line's beginning, along the line and beside it.
RG_FN rg_corner rg_line_corner(rg_draw_state draw, rg_line s, float along, float beside)
{
    float x = s.x + s.along_x * along - s.along_y * beside;
    float y = s.y + s.along_y * along + s.along_x * beside;
    return rg_corner_make(x / draw.half_width - 1.0f, y / draw.half_height - 1.0f, 0.5f, 1.0f);
}

// The rectangle that reaches `reach` beside the line and beyond its ends.
RG_FN rg_item rg_line_item(rg_draw_state draw, rg_line s, float reach)
{
    float end = s.length_px + reach;
    rg_item t;
    t.alive = s.from <= s.to ? 1 : 0;
    t.a = rg_line_corner(draw, s, -reach, -reach);
    t.b = rg_line_corner(draw, s, -reach, reach);
    t.c = rg_line_corner(draw, s, end, reach);
    t.d = rg_line_corner(draw, s, end, -reach);
    return t;
}

// The place of a pixel's centre along the line, in pixels from its beginning.
RG_FN float rg_line_along(rg_line s, int px, int py)
{
    return (rg_to_float(px) + 0.5f - s.x) * s.along_x + (rg_to_float(py) + 0.5f - s.y) * s.along_y;
}

// The share of a pixel that a line with smooth sides and square ends covers; `reach` is the
// distance from its axis and from its ends at which it has faded out.
RG_FN float rg_line_covered(rg_line s, int px, int py, float reach)
{
    float x = rg_to_float(px) + 0.5f - s.x;
    float y = rg_to_float(py) + 0.5f - s.y;
    float along = rg_line_along(s, px, py);
    float beside = rg_abs(y * s.along_x - x * s.along_y);
    float beyond = rg_max(-along, along - s.length_px);
    return rg_clamp(reach - beside, 0.0f, 1.0f) * rg_clamp(reach - beyond, 0.0f, 1.0f);
}

// The line's depth at a pixel.
RG_FN float rg_line_depth(rg_line s, int px, int py)
{
    float part = rg_clamp(rg_line_along(s, px, py) / rg_max(s.length_px, 1e-6f), 0.0f, 1.0f);
    return s.depth + (s.depth_there - s.depth) * part;
}

#endif
