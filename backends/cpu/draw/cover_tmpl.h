// Finds the pixels that small shapes cover, CPU_LANES shapes at a time, in 32 bits.
//
// Edge functions are those of kernels/dialect/draw/coverage.h, divided by 256. Its at(px, py) > 0
// has the terms 256 dx px and 256 dy py, so that it is equivalent to
//   floor((origin - 1) / 256) - dx px + dy py >= 0.
//
// A convex polygon's two triangles together cover the inside of its four edges, including ties:
// each centre on their shared edge belongs to one of them. A polygon is convex if no three
// consecutive corners turn the other way; corners may coincide or lie on one line.
//
// Bounds: a small shape's corners lie within 2^14 of each other (64 pixels), and of a pixel of its
// box. So products are below 2^28, and sums of four of them below 2^30.
#ifndef RG_BACKENDS_CPU_DRAW_COVER_TMPL_H
#define RG_BACKENDS_CPU_DRAW_COVER_TMPL_H

#include "backends/cpu/draw/shapes.h"

enum { SMALL = 1 << 14, MOST_GROUPS = CPU_MASKS * 2 };

// CPU_LANES shapes.
struct lanes {
    int x[4][CPU_LANES], y[4][CPU_LANES];    // corners, from the centre of the box's first pixel
    int width[CPU_LANES], height[CPU_LANES]; // of the box, in pixels; 0: covers nothing
    uint columns[CPU_LANES];                 // columns of the box, in each row of a group
    int turned[CPU_LANES];                   // -1: corners turn the other way; else 0
    int dx[4][CPU_LANES], dy[4][CPU_LANES], at[4][CPU_LANES];
    uint rows[MOST_GROUPS][CPU_LANES]; // covered pixels: four rows of eight in a word
};

static inline int cross(int ax, int ay, int bx, int by, int cx, int cy)
{
    return (ax - bx) * (cy - ay) - (cx - ax) * (ay - by);
}

// Computes each shape's box of pixels, which decides whether it is small, and its corners relative
// to the box.
static void box_lanes(const rg_draw_state *state, const struct cpu_items *items,
                      struct cpu_shapes *shapes, int first, struct lanes *l)
{
    const rg_draw_state draw = *state;
#pragma omp simd
    for (int i = 0; i < CPU_LANES; i++) {
        const int place = shapes->place[first + i];
        const int x0 = items->x[0][place], x1 = items->x[1][place];
        const int x2 = items->x[2][place], x3 = items->x[3][place];
        const int y0 = items->y[0][place], y1 = items->y[1][place];
        const int y2 = items->y[2][place], y3 = items->y[3][place];
        const int low_x = rg_ileast4(x0, x1, x2, x3), high_x = rg_imost4(x0, x1, x2, x3);
        const int low_y = rg_ileast4(y0, y1, y2, y3), high_y = rg_imost4(y0, y1, y2, y3);
        const int px = rg_imax((low_x + 127) >> 8, draw.x0);
        const int py = rg_imax((low_y + 127) >> 8, draw.y0);
        const int width = rg_imin(((high_x - 128) >> 8) + 1, draw.x1) - px;
        const int height = rg_imin(((high_y - 128) >> 8) + 1, draw.y1) - py;
        const int some = (width > 0 ? 1 : 0) & (height > 0 ? 1 : 0);
        const int small = (width <= 8 ? 1 : 0) & (height <= 8 * CPU_MASKS ? 1 : 0) &
                          (high_x - low_x < SMALL ? 1 : 0) & (high_y - low_y < SMALL ? 1 : 0);
        shapes->x[first + i] = px;
        shapes->y[first + i] = py;
        shapes->cover[first + i] = some * (small != 0 ? CPU_COVERS_MASK : CPU_COVERS_MORE);
        const int mask = -(some & small); // others must not overflow
        const int ox = 256 * px + 128, oy = 256 * py + 128;
        l->x[0][i] = (x0 - ox) & mask;
        l->x[1][i] = (x1 - ox) & mask;
        l->x[2][i] = (x2 - ox) & mask;
        l->x[3][i] = (x3 - ox) & mask;
        l->y[0][i] = (y0 - oy) & mask;
        l->y[1][i] = (y1 - oy) & mask;
        l->y[2][i] = (y2 - oy) & mask;
        l->y[3][i] = (y3 - oy) & mask;
        l->width[i] = width & mask;
        l->height[i] = height & mask;
    }
}

// Finds the direction in which corners turn. Folded shapes are left to their triangles; those
// without area are dropped.
static void turn_lanes(struct cpu_shapes *shapes, int first, struct lanes *l)
{
#pragma omp simd
    for (int i = 0; i < CPU_LANES; i++) {
        const int x0 = l->x[0][i], x1 = l->x[1][i], x2 = l->x[2][i], x3 = l->x[3][i];
        const int y0 = l->y[0][i], y1 = l->y[1][i], y2 = l->y[2][i], y3 = l->y[3][i];
        const int near = cross(x0, y0, x1, y1, x2, y2), far = cross(x0, y0, x2, y2, x3, y3);
        const int at_0 = cross(x3, y3, x0, y0, x1, y1), at_2 = cross(x1, y1, x2, y2, x3, y3);
        const int turned = (near + far) >> 31;
        const int convex = ((near ^ turned) - turned) | ((far ^ turned) - turned) |
                           ((at_0 ^ turned) - turned) | ((at_2 ^ turned) - turned);
        const int cover = shapes->cover[first + i];
        const int small = cover == CPU_COVERS_MASK ? 1 : 0;
        const int folded = small & (convex < 0 ? 1 : 0);
        const int mask = -((1 - folded) & (near + far != 0 ? 1 : 0));
        shapes->cover[first + i] = folded != 0 ? CPU_COVERS_MORE : cover;
        l->width[i] &= mask;
        l->height[i] &= mask;
        l->turned[i] = turned;
    }
}

// Computes the edge from corner k to the next one, at the box's first pixel.
static void edge_lanes(struct lanes *l, int k)
{
    const int n = (k + 1) & 3;
#pragma omp simd
    for (int i = 0; i < CPU_LANES; i++) {
        const int turned = l->turned[i];
        const int dx = ((l->y[k][i] - l->y[n][i]) ^ turned) - turned;
        const int dy = ((l->x[k][i] - l->x[n][i]) ^ turned) - turned;
        // A repeated corner, as the last one of triangles is, gives an edge without length, which
        // excludes nothing.
        const int tie = (dx < 0 ? 1 : 0) | ((dx == 0 ? 1 : 0) & (dy >= 0 ? 1 : 0));
        l->dx[k][i] = dx;
        l->dy[k][i] = dy;
        l->at[k][i] = (dx * l->x[k][i] - dy * l->y[k][i] + tie - 1) >> 8;
    }
}

// Tests `columns` columns in four rows, then moves on to the next four rows.
static inline __attribute__((always_inline)) void group_lanes(struct lanes *l, int group,
                                                              int columns)
{
    uint *rows = l->rows[group];
#pragma omp simd
    for (int i = 0; i < CPU_LANES; i++) {
        int a = l->at[0][i], b = l->at[1][i], c = l->at[2][i], d = l->at[3][i];
        const int dxa = l->dx[0][i], dxb = l->dx[1][i], dxc = l->dx[2][i], dxd = l->dx[3][i];
        const int dya = l->dy[0][i], dyb = l->dy[1][i], dyc = l->dy[2][i], dyd = l->dy[3][i];
        const int height = l->height[i] - 4 * group;
        uint covered = 0;
#pragma GCC unroll 4
        for (int row = 0; row < 4; row++) {
#pragma GCC unroll 8
            for (int column = 0; column < columns; column++) {
                const int outside = (a - dxa * column) | (b - dxb * column) | (c - dxc * column) |
                                    (d - dxd * column);
                covered |= outside < 0 ? 0u : 1u << (8 * row + column);
            }
            a += dya;
            b += dyb;
            c += dyc;
            d += dyd;
        }
        rows[i] = covered & l->columns[i] &
                  ((height > 0 ? 0xffu : 0u) | (height > 1 ? 0xff00u : 0u) |
                   (height > 2 ? 0xff0000u : 0u) | (height > 3 ? 0xff000000u : 0u));
        l->at[0][i] = a;
        l->at[1][i] = b;
        l->at[2][i] = c;
        l->at[3][i] = d;
    }
}

static int most_of(const int *values)
{
    int most = 0;
    for (int i = 0; i < CPU_LANES; i++)
        most = rg_imax(most, values[i]);
    return most;
}

// Makes `masks` masks for all lanes.
static void cover_lanes(struct lanes *l, int masks)
{
    const int width = most_of(l->width), groups = (most_of(l->height) + 3) / 4;
    for (int i = 0; i < CPU_LANES; i++) {
        l->columns[i] = ((1u << l->width[i]) - 1) * 0x01010101u;
        l->rows[2 * masks - 1][i] = 0;
    }
    if (width <= 2)
        for (int group = 0; group < groups; group++)
            group_lanes(l, group, 2);
    else if (width <= 4)
        for (int group = 0; group < groups; group++)
            group_lanes(l, group, 4);
    else
        for (int group = 0; group < groups; group++)
            group_lanes(l, group, 8);
}

static void take_masks(struct cpu_shapes *shapes, int first, const struct lanes *l, int masks)
{
    uint any[CPU_LANES] = {0};
    for (int mask = 0; mask < masks; mask++) {
#pragma omp simd
        for (int i = 0; i < CPU_LANES; i++) {
            const uint low = l->rows[2 * mask][i], high = l->rows[2 * mask + 1][i];
            shapes->mask[mask][first + i] = (uint64_t)high << 32 | low;
            any[i] |= low | high;
        }
    }
#pragma omp simd
    for (int i = 0; i < CPU_LANES; i++) {
        const int cover = shapes->cover[first + i];
        const int none = (cover == CPU_COVERS_MASK ? 1 : 0) & (any[i] == 0 ? 1 : 0);
        shapes->cover[first + i] = none != 0 ? CPU_COVERS_NONE : cover;
        shapes->masks[first + i] = (l->height[i] + 7) >> 3;
    }
}

static void cover_shapes(const rg_draw_state *draw, const struct cpu_items *items,
                         struct cpu_shapes *shapes)
{
    struct lanes l;
    for (int i = shapes->count; i < cpu_padded(shapes->count); i++)
        shapes->place[i] = shapes->place[shapes->count - 1];
    for (int first = 0; first < shapes->count; first += CPU_LANES) {
        box_lanes(draw, items, shapes, first, &l);
        turn_lanes(shapes, first, &l);
        for (int k = 0; k < 4; k++)
            edge_lanes(&l, k);
        const int masks = (most_of(l.height) + 7) / 8;
        if (masks)
            cover_lanes(&l, masks);
        take_masks(shapes, first, &l, masks);
    }
}

#endif
