// Finds the span of pixels that a triangle covers in each row of a block, several rows at a time.
//
// Edge functions are divided by 256 as in cover_tmpl.h. Bounds: corners lie within 16380 pixels of
// each other (kernels/dialect/draw/clip.h), so |dx| and |dy| are below 2^22. A function then varies
// by less than 2^29 within a block of 64 pixels a side. A function clamped to 2^30 keeps its sign
// there, and its quotients stay beyond the block, so 32 bits are enough.
#ifndef RG_BACKENDS_CPU_DRAW_SPAN_TMPL_H
#define RG_BACKENDS_CPU_DRAW_SPAN_TMPL_H

#include "backends/cpu/draw/program.h"
#include "kernels/dialect/draw/coverage.h"

enum { BLOCK_PX = 64 }; // side of a block, in pixels

// The spans of a block's rows, from its first row on, in columns of the block.
struct spans {
    int begin[BLOCK_PX], end[BLOCK_PX];
};

// floor(value / by), clamped to about +-128. The estimate is off by less than 1, because its
// relative error is below 2^-22.
static inline int quotient(int value, int by, float inverse)
{
    const int estimate = rg_to_int(rg_clamp(rg_to_float(value) * inverse, -128.0f, 128.0f));
    const int rest = value - estimate * by;
    return estimate + (rest >= by ? 1 : 0) - (rest < 0 ? 1 : 0);
}

// Clips the spans of `rows` rows, a multiple of CPU_LANES, to the inside of an edge.
static void cut_spans(struct spans *spans, rg_edge e, int x, int y, int rows)
{
    const int64_t far = (int64_t)1 << 30;
    const int64_t exact = (rg_edge_at(e, x, y) - 1) >> 8;
    const int at = (int)(exact > far ? far : exact < -far ? -far : exact);
    const int by = e.dx < 0 ? -e.dx : e.dx, dy = e.dy;
    const float inverse = 1.0f / (float)by;
    int *begin = spans->begin, *end = spans->end;
    if (e.dx > 0) {
#pragma omp simd
        for (int i = 0; i < rows; i++)
            end[i] = rg_imin(end[i], quotient(at + dy * i, by, inverse) + 1);
    } else if (e.dx < 0) {
#pragma omp simd
        for (int i = 0; i < rows; i++)
            begin[i] = rg_imax(begin[i], -quotient(at + dy * i, by, inverse));
    } else {
#pragma omp simd
        for (int i = 0; i < rows; i++)
            end[i] = at + dy * i < 0 ? 0 : end[i];
    }
}

// A triangle, or a convex quad; for a quad, the triangle has its box and three of its edges.
struct convex {
    rg_triangle t;
    bool is_quad;
    rg_edge fourth;
};

// Positive if three corners turn in the same direction as a triangle's edges.
static inline int64_t turn_of(int x0, int y0, int x1, int y1, int x2, int y2)
{
    return (int64_t)(x0 - x1) * (y2 - y0) - (int64_t)(x2 - x0) * (y0 - y1);
}

// Makes a shape of a quad whose corners all turn the same way. Its two triangles together cover the
// inside of its four edges: each centre on their shared edge belongs to one of them.
static bool make_convex(const rg_draw_state *draw, rg_snapped c, struct convex *shape)
{
    const int64_t at_1 = turn_of(c.x0, c.y0, c.x1, c.y1, c.x2, c.y2);
    const int64_t at_2 = turn_of(c.x1, c.y1, c.x2, c.y2, c.x3, c.y3);
    const int64_t at_3 = turn_of(c.x2, c.y2, c.x3, c.y3, c.x0, c.y0);
    const int64_t at_0 = turn_of(c.x3, c.y3, c.x0, c.y0, c.x1, c.y1);
    const bool turned = at_1 < 0 && at_2 < 0 && at_3 < 0 && at_0 < 0;
    if (!turned && !(at_1 > 0 && at_2 > 0 && at_3 > 0 && at_0 > 0))
        return false;
    const int bx = turned ? c.x3 : c.x1, by = turned ? c.y3 : c.y1;
    const int dx = turned ? c.x1 : c.x3, dy = turned ? c.y1 : c.y3;
    const rg_triangle near = rg_triangle_make(*draw, c.x0, c.y0, bx, by, c.x2, c.y2);
    const rg_triangle far = rg_triangle_make(*draw, c.x0, c.y0, c.x2, c.y2, dx, dy);
    shape->is_quad = true;
    shape->t = near; // its third edge is the shared one
    shape->t.c = rg_edge_make(c.x2, c.y2, dx, dy);
    shape->fourth = rg_edge_make(dx, dy, c.x0, c.y0);
    shape->t.first_x = rg_imin(near.first_x, far.first_x);
    shape->t.first_y = rg_imin(near.first_y, far.first_y);
    shape->t.end_x = rg_imax(near.end_x, far.end_x);
    shape->t.end_y = rg_imax(near.end_y, far.end_y);
    return true;
}

// The spans of a shape in the block of width x height pixels at (x, y).
static void make_spans(struct spans *spans, const struct convex *shape, int x, int y, int width,
                       int height)
{
    const int rows = cpu_padded(height);
    for (int i = 0; i < rows; i++) {
        spans->begin[i] = 0;
        spans->end[i] = width;
    }
    cut_spans(spans, shape->t.a, x, y, rows);
    cut_spans(spans, shape->t.b, x, y, rows);
    cut_spans(spans, shape->t.c, x, y, rows);
    if (shape->is_quad)
        cut_spans(spans, shape->fourth, x, y, rows);
}

#endif
