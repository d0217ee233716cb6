// Values that vary over a triangle, as planes over the screen: perspective-correct weights of its
// corners, and its depth, at any pixel centre. They follow from the corners in clip space (Olano &
// Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997). This works for
// triangles that cross the near plane too, and does not depend on how they are clipped.
#ifndef RG_KERNELS_DIALECT_DRAW_TRIANGLE_H
#define RG_KERNELS_DIALECT_DRAW_TRIANGLE_H

#include "kernels/dialect/draw/clip.h"

// value(px, py) = x dx + y dy + at, with (dx, dy) from the planes' origin to the pixel's centre.
RG_STRUCT(rg_plane)
{
    float x;
    float y;
    float at;
};
RG_STRUCT_SIZE(rg_plane, 3)

RG_STRUCT(rg_planes)
{
    float origin_x; // pixels; rg_origin of the first corner
    float origin_y;
    rg_plane inverse_w; // 1 / w
    rg_plane b;         // weight of the second corner, over w
    rg_plane c;         // of the third
    rg_plane depth;
    float nearest; // depth is clamped to these two, since planes of thin triangles run off
    float farthest;
};
RG_STRUCT_SIZE(rg_planes, 16)

// Weights of the three corners; they sum to 1.
RG_STRUCT(rg_weights)
{
    float a;
    float b;
    float c;
};

// A corner in pixels from the origin, times its w.
RG_FN rg_corner rg_from_origin(rg_draw_state draw, rg_corner c, float origin_x, float origin_y)
{
    return rg_corner_make(c.x * draw.half_width + (draw.half_width - origin_x) * c.w,
                          c.y * draw.half_height + (draw.half_height - origin_y) * c.w, c.z, c.w);
}

// The planes of a triangle start at its first corner, so that tiny triangles are precise. A corner
// beyond the target is moved to the target's edge, since values computed from far away are not
// precise; one behind the eye, to the target's middle.
RG_FN float rg_origin(float x, float w, float half_size)
{
    float from_centre = w > RG_LEAST_W ? x / rg_max(w, RG_LEAST_W) * half_size : 0.0f;
    return rg_clamp(from_centre, -half_size, half_size) + half_size;
}

RG_FN rg_plane rg_plane_cross(rg_corner p, rg_corner q)
{
    rg_plane e;
    e.x = p.y * q.w - p.w * q.y;
    e.y = p.w * q.x - p.x * q.w;
    e.at = p.x * q.y - p.y * q.x;
    return e;
}

RG_FN rg_plane rg_plane_sum(rg_plane p, float a, rg_plane q, float b, rg_plane r, float c)
{
    rg_plane s;
    s.x = p.x * a + q.x * b + r.x * c;
    s.y = p.y * a + q.y * b + r.y * c;
    s.at = p.at * a + q.at * b + r.at * c;
    return s;
}

// Depth is computed as the difference from the first corner's depth. The difference is small, and
// so is its rounding error, even in thin triangles.
RG_FN rg_planes rg_planes_of(rg_draw_state draw, rg_item t)
{
    rg_planes s;
    float over_w = 1.0f / rg_max(t.a.w, RG_LEAST_W);
    s.origin_x = rg_origin(t.a.x, t.a.w, draw.half_width);
    s.origin_y = rg_origin(t.a.y, t.a.w, draw.half_height);
    rg_corner a = rg_from_origin(draw, t.a, s.origin_x, s.origin_y);
    rg_corner b = rg_from_origin(draw, t.b, s.origin_x, s.origin_y);
    rg_corner c = rg_from_origin(draw, t.c, s.origin_x, s.origin_y);
    rg_plane for_a = rg_plane_cross(b, c);
    rg_plane for_b = rg_plane_cross(c, a);
    rg_plane for_c = rg_plane_cross(a, b);
    float det = a.x * for_a.x + a.y * for_a.y + a.w * for_a.at;
    float inverse = rg_abs(det) > 1e-30f ? 1.0f / det : 0.0f;
    s.inverse_w = rg_plane_sum(for_a, inverse, for_b, inverse, for_c, inverse);
    s.b = rg_plane_sum(for_b, inverse, for_b, 0.0f, for_b, 0.0f);
    s.c = rg_plane_sum(for_c, inverse, for_c, 0.0f, for_c, 0.0f);
    float za = a.z * over_w;
    float base = a.w > RG_LEAST_W ? rg_clamp(za, 0.0f, 1.0f) : 1.0f;
    s.depth = rg_plane_sum(for_a, (a.z - base * a.w) * inverse, for_b, (b.z - base * b.w) * inverse,
                           for_c, (c.z - base * c.w) * inverse);
    s.depth.at = s.depth.at + base;
    float zb = b.z / rg_max(b.w, RG_LEAST_W);
    float zc = c.z / rg_max(c.w, RG_LEAST_W);
    bool in_front = rg_min(rg_min(a.w, b.w), c.w) > RG_LEAST_W;
    s.nearest = in_front ? rg_min(za, rg_min(zb, zc)) : 0.0f;
    s.farthest = in_front ? rg_max(za, rg_max(zb, zc)) : 1.0f;
    return s;
}

RG_FN float rg_plane_at(rg_plane p, float dx, float dy)
{
    return p.x * dx + p.y * dy + p.at;
}

// Native devices leave depth to the driver.
RG_FN float rg_planes_depth(rg_planes s, int px, int py)
{
#if RG_NATIVE_SETUP && defined(RG_STAGE_FRAGMENT)
    return gl_FragCoord.z;
#else
    float dx = rg_to_float(px) + 0.5f - s.origin_x;
    float dy = rg_to_float(py) + 0.5f - s.origin_y;
    return rg_clamp(rg_plane_at(s.depth, dx, dy), s.nearest, s.farthest);
#endif
}

// w at a pixel's centre.
RG_FN float rg_planes_w(rg_planes s, int px, int py)
{
    float dx = rg_to_float(px) + 0.5f - s.origin_x;
    float dy = rg_to_float(py) + 0.5f - s.origin_y;
    float inverse_w = RG_INTERPOLATED(gl_FragCoord.w, rg_plane_at(s.inverse_w, dx, dy));
    return 1.0f / rg_max(inverse_w, RG_LEAST_W);
}

// Perspective-correct weights at a pixel's centre. They are clamped to 0 to 1: they follow from the
// corners before snapping, and a centre on the rim may lie a little outside these.
RG_FN rg_weights rg_planes_weights(rg_planes s, int px, int py)
{
    float dx = rg_to_float(px) + 0.5f - s.origin_x;
    float dy = rg_to_float(py) + 0.5f - s.origin_y;
    float w = rg_planes_w(s, px, py);
    rg_weights k;
    k.b = RG_INTERPOLATED(rg_at.x, rg_clamp(rg_plane_at(s.b, dx, dy) * w, 0.0f, 1.0f));
    k.c = RG_INTERPOLATED(rg_at.y, rg_clamp(rg_plane_at(s.c, dx, dy) * w, 0.0f, 1.0f - k.b));
    k.a = 1.0f - k.b - k.c;
    return k;
}

#endif
