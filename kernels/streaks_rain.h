// streaks: particles as billboards, drops and splashes alike (Creus, section 4.4.2). A program
// defines STREAKS_TAPS, the streak textures that are read for each light: 2 (between views), 4 (and
// between azimuths of the light) or 8 (and between its elevations), and includes this.
#include "math.h"
#include "streaks_cells.h"
#include "streaks_light.h"
#include "streaks_params.h"
#include "triangle.h"

#define RG_PARAMS streaks_params
#define RG_SLOTS                                                                                   \
    IN(1, float, particles)                                                                        \
    IN(2, uint, blocks)                                                                            \
    IMAGE(3, D32F, depths)                                                                         \
    IMAGE(4, R16F, points)                                                                         \
    IMAGE(5, R16F, skies)                                                                          \
    IMAGE(6, R16F, crowns)                                                                         \
    IN(7, float, factors)                                                                          \
    IN(8, streaks_light, lights)                                                                   \
    IMAGE(9, D32F, shadows) IMAGE(10, RGBA8, numbers) IN(11, uint, surfaces)
#define RG_CORNERS 4
#define RG_LIGHTS

// What the fragments of a billboard share. v grows from `base` along `axis`, u to the side.
// Flat: gcc gathers words of a flat record for many pixels at once, not those of nested ones.
RG_STRUCT(streaks_billboard)
{
    // rg_planes
    float origin_x, origin_y;
    float inverse_w_x, inverse_w_y, inverse_w_at;
    float u_x, u_y, u_at;
    float v_x, v_y, v_at;
    float depth_x, depth_y, depth_at;
    float nearest, farthest;
    // The middle of its lower end, a drop's or the place that was hit, and the way to the other.
    float base_x, base_y, base_s;
    float axis_x, axis_y, axis_s;
    float hit;
    float splash;    // 1, or 0 of a drop
    int oscillation; // its image's layer and level, as the full atlas counts; of a splash any
    int level;
    int crown; // the first layer and the level of a splash's images; of a drop any
    int crown_level;
    float frame;     // of the splash
    float flip;      // 1: mirrored
    float view;      // the camera's elevation, in steps of the atlas, 0 to 4
    float below;     // -1: seen from below, so that elevations change their signs; else 1
    float towards_x; // where the camera lies across the fall, of length 1
    float towards_y;
};
#define RG_RECORD streaks_billboard
#include "draw.h"

#include "streaks_material.h"
#include "streaks_particle.h"
#include "streaks_shadow.h"

// --- item: the billboard ---

RG_STRUCT(streaks_shape)
{
    v3 base;
    v3 axis;
    float half_width;
};

// Splashes differ in size, by 15 % at most.
RG_FN float streaks_size(uint random)
{
    return 0.85f + 0.3f * rg_to_float(rg_to_int(random & 1023u)) / 1023.0f;
}

RG_FN streaks_shape streaks_shape_of(streaks_params p, streaks_particle t)
{
    int splash = t.state == STREAKS_SPLASH ? 1 : 0;
    float size = streaks_size(streaks_hash(t.number));
    float tall = p.splash_height * size;
    streaks_shape shape;
    shape.base = v3_make(t.x, t.y, splash != 0 ? t.hit : t.s + p.ahead);
    shape.axis = v3_make(splash != 0 ? p.up_x * tall : 0.0f, splash != 0 ? p.up_y * tall : 0.0f,
                         splash != 0 ? p.up_s * tall : -(p.ahead + p.behind));
    shape.half_width = splash != 0 ? 0.5f * p.splash_width * size : p.half_width;
    return shape;
}

// From the axis to the rim on its left, as the eye sees it.
RG_FN v3 streaks_side(streaks_params p, streaks_shape shape)
{
    v3 from_eye = v3_make(shape.base.x - p.eye_x, shape.base.y - p.eye_y, shape.base.z - p.eye_s);
    v3 beside = v3_cross(shape.axis, from_eye);
    return v3_scale(beside, shape.half_width / rg_sqrt(rg_max(v3_dot(beside, beside), 1e-12f)));
}

RG_FN rg_corner streaks_turned(m4 m, v3 d)
{
    return rg_corner_make(
        m.xx * d.x + m.xy * d.y + m.xz * d.z, m.yx * d.x + m.yy * d.y + m.yz * d.z,
        m.zx * d.x + m.zy * d.y + m.zz * d.z, m.wx * d.x + m.wy * d.y + m.wz * d.z);
}

RG_FN rg_corner streaks_sum(rg_corner a, rg_corner b, float times)
{
    return rg_corner_make(a.x + b.x * times, a.y + b.y * times, a.z + b.z * times,
                          a.w + b.w * times);
}

RG_FN rg_item streaks_item_of(streaks_params p, streaks_shape shape)
{
    rg_corner base = m4_project(p.to_clip, shape.base);
    rg_corner end = streaks_sum(base, streaks_turned(p.to_clip, shape.axis), 1.0f);
    rg_corner side = streaks_turned(p.to_clip, streaks_side(p, shape));
    rg_item t;
    t.alive = 1;
    t.a = streaks_sum(base, side, 1.0f);
    t.b = streaks_sum(base, side, -1.0f);
    t.c = streaks_sum(end, side, -1.0f);
    t.d = streaks_sum(end, side, 1.0f);
    return t;
}

// --- record ---

// The level at which a texel is nearest to a pixel in size.
RG_FN int streaks_level(float texels, float pixels, int last)
{
    float ratio = rg_max(texels / rg_max(pixels, 1e-6f), 1.0f);
    return rg_imin(rg_to_int(rg_log2(ratio) + 0.5f), last);
}

// 180 / pi / 20, written out: compilers round what they reckon beforehand in ways of their own.
#define STREAKS_STEPS_A_RADIAN 2.86478898f

RG_FN float streaks_steps(float radians)
{
    return radians * STREAKS_STEPS_A_RADIAN;
}

// Elevation above the plane across the fall, of a direction of length 1, in steps of 20 degrees.
RG_FN float streaks_elevation(v3 d)
{
    return streaks_steps(rg_atan2(-d.z, rg_sqrt(rg_max(1.0f - d.z * d.z, 0.0f))));
}

RG_FN streaks_billboard streaks_look(streaks_params p, streaks_billboard of, streaks_shape shape)
{
    streaks_billboard r = of;
    v3 middle = v3_add(shape.base, v3_scale(shape.axis, 0.5f));
    v3 to_eye = v3_unit(v3_make(p.eye_x - middle.x, p.eye_y - middle.y, p.eye_s - middle.z));
    float elevation = streaks_elevation(to_eye);
    r.below = 1.0f - rg_to_float(2 * streaks_below(elevation, 0.0f) * (1 - p.paper_angles));
    r.view = rg_min(rg_abs(elevation), rg_to_float(STREAKS_VIEWS - 1));
    float across = 1.0f / rg_max(rg_hypot(to_eye.x, to_eye.y), 1e-6f);
    r.towards_x = to_eye.x * across;
    r.towards_y = to_eye.y * across;
    float distance = rg_max(m4_project(p.to_clip, middle).w, 1e-3f);
    float pixels = 2.0f * shape.half_width * p.focal_px / distance;
    r.level =
        rg_imax(streaks_level(rg_to_float(STREAKS_CELL_PX), pixels, p.last_level), p.first_level);
    r.crown_level = streaks_level(rg_to_float(STREAKS_SPLASH_PX), pixels, STREAKS_SPLASH_LAST);
    return r;
}

RG_FN streaks_billboard streaks_placed(streaks_billboard of, rg_planes planes, streaks_shape shape)
{
    streaks_billboard r = of;
    r.origin_x = planes.origin_x;
    r.origin_y = planes.origin_y;
    r.inverse_w_x = planes.inverse_w.x;
    r.inverse_w_y = planes.inverse_w.y;
    r.inverse_w_at = planes.inverse_w.at;
    r.u_x = planes.b.x;
    r.u_y = planes.b.y;
    r.u_at = planes.b.at;
    r.v_x = planes.c.x;
    r.v_y = planes.c.y;
    r.v_at = planes.c.at;
    r.depth_x = planes.depth.x;
    r.depth_y = planes.depth.y;
    r.depth_at = planes.depth.at;
    r.nearest = planes.nearest;
    r.farthest = planes.farthest;
    r.base_x = shape.base.x;
    r.base_y = shape.base.y;
    r.base_s = shape.base.z;
    r.axis_x = shape.axis.x;
    r.axis_y = shape.axis.y;
    r.axis_s = shape.axis.z;
    return r;
}

RG_FN streaks_billboard streaks_billboard_of(rg_ctx rg, rg_draw_state draw, streaks_params p, int i)
{
    streaks_particle t = streaks_particle_at(rg, p, i);
    streaks_shape shape = streaks_shape_of(p, t);
    rg_item corner = streaks_item_of(p, shape);
    corner.c = corner.d;
    uint random = streaks_hash(t.number);
    streaks_billboard r;
    r = streaks_placed(r, rg_planes_of(draw, corner), shape);
    r.hit = t.hit;
    r.splash = t.state == STREAKS_SPLASH ? 1.0f : 0.0f;
    r.oscillation = t.oscillation;
    r.crown = streaks_material(rg, p, t) * STREAKS_FRAMES;
    r.frame = rg_clamp(t.age / p.splash_s, 0.0f, 0.999f) * rg_to_float(STREAKS_FRAMES);
    r.flip = rg_to_float(rg_to_int((random >> 10) & 1u));
    return streaks_look(p, r, shape);
}

// --- fragment ---

// A pixel's place on its billboard, 0 to 1, and in the rain frame, on the axis.
RG_STRUCT(streaks_spot)
{
    float u;
    float v;
    v3 at;
    float depth;
};

RG_FN streaks_spot streaks_spot_at(streaks_billboard r, int px, int py)
{
    float dx = rg_to_float(px) + 0.5f - r.origin_x;
    float dy = rg_to_float(py) + 0.5f - r.origin_y;
    float w = 1.0f / rg_max(r.inverse_w_x * dx + r.inverse_w_y * dy + r.inverse_w_at, RG_LEAST_W);
    streaks_spot spot;
    spot.u = rg_clamp((r.u_x * dx + r.u_y * dy + r.u_at) * w, 0.0f, 1.0f);
    spot.v = rg_clamp((r.v_x * dx + r.v_y * dy + r.v_at) * w, 0.0f, 1.0f);
    spot.at = v3_make(r.base_x + r.axis_x * spot.v, r.base_y + r.axis_y * spot.v,
                      r.base_s + r.axis_s * spot.v);
    spot.depth = rg_clamp(r.depth_x * dx + r.depth_y * dy + r.depth_at, r.nearest, r.farthest);
    return spot;
}

RG_FN int streaks_view_below(streaks_billboard r)
{
    return rg_imin(rg_to_int(r.view), STREAKS_VIEWS - 2);
}

RG_FN float streaks_point_texture(rg_ctx rg, streaks_params p, streaks_billboard r, int view,
                                  int column, float u, float v)
{
    streaks_place at = streaks_cell(column, view, u, v, r.level);
    float factor =
        factors_at(rg, (r.oscillation * STREAKS_VIEWS + view) * STREAKS_COLUMNS + column);
    return points_between(rg, at.x, at.y, r.oscillation, r.level - p.first_level).r * factor;
}

RG_FN float streaks_between(float a, float b, float t)
{
    return a + (b - a) * t;
}

// Between the two nearest views.
RG_FN float streaks_views(rg_ctx rg, streaks_params p, streaks_billboard r, int elevation,
                          int azimuth, float u, float v)
{
    int view = streaks_view_below(r);
    int column = elevation * STREAKS_AZIMUTHS + azimuth;
    return streaks_between(streaks_point_texture(rg, p, r, view, column, u, v),
                           streaks_point_texture(rg, p, r, view + 1, column, u, v),
                           r.view - rg_to_float(view));
}

// Light from an elevation and an azimuth, both in steps of the atlas from its first on.
RG_FN float streaks_azimuths(rg_ctx rg, streaks_params p, streaks_billboard r, int elevation,
                             float azimuth, float u, float v)
{
#if STREAKS_TAPS == 2
    return streaks_views(rg, p, r, elevation, rg_to_int(azimuth + 0.5f), u, v);
#else
    int first = rg_imin(rg_to_int(azimuth), STREAKS_AZIMUTHS - 2);
    return streaks_between(streaks_views(rg, p, r, elevation, first, u, v),
                           streaks_views(rg, p, r, elevation, first + 1, u, v),
                           azimuth - rg_to_float(first));
#endif
}

RG_FN float streaks_point(rg_ctx rg, streaks_params p, streaks_billboard r, float elevation,
                          float azimuth, float u, float v)
{
#if STREAKS_TAPS == 8
    int first = rg_imin(rg_to_int(elevation), STREAKS_HEIGHTS - 2);
    return streaks_between(streaks_azimuths(rg, p, r, first, azimuth, u, v),
                           streaks_azimuths(rg, p, r, first + 1, azimuth, u, v),
                           elevation - rg_to_float(first));
#else
    return streaks_azimuths(rg, p, r, rg_to_int(elevation + 0.5f), azimuth, u, v);
#endif
}

// What a light of brightness 1 from a direction of length 1 makes of a streak's pixel (figure 4.6).
RG_FN float streaks_streak(rg_ctx rg, streaks_params p, streaks_billboard r, v3 to_light, float u,
                           float v)
{
    float cosine = to_light.x * r.towards_x + to_light.y * r.towards_y;
    float sine = r.towards_x * to_light.y - r.towards_y * to_light.x;
    float azimuth = streaks_steps(rg_atan2(rg_abs(sine), cosine)) - 0.5f;
    float elevation = streaks_elevation(to_light) * r.below + 4.5f;
    float mirrored = sine > 0.0f ? 1.0f - u : u;
    return streaks_point(rg, p, r, rg_clamp(elevation, 0.0f, rg_to_float(STREAKS_HEIGHTS - 1)),
                         rg_clamp(azimuth, 0.0f, rg_to_float(STREAKS_AZIMUTHS - 1)), mirrored,
                         1.0f - v);
}

// Splashes are matt and face upwards.
RG_FN rgba streaks_lit_by(rg_ctx rg, streaks_params p, streaks_billboard r, int px, int py,
                          int light)
{
    streaks_light l = lights_at(rg, light);
    streaks_spot spot = streaks_spot_at(r, px, py);
    streaks_reach reach = streaks_light_reach(l, spot.at);
    float matt = rg_max(
        reach.to_light.x * p.up_x + reach.to_light.y * p.up_y + reach.to_light.z * p.up_s, 0.0f);
    float streak = streaks_streak(rg, p, r, reach.to_light, spot.u, spot.v);
    float share =
        reach.share * streaks_unshadowed(rg, l, spot.at) * streaks_between(streak, matt, r.splash);
    return rg_rgba(l.r * share, l.g * share, l.b * share, 0.0f);
}

RG_FN float streaks_sky_texture(rg_ctx rg, streaks_params p, streaks_billboard r, int view, float u,
                                float v)
{
    streaks_place at = streaks_cell(0, view, u, v, r.level);
    float factor = factors_at(rg, STREAKS_SKY_FACTORS + r.oscillation * STREAKS_VIEWS + view);
    return skies_between(rg, at.x, at.y, r.oscillation, r.level - p.first_level).r * factor;
}

// A streak's pixel under a sky of brightness 1 all around, which is also what it hides of what lies
// behind it.
RG_FN float streaks_sky(rg_ctx rg, streaks_params p, streaks_billboard r, streaks_spot spot)
{
    int view = streaks_view_below(r);
    float v = 1.0f - spot.v;
    return streaks_between(streaks_sky_texture(rg, p, r, view, spot.u, v),
                           streaks_sky_texture(rg, p, r, view + 1, spot.u, v),
                           r.view - rg_to_float(view));
}

RG_FN float streaks_crown_texture(rg_ctx rg, streaks_billboard r, int frame, float u, float v)
{
    int layer = r.crown + rg_imin(frame, STREAKS_FRAMES - 1);
    return crowns_linear(rg, u, v, layer, r.crown_level).r;
}

// A splash's pixel, between the two nearest frames.
RG_FN float streaks_crown(rg_ctx rg, streaks_billboard r, streaks_spot spot)
{
    int frame = rg_to_int(r.frame);
    float u = spot.u + r.flip * (1.0f - 2.0f * spot.u);
    return streaks_between(streaks_crown_texture(rg, r, frame, u, 1.0f - spot.v),
                           streaks_crown_texture(rg, r, frame + 1, u, 1.0f - spot.v),
                           r.frame - rg_to_float(frame));
}

// Streaks end at the surface that they hit.
RG_FN rg_fragment streaks_fragment_of(rg_ctx rg, streaks_params p, streaks_billboard r, int px,
                                      int py, rgba lit)
{
    streaks_spot spot = streaks_spot_at(r, px, py);
    float sky = streaks_sky(rg, p, r, spot);
    float crown = streaks_crown(rg, r, spot);
    float from_sky = streaks_between(sky * p.gain, crown * p.splash_gain, r.splash);
    float from_lights = streaks_between(p.gain, crown * p.splash_gain, r.splash);
    float opacity = streaks_between(sky * p.opacity, crown * p.splash_opacity, r.splash);
    rgba c =
        rg_rgba(from_sky * p.sky_r + from_lights * lit.r, from_sky * p.sky_g + from_lights * lit.g,
                from_sky * p.sky_b + from_lights * lit.b, rg_min(opacity, 1.0f));
    rg_fragment f = rg_fragment_make(c, spot.depth);
    f.kept = 1 - streaks_below(r.hit + r.splash * RG_LARGEST, spot.at.z);
    return f;
}
