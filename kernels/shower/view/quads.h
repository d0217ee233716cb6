// shower: drops as small textured quads that face the eye, for which the paper's segments stand in.
// None is narrower than a pixel.
#include "kernels/dialect/math.h"
#include "kernels/shower/view/params.h"
#include "kernels/shower/particle.h"

#define RG_PARAMS  shower_view_params
#define RG_SLOTS   IN(1, float, particles) SAMPLED(2, R16F, drop, FILTERED)
#define RG_CORNERS 4

// u runs across the quad, v from its upper end to its lower one: both are linear functions of the
// pixel.
RG_STRUCT(shower_quad)
{
    float u_x, u_y, u_at;
    float v_x, v_y, v_at;
    float depth;
    float alpha;
};
#define RG_RECORD shower_quad
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

#include "kernels/shower/view/look.h"

// A drop's extents along and across, in pixels.
RG_STRUCT(shower_sides)
{
    float x, y; // unit vector along the drop, upwards
    float high; // length
    float wide;
};

RG_FN shower_sides shower_sides_of(shower_drop d)
{
    float x = d.high_x - d.low_x;
    float y = d.high_y - d.low_y;
    shower_sides s;
    s.high = rg_max(rg_hypot(x, y), 1e-3f);
    s.x = x / s.high;
    s.y = y / s.high;
    s.wide = rg_max(d.width_px, 1.0f);
    return s;
}

RG_DRAW_ITEM(shower_quads)
{
    shower_drop d = shower_drop_at(rg, p, i);
    shower_sides s = shower_sides_of(d);
    return shower_item(p, d, -0.5f * s.wide * s.y, 0.5f * s.wide * s.x);
}

RG_DRAW_RECORD(shower_quads)
{
    shower_drop d = shower_drop_at(rg, p, i);
    shower_sides s = shower_sides_of(d);
    float x = d.low_x + p.half_width;
    float y = d.low_y + p.half_height;
    shower_quad r;
    r.u_x = -s.y / s.wide;
    r.u_y = s.x / s.wide;
    r.u_at = 0.5f - x * r.u_x - y * r.u_y;
    r.v_x = -s.x / s.high;
    r.v_y = -s.y / s.high;
    r.v_at = 1.0f - x * r.v_x - y * r.v_y;
    r.depth = d.depth;
    r.alpha = shower_opacity(p, d);
    return r;
}

RG_DRAW_FRAGMENT(shower_quads)
{
    float x = rg_to_float(px) + 0.5f;
    float y = rg_to_float(py) + 0.5f;
    // u runs from the first corner to the last.
    float u = RG_INTERPOLATED(rg_at.y, r.u_x * x + r.u_y * y + r.u_at);
    float v = RG_INTERPOLATED(1.0f - rg_at.x, r.v_x * x + r.v_y * y + r.v_at);
    float alpha = r.alpha * drop_linear(rg, u, v, 0, 0).r;
    return rg_fragment_make(rg_rgba(p.r * alpha, p.g * alpha, p.b * alpha, alpha), r.depth);
}
