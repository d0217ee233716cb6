// The pixels that a triangle covers, by the rule that graphics drivers follow on the grid of 1/256
// pixel (top-left rule, integer edge functions). For devices that rasterise in our code: C and
// OpenCL C only, since it needs 64 bits.
//
// Pixel (px, py) is covered if its centre lies inside all three edges. A centre on an edge belongs
// to the triangle that has this edge as its top or left one, so that neighbours share no pixel and
// leave none out.
#ifndef RG_KERNELS_DIALECT_DRAW_COVERAGE_H
#define RG_KERNELS_DIALECT_DRAW_COVERAGE_H

#include "kernels/dialect/draw/clip.h"

#if RG_OPENCL
typedef long rg_long;
#else
typedef int64_t rg_long;
#endif

// An edge function: positive inside. at(px, py) = origin - dx 256 px + dy 256 py, and 1 more for a
// top or left edge, whose centres count.
typedef struct rg_edge {
    int dx;
    int dy;
    rg_long origin;
} rg_edge;

typedef struct rg_triangle {
    rg_edge a;
    rg_edge b;
    rg_edge c;
    int first_x; // the box of pixels that may be covered, ends excluded; empty for no area
    int first_y;
    int end_x;
    int end_y;
} rg_triangle;

RG_FN rg_edge rg_edge_make(int x, int y, int next_x, int next_y)
{
    rg_edge e;
    e.dx = y - next_y;
    e.dy = x - next_x;
    // from pixel centres, which lie 128 of the grid off its corners
    e.origin = (rg_long)e.dx * (x - 128) - (rg_long)e.dy * (y - 128);
    if (e.dx < 0 || (e.dx == 0 && e.dy > 0))
        e.origin += 1;
    return e;
}

RG_FN rg_long rg_edge_at(rg_edge e, int px, int py)
{
    return e.origin - (rg_long)e.dx * (256 * px) + (rg_long)e.dy * (256 * py);
}

// Corners may turn either way; the box is cut to the scissor.
RG_FN rg_triangle rg_triangle_make(rg_draw_state draw, int x0, int y0, int x1, int y1, int x2,
                                   int y2)
{
    rg_long area = (rg_long)(x0 - x1) * (y2 - y0) - (rg_long)(x2 - x0) * (y0 - y1);
    bool turned = area < 0;
    int bx = turned ? x2 : x1;
    int by = turned ? y2 : y1;
    int cx = turned ? x1 : x2;
    int cy = turned ? y1 : y2;
    rg_triangle t;
    t.a = rg_edge_make(x0, y0, bx, by);
    t.b = rg_edge_make(bx, by, cx, cy);
    t.c = rg_edge_make(cx, cy, x0, y0);
    t.first_x = rg_imax((rg_imin(x0, rg_imin(x1, x2)) + 127) >> 8, draw.x0);
    t.first_y = rg_imax((rg_imin(y0, rg_imin(y1, y2)) + 127) >> 8, draw.y0);
    t.end_x =
        area == 0 ? t.first_x : rg_imin(((rg_imax(x0, rg_imax(x1, x2)) - 128) >> 8) + 1, draw.x1);
    t.end_y = rg_imin(((rg_imax(y0, rg_imax(y1, y2)) - 128) >> 8) + 1, draw.y1);
    return t;
}

RG_FN bool rg_triangle_covers(rg_triangle t, int px, int py)
{
    return rg_edge_at(t.a, px, py) > 0 && rg_edge_at(t.b, px, py) > 0 &&
           rg_edge_at(t.c, px, py) > 0;
}

RG_FN int rg_triangle_pixels(rg_triangle t)
{
    int pixels = 0;
    for (int py = t.first_y; py < t.end_y; py++)
        for (int px = t.first_x; px < t.end_x; px++)
            pixels += rg_triangle_covers(t, px, py) ? 1 : 0;
    return pixels;
}

// The number of pixels that a primitive of 3 or 4 corners covers: the sum of its two triangles,
// which share no pixel unless the primitive is folded.
RG_FN int rg_covered_pixels(rg_draw_state draw, rg_snapped s, int corners)
{
    int pixels = rg_triangle_pixels(rg_triangle_make(draw, s.x0, s.y0, s.x1, s.y1, s.x2, s.y2));
    if (corners == 4)
        pixels += rg_triangle_pixels(rg_triangle_make(draw, s.x0, s.y0, s.x2, s.y2, s.x3, s.y3));
    return pixels;
}

// --- over a block of pixels, in 32 bits ---

// The most pixels along a side of a block.
#define RG_MOST_BLOCK_PX 64

// An edge function over a block, not negative inside. It is scaled down by 256, which loses
// nothing, because steps are multiples of 256. `at` is its value at the block's first pixel; each
// pixel adds a step. Far from the edge, where no step within a block changes its sign, `at` is
// clamped.
typedef struct rg_block_edge {
    int at;
    int step_x;
    int step_y;
} rg_block_edge;

typedef struct rg_block_triangle {
    rg_block_edge a;
    rg_block_edge b;
    rg_block_edge c;
} rg_block_triangle;

RG_FN rg_block_edge rg_block_edge_make(rg_edge e, int px, int py)
{
    const rg_long far = (rg_long)1 << 30; // steps are below 2^22, so a block's below 2^29
    rg_long at = ((e.origin - 1) >> 8) - (rg_long)e.dx * px + (rg_long)e.dy * py;
    rg_block_edge b;
    b.at = (int)(at < -far ? -far : at > far ? far : at);
    b.step_x = -e.dx;
    b.step_y = e.dy;
    return b;
}

RG_FN rg_block_triangle rg_block_triangle_make(rg_triangle t, int px, int py)
{
    rg_block_triangle b;
    b.a = rg_block_edge_make(t.a, px, py);
    b.b = rg_block_edge_make(t.b, px, py);
    b.c = rg_block_edge_make(t.c, px, py);
    return b;
}

RG_FN int rg_block_edge_at(rg_block_edge e, int x, int y)
{
    return e.at + e.step_x * x + e.step_y * y;
}

// Not negative if the triangle covers pixel (x, y) of the block.
RG_FN int rg_block_inside(rg_block_triangle t, int x, int y)
{
    return rg_block_edge_at(t.a, x, y) | rg_block_edge_at(t.b, x, y) | rg_block_edge_at(t.c, x, y);
}

// The largest value of an edge function in a block of width x height pixels.
RG_FN int rg_block_edge_most(rg_block_edge e, int width, int height)
{
    return e.at + rg_imax(e.step_x * (width - 1), 0) + rg_imax(e.step_y * (height - 1), 0);
}

// Whether a triangle may cover a pixel of a block; false for most blocks that it misses.
RG_FN bool rg_triangle_touches(rg_triangle t, int px, int py, int width, int height)
{
    rg_block_triangle b = rg_block_triangle_make(t, px, py);
    return t.first_x < px + width && t.end_x > px && t.first_y < py + height && t.end_y > py &&
           (rg_block_edge_most(b.a, width, height) | rg_block_edge_most(b.b, width, height) |
            rg_block_edge_most(b.c, width, height)) >= 0;
}

#endif
