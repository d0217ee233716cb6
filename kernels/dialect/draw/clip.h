// Takes an item's corners from clip space to the grid of 1/256 pixel: culls, projects, snaps, and
// clips the few items that need it. Every DRAW program contains it (kernels/dialect/draw/draw.h),
// so that all devices rasterise the very same integers.
//
// Clip space is that of the matrices: pixel x = (x / w + 1) * width / 2, pixel y = (y / w + 1) *
// height / 2, y grows downwards; depth = z / w, 0 at the near plane. Items are clipped at z = 0 and
// at the guard band, RG_GUARD_PX beyond the target. Depth beyond 1 is clamped, not clipped.
#ifndef RG_KERNELS_DIALECT_DRAW_CLIP_H
#define RG_KERNELS_DIALECT_DRAW_CLIP_H

#include "kernels/dialect/vec.h"
#include "kernels/dialect/draw/state.h"

// A driver draws in a viewport of RG_VIEWPORT_PX around the target's centre. Snapped coordinates
// need 22 bits there, so it computes them without rounding, and clips nothing itself
// (docs/drawing.md). The guard band is narrower, because llvmpipe cuts edge functions to 32 bits.
// It loses triangles of more than 4 million pixels that reach off the target's upper left corner
// and end within 64 pixels of it.
#define RG_VIEWPORT_PX 16384
#define RG_FARTHEST_PX 8190.0f // of the guard band from the target's centre
#define RG_GUARD_PX    2048.0f
#define RG_SUBPIXELS   256
#define RG_LEAST_W     1e-9f

// The output of an item: a convex polygon of 3 or 4 corners (RG_CORNERS; d is unused with 3), or
// nothing if `alive` is 0.
RG_STRUCT(rg_item)
{
    int alive;
    rg_corner a;
    rg_corner b;
    rg_corner c;
    rg_corner d;
};
RG_STRUCT_SIZE(rg_item, 17)

// Corners in 1/256 pixel from the target's corner; pixel (px, py) has its centre at 256 px + 128.
RG_STRUCT(rg_snapped)
{
    int x0;
    int y0;
    int x1;
    int y1;
    int x2;
    int y2;
    int x3;
    int y3;
};
RG_STRUCT_SIZE(rg_snapped, 8)

// The fates of an item.
#define RG_FATE_DEAD  0
#define RG_FATE_WHOLE 1 // drawn with its snapped corners
#define RG_FATE_CLIP  2 // has to be clipped first

RG_STRUCT(rg_projected)
{
    int fate;
    rg_snapped corners; // if whole
};

// The distance of the guard band's edge from the target's centre, in pixels.
RG_FN float rg_reach_px(float half_size)
{
    return rg_min(half_size + RG_GUARD_PX, RG_FARTHEST_PX);
}

// A coordinate of clip space over w, in 1/256 pixel, clamped to the guard band.
RG_FN int rg_snap(float over_w, float half_size)
{
    float reach = rg_reach_px(half_size);
    float from_centre = rg_clamp(over_w * half_size, -reach, reach);
    return rg_to_int(rg_floor((from_centre + half_size) * 256.0f + 0.5f));
}

RG_FN float rg_least4(float a, float b, float c, float d)
{
    return rg_min(rg_min(a, b), rg_min(c, d));
}

RG_FN float rg_most4(float a, float b, float c, float d)
{
    return rg_max(rg_max(a, b), rg_max(c, d));
}

RG_FN int rg_ileast4(int a, int b, int c, int d)
{
    return rg_imin(rg_imin(a, b), rg_imin(c, d));
}

RG_FN int rg_imost4(int a, int b, int c, int d)
{
    return rg_imax(rg_imax(a, b), rg_imax(c, d));
}

// The distance of a corner inside the guard band, in pixels times w; negative outside.
RG_FN float rg_guard_slack(rg_draw_state draw, rg_corner c)
{
    float across = rg_reach_px(draw.half_width) * c.w - rg_abs(c.x) * draw.half_width;
    float down = rg_reach_px(draw.half_height) * c.w - rg_abs(c.y) * draw.half_height;
    return rg_min(across, down);
}

RG_FN float rg_extent_of(rg_corner c)
{
    return (rg_abs(c.x) + rg_abs(c.y)) + (rg_abs(c.z) + rg_abs(c.w));
}

// Twice the signed area that the viewer sees, times the product of all w: positive if the first
// three corners turn clockwise on the screen. It is right for items that cross the near plane too.
RG_FN float rg_turn(rg_item t)
{
    return t.a.x * (t.b.y * t.c.w - t.c.y * t.b.w) - t.a.y * (t.b.x * t.c.w - t.c.x * t.b.w) +
           t.a.w * (t.b.x * t.c.y - t.c.x * t.b.y);
}

// Whether culling leaves items of this turn: RG_CULL_NONE 0, RG_CULL_BACK 1 (culls those that turn
// clockwise), RG_CULL_FRONT 2 (culls the others).
RG_FN int rg_faces(rg_draw_state draw, float turn)
{
    float facing = draw.cull == 1 ? -turn : turn;
    return (draw.cull == 0 ? 1 : 0) | (facing > 0.0f ? 1 : 0);
}

// Whether a box of snapped corners holds a pixel centre inside the scissor.
RG_FN int rg_covers_centre(int low, int high, int first, int end)
{
    int first_centre = rg_imax((low + 127) >> 8, first);
    int last_centre = rg_imin((high - 128) >> 8, end - 1);
    return first_centre <= last_centre ? 1 : 0;
}

RG_FN rg_snapped rg_project_whole(rg_draw_state draw, rg_item t)
{
    float a = 1.0f / rg_max(t.a.w, RG_LEAST_W);
    float b = 1.0f / rg_max(t.b.w, RG_LEAST_W);
    float c = 1.0f / rg_max(t.c.w, RG_LEAST_W);
    float d = 1.0f / rg_max(t.d.w, RG_LEAST_W);
    rg_snapped s;
    s.x0 = rg_snap(t.a.x * a, draw.half_width);
    s.y0 = rg_snap(t.a.y * a, draw.half_height);
    s.x1 = rg_snap(t.b.x * b, draw.half_width);
    s.y1 = rg_snap(t.b.y * b, draw.half_height);
    s.x2 = rg_snap(t.c.x * c, draw.half_width);
    s.y2 = rg_snap(t.c.y * c, draw.half_height);
    s.x3 = rg_snap(t.d.x * d, draw.half_width);
    s.y3 = rg_snap(t.d.y * d, draw.half_height);
    return s;
}

// An item of three corners has its last one twice.
RG_FN rg_item rg_item_closed(rg_item t, int corners)
{
    rg_item closed = t;
    if (corners == 3)
        closed.d = t.c;
    return closed;
}

// The fate of a closed item, and its corners if it is whole. The code has no branches, so that
// compilers vectorise over items. An item with NaN, or with coordinates beyond 1e30, is dead.
RG_FN rg_projected rg_project(rg_draw_state draw, rg_item t)
{
    float extent =
        (rg_extent_of(t.a) + rg_extent_of(t.b)) + (rg_extent_of(t.c) + rg_extent_of(t.d));
    float nearest = rg_least4(t.a.z, t.b.z, t.c.z, t.d.z);
    float farthest = rg_most4(t.a.z, t.b.z, t.c.z, t.d.z);
    float least_w = rg_least4(t.a.w, t.b.w, t.c.w, t.d.w);
    float slack = rg_least4(rg_guard_slack(draw, t.a), rg_guard_slack(draw, t.b),
                            rg_guard_slack(draw, t.c), rg_guard_slack(draw, t.d));
    float left = rg_most4(t.a.w + t.a.x, t.b.w + t.b.x, t.c.w + t.c.x, t.d.w + t.d.x);
    float right = rg_most4(t.a.w - t.a.x, t.b.w - t.b.x, t.c.w - t.c.x, t.d.w - t.d.x);
    float top = rg_most4(t.a.w + t.a.y, t.b.w + t.b.y, t.c.w + t.c.y, t.d.w + t.d.y);
    float bottom = rg_most4(t.a.w - t.a.y, t.b.w - t.b.y, t.c.w - t.c.y, t.d.w - t.d.y);
    int seen = (t.alive != 0 ? 1 : 0) & (extent < 1e30f ? 1 : 0) & (farthest >= 0.0f ? 1 : 0) &
               (rg_min(rg_min(left, right), rg_min(top, bottom)) >= 0.0f ? 1 : 0) &
               rg_faces(draw, rg_turn(t));
    int whole =
        (nearest >= 0.0f ? 1 : 0) & (slack >= 0.0f ? 1 : 0) & (least_w > RG_LEAST_W ? 1 : 0);
    rg_projected p;
    p.corners = rg_project_whole(draw, t);
    rg_snapped s = p.corners;
    int covers = rg_covers_centre(rg_ileast4(s.x0, s.x1, s.x2, s.x3),
                                  rg_imost4(s.x0, s.x1, s.x2, s.x3), draw.x0, draw.x1) &
                 rg_covers_centre(rg_ileast4(s.y0, s.y1, s.y2, s.y3),
                                  rg_imost4(s.y0, s.y1, s.y2, s.y3), draw.y0, draw.y1);
    p.fate = seen * (whole != 0 ? covers : RG_FATE_CLIP);
    return p;
}

// --- clipping ---

// A convex polygon: 4 corners and one more for each of 5 planes at most.
RG_STRUCT(rg_polygon)
{
    int count;
    rg_corner c0;
    rg_corner c1;
    rg_corner c2;
    rg_corner c3;
    rg_corner c4;
    rg_corner c5;
    rg_corner c6;
    rg_corner c7;
    rg_corner c8;
};

RG_SELDOM rg_corner rg_polygon_at(rg_polygon g, int i)
{
    rg_corner c = g.c0;
    if (i == 1)
        c = g.c1;
    if (i == 2)
        c = g.c2;
    if (i == 3)
        c = g.c3;
    if (i == 4)
        c = g.c4;
    if (i == 5)
        c = g.c5;
    if (i == 6)
        c = g.c6;
    if (i == 7)
        c = g.c7;
    if (i == 8)
        c = g.c8;
    return c;
}

RG_SELDOM rg_polygon rg_polygon_with(rg_polygon g, rg_corner c)
{
    rg_polygon more = g;
    if (g.count == 0)
        more.c0 = c;
    if (g.count == 1)
        more.c1 = c;
    if (g.count == 2)
        more.c2 = c;
    if (g.count == 3)
        more.c3 = c;
    if (g.count == 4)
        more.c4 = c;
    if (g.count == 5)
        more.c5 = c;
    if (g.count == 6)
        more.c6 = c;
    if (g.count == 7)
        more.c7 = c;
    if (g.count == 8)
        more.c8 = c;
    more.count = rg_imin(g.count + 1, 9);
    return more;
}

RG_FN rg_polygon rg_polygon_empty(rg_corner c)
{
    rg_polygon g;
    g.count = 0;
    g.c0 = c;
    g.c1 = c;
    g.c2 = c;
    g.c3 = c;
    g.c4 = c;
    g.c5 = c;
    g.c6 = c;
    g.c7 = c;
    g.c8 = c;
    return g;
}

// The distance of a corner inside a plane: 0 is the near one, 1 to 4 are the guard band's sides.
#define RG_PLANES 5

RG_FN float rg_inside(rg_draw_state draw, rg_corner c, int plane)
{
    float across = rg_reach_px(draw.half_width) * c.w;
    float down = rg_reach_px(draw.half_height) * c.w;
    float inside = c.z;
    if (plane == 1)
        inside = across + c.x * draw.half_width;
    if (plane == 2)
        inside = across - c.x * draw.half_width;
    if (plane == 3)
        inside = down + c.y * draw.half_height;
    if (plane == 4)
        inside = down - c.y * draw.half_height;
    return inside;
}

// The point in which an edge meets a plane. It is computed from the edge's inner end, whichever way
// the polygon runs, so that neighbours which share the edge get the same corner.
RG_FN rg_corner rg_cut(rg_corner inner, float inner_by, rg_corner outer, float outer_by)
{
    float t = inner_by / (inner_by - outer_by);
    return rg_corner_make(inner.x + (outer.x - inner.x) * t, inner.y + (outer.y - inner.y) * t,
                          inner.z + (outer.z - inner.z) * t, inner.w + (outer.w - inner.w) * t);
}

RG_SELDOM rg_polygon rg_clip_by(rg_draw_state draw, rg_polygon g, int plane)
{
    rg_polygon kept = rg_polygon_empty(g.c0);
    rg_corner from = rg_polygon_at(g, g.count - 1);
    float from_by = rg_inside(draw, from, plane);
    for (int i = 0; i < g.count; i++) {
        rg_corner to = rg_polygon_at(g, i);
        float to_by = rg_inside(draw, to, plane);
        if (from_by >= 0.0f && to_by < 0.0f)
            kept = rg_polygon_with(kept, rg_cut(from, from_by, to, to_by));
        if (from_by < 0.0f && to_by >= 0.0f)
            kept = rg_polygon_with(kept, rg_cut(to, to_by, from, from_by));
        if (to_by >= 0.0f)
            kept = rg_polygon_with(kept, to);
        from = to;
        from_by = to_by;
    }
    return kept;
}

// A closed item's polygon: unchanged if the item is whole (the loop then has no rounds), clipped if
// it has to be, empty if it is dead.
RG_FN rg_polygon rg_clip(rg_draw_state draw, rg_item t, int corners, int fate)
{
    rg_polygon g = rg_polygon_empty(t.a);
    g.c1 = t.b;
    g.c2 = t.c;
    g.c3 = t.d;
    g.count = fate == RG_FATE_DEAD ? 0 : corners;
    for (int plane = fate == RG_FATE_CLIP ? 0 : RG_PLANES; plane < RG_PLANES; plane++)
        if (g.count > 0)
            g = rg_clip_by(draw, g, plane);
    return g;
}

// Primitives of 3 or 4 corners that a polygon falls into.
RG_FN int rg_polygon_prims(rg_polygon g, int corners)
{
    return g.count < 3 ? 0 : corners == 3 ? g.count - 2 : (g.count - 1) / 2;
}

// The most primitives that an item falls into.
#define RG_MOST_PRIMS(corners) ((corners) == 3 ? 6 : 4)

// The k-th primitive: a triangle, or a quad, whose last two corners coincide if the polygon has an
// odd number of corners. Primitives beyond the last have no area.
RG_FN rg_snapped rg_polygon_prim(rg_draw_state draw, rg_polygon g, int corners, int k)
{
    int step = corners - 2;
    int last = g.count - 1;
    rg_item part;
    part.alive = 1;
    part.a = g.c0;
    part.b = rg_polygon_at(g, rg_imin(step * k + 1, last));
    part.c = rg_polygon_at(g, rg_imin(step * k + 2, last));
    part.d = rg_polygon_at(g, rg_imin(step * k + corners - 1, last));
    return rg_project_whole(draw, part);
}

// --- the fates of a chunk of items, a bit each ---

RG_FN int rg_ones(uint bits)
{
    uint pairs = bits - ((bits >> 1) & 0x55555555u);
    uint fours = (pairs & 0x33333333u) + ((pairs >> 2) & 0x33333333u);
    return rg_to_int((((fours + (fours >> 4)) & 0x0f0f0f0fu) * 0x01010101u) >> 24);
}

// All bits below the lowest bit that is set.
RG_FN uint rg_bits_below(uint bits)
{
    return (bits & (0u - bits)) - 1u;
}

// Primitives to leave room for: for a clipped item, as many as it can fall into.
RG_FN int rg_chunk_prims(uint whole, uint clipped, int corners)
{
    return rg_ones(whole) + RG_MOST_PRIMS(corners) * rg_ones(clipped);
}

#endif
