// Which pixels of each row a triangle covers: spans for a block of the target, rows side by side.
//
// Edge functions are divided by 256 as in draw_cover.h. Bounds: corners lie within 16380 pixels of
// each other (kernels/clip.h), so |dx| and |dy| are below 2^22, and a function varies by less than
// 2^29 within a block of 64 pixels a side. One that is cut off at 2^30 keeps its sign there, and
// its quotients stay beyond the block: 32 bits serve.
#ifndef RG_BACKENDS_CPU_DRAW_SPAN_H
#define RG_BACKENDS_CPU_DRAW_SPAN_H

#include "backends/cpu/draw.h"
#include "kernels/raster.h"

// The rows of a block, from its first one; pixels counted from its first column.
struct spans {
    int begin[CPU_BLOCK_PX], end[CPU_BLOCK_PX];
};

// floor(value / by), cut off at 128 or so either way. The estimate is wrong by less than 1, for its
// relative error is below 2^-22.
static inline int quotient(int value, int by, float inverse)
{
    const int estimate = rg_to_int(rg_clamp(rg_to_float(value) * inverse, -128.0f, 128.0f));
    const int rest = value - estimate * by;
    return estimate + (rest >= by ? 1 : 0) - (rest < 0 ? 1 : 0);
}

// Cuts the spans of `rows` rows, a multiple of CPU_LANES, to what lies inside an edge.
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

// The spans of a triangle in the block of width x height pixels at (x, y).
static void make_spans(struct spans *spans, const rg_triangle *t, int x, int y, int width,
                       int height)
{
    const int rows = cpu_padded(height);
    for (int i = 0; i < rows; i++) {
        spans->begin[i] = 0;
        spans->end[i] = width;
    }
    cut_spans(spans, t->a, x, y, rows);
    cut_spans(spans, t->b, x, y, rows);
    cut_spans(spans, t->c, x, y, rows);
}

#endif
