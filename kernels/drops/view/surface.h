// The water's surface between the cells of the slot height, which the including program has. It is
// a bicubic B-spline over 4 x 4 cells, with its slope and bend, which are continuous.
#ifndef RG_KERNELS_DROPS_VIEW_SURFACE_H
#define RG_KERNELS_DROPS_VIEW_SURFACE_H

#include "kernels/drops/params.h"

// A weight for each of four cells in a row.
RG_STRUCT(drops_weights)
{
    float a;
    float b;
    float c;
    float d;
};

// Weights of the value at a place `f`, 0 to 1, between the second and the third cell; below, of its
// first and second derivative there, per cell.
RG_FN drops_weights drops_value_weights(float f)
{
    float g = 1.0f - f;
    drops_weights w;
    w.a = 0.16666667f * g * g * g;
    w.b = 0.16666667f * (4.0f - f * f * (6.0f - 3.0f * f));
    w.c = 0.16666667f * (4.0f - g * g * (6.0f - 3.0f * g));
    w.d = 0.16666667f * f * f * f;
    return w;
}

RG_FN drops_weights drops_slope_weights(float f)
{
    float g = 1.0f - f;
    drops_weights w;
    w.a = -0.5f * g * g;
    w.b = f * (1.5f * f - 2.0f);
    w.c = g * (2.0f - 1.5f * g);
    w.d = 0.5f * f * f;
    return w;
}

RG_FN drops_weights drops_bend_weights(float f)
{
    drops_weights w;
    w.a = 1.0f - f;
    w.b = 3.0f * f - 2.0f;
    w.c = 1.0f - 3.0f * f;
    w.d = f;
    return w;
}

RG_FN float drops_weighed(drops_weights w, float a, float b, float c, float d)
{
    return w.a * a + w.b * b + w.c * c + w.d * d;
}

// A row of cells at a place along it.
RG_STRUCT(drops_profile)
{
    float value;
    float slope;
    float bend;
};

RG_STRUCT(drops_surface)
{
    float height;  // mm
    float slope_x; // mm/mm, to the right
    float slope_y; // down
    float bend;    // change of the slope, 1/mm: the root of its squares in all directions
};

// The cells of columns `first` to `first` + 3; beyond the pane's edges the outermost repeat, so
// that water there lies as it does at the edge.
RG_FN drops_profile drops_profile_of(rg_ctx rg, int stride, int columns, int rows, int first,
                                     int row, float f)
{
    int last = columns - 1;
    int line = (rg_iclamp(row, 0, rows - 1) + DROPS_MARGIN) * stride + DROPS_MARGIN;
    float a = height_at(rg, line + rg_iclamp(first, 0, last));
    float b = height_at(rg, line + rg_iclamp(first + 1, 0, last));
    float c = height_at(rg, line + rg_iclamp(first + 2, 0, last));
    float d = height_at(rg, line + rg_iclamp(first + 3, 0, last));
    drops_profile q;
    q.value = drops_weighed(drops_value_weights(f), a, b, c, d);
    q.slope = drops_weighed(drops_slope_weights(f), a, b, c, d);
    q.bend = drops_weighed(drops_bend_weights(f), a, b, c, d);
    return q;
}

// The surface at a place on the pane, in mm.
RG_FN drops_surface drops_surface_at(rg_ctx rg, int stride, int columns, int rows, float cell_mm,
                                     float x_mm, float y_mm)
{
    float per_mm = 1.0f / cell_mm;
    float u = x_mm * per_mm - 0.5f;
    float v = y_mm * per_mm - 0.5f;
    float left = rg_floor(u);
    float top = rg_floor(v);
    int first = rg_to_int(left) - 1;
    int row = rg_to_int(top) - 1;
    drops_profile a = drops_profile_of(rg, stride, columns, rows, first, row, u - left);
    drops_profile b = drops_profile_of(rg, stride, columns, rows, first, row + 1, u - left);
    drops_profile c = drops_profile_of(rg, stride, columns, rows, first, row + 2, u - left);
    drops_profile d = drops_profile_of(rg, stride, columns, rows, first, row + 3, u - left);
    drops_weights value = drops_value_weights(v - top);
    drops_weights slope = drops_slope_weights(v - top);
    float xx = drops_weighed(value, a.bend, b.bend, c.bend, d.bend);
    float xy = drops_weighed(slope, a.slope, b.slope, c.slope, d.slope);
    float yy = drops_weighed(drops_bend_weights(v - top), a.value, b.value, c.value, d.value);
    drops_surface s;
    s.height = drops_weighed(value, a.value, b.value, c.value, d.value);
    s.slope_x = drops_weighed(value, a.slope, b.slope, c.slope, d.slope) * per_mm;
    s.slope_y = drops_weighed(slope, a.value, b.value, c.value, d.value) * per_mm;
    s.bend = rg_sqrt(xx * xx + 2.0f * xy * xy + yy * yy) * per_mm * per_mm;
    return s;
}

#endif
