// streaks: particles as billboards, drops and splashes alike (Creus, section 4.4.2). A program
// defines STREAKS_TAPS, the number of streak textures that are read for each light, and includes
// taps/light.h. 2 textures blend views, 4 the light's azimuths too, and 8 its elevations as well.
#include "kernels/dialect/math.h"
#include "kernels/streaks/cells.h"
#include "kernels/scenery/light.h"
#include "kernels/streaks/params.h"
#include "kernels/dialect/draw/triangle.h"

#define RG_PARAMS streaks_params
#define RG_SLOTS                                                                                   \
    IN(1, float, particles)                                                                        \
    IN(2, uint, blocks)                                                                            \
    IMAGE(3, D32F, depths)                                                                         \
    SAMPLED(4, R16F, points, FILTERED)                                                             \
    SAMPLED(5, R16F, skies, FILTERED)                                                              \
    SAMPLED(6, R16F, crowns, FILTERED)                                                             \
    IN(7, float, factors)                                                                          \
    IN(8, scenery_light, lights)                                                                   \
    SAMPLED(9, D32F, shadows, SHADOW) IMAGE(10, RGBA8, numbers) IN(11, uint, surfaces)
#define RG_CORNERS 4
#define RG_LIGHTS

// The values that the fragments of a billboard share: v grows from its lower end upwards, u to the
// side. A pixel's place in space follows from its w. The record has few words, because cpu gathers
// each of them for each pixel of a small billboard. It has no structs, because gcc gathers nothing
// from these.
RG_STRUCT(streaks_billboard)
{
    // rg_planes
    float origin_x, origin_y;
    float inverse_w_x, inverse_w_y, inverse_w_at;
    float u_x, u_y, u_at;
    float v_x, v_y, v_at;
    float hit;    // s of the surface that cuts it off; far below a splash
    float nearer; // distance by which it is drawn nearer than it is, in metres along the view
    uint up;      // of a splash: streaks_up_pack of its upward direction
    float shown;  // a drop's elevation of the camera, in steps of the atlas; a splash's frame
    // For a drop, the time for which it covers a place on its way, relative to the atlas' drop,
    // times the number of drops that it stands for. For a splash, that number, faded at its end and
    // in the distance, and where it is drawn larger than it is.
    float share;
    // For drops. Lengths are in its radii, as the eye sees them.
    float way;     // way of its fall in the exposure
    float lacking; // at either end for a pixel's length
    float turn;    // its swing at the lower end, in cycles
    float cycles;  // of its slower swing, in the exposure
    uint look;     // STREAKS_LOOK_*
    uint rows;     // of a drop's two views: their first rows in the atlas, 12 bits each
};
#define RG_RECORD streaks_billboard
#define RG_PLAIN
#define RG_COLUMNS
#define RG_GROUP_ITEMS STREAKS_BLOCK
#define RG_GROUP       streaks_block

// The streak textures by which a light shows on a drop, and the part of each: one in either view,
// for the nearest column, or for its neighbours too.
RG_STRUCT(streaks_lighting)
{
    uint column;         // the first, times 2; odd if its pictures are mirrored
    float lower, higher; // of the first column, in the lower view and in the other
#if STREAKS_TAPS > 2
    float lower_1, higher_1; // the next azimuth
#endif
#if STREAKS_TAPS > 4
    float lower_2, higher_2; // the next elevation
    float lower_3, higher_3; // and both
#endif
};
#define RG_LIGHT_RECORD streaks_lighting
#include "kernels/dialect/draw/draw.h"

#include "kernels/streaks/material.h"
#include "kernels/streaks/particle.h"
#include "kernels/scenery/shadow.h"

// --- item: the billboard ---

RG_STRUCT(streaks_shape)
{
    v3 base;
    v3 axis;
    v3 middle;
    float pixel;      // at the middle, in metres
    float half_width; // of the atlas' picture
    float weight;     // drops that it stands for
    float covering;   // half of the billboard's width, at least half of thinnest_px
    float thinner;    // share of it that a splash covers: less than 1 below a pixel's size
    float rim;        // beyond either end of the axis, as the eye sees it
    v3 up;            // of a splash
    float nearer;     // distance by which it is drawn nearer than it is
    // For drops, in radii, as the eye sees them.
    v3 to_eye;     // from the middle, of length 1: no radii
    float way;     // in the exposure
    float lacking; // at either end for a pixel's length
};

// Splashes of drops of one size differ, by 15 % at most, in width and in height.
RG_FN float streaks_size(uint random)
{
    return 0.85f + 0.3f * rg_to_float(rg_to_int(random & 1023u)) / 1023.0f;
}

// The part of a splash's picture below the impact shows water in front of it, but would lie under
// the ground. So the splash is drawn nearer, until its lower edge is above the ground.
RG_FN float streaks_nearer(streaks_shape shape, float below)
{
    float sine = v3_dot(shape.to_eye, shape.up);
    return below / rg_max(sine, 0.05f) + 0.002f;
}

// The length of a vector of length 1 across another.
RG_FN float streaks_across_of(v3 d, v3 other)
{
    float slant = v3_dot(d, other);
    return rg_sqrt(rg_max(1.0f - slant * slant, 0.0f));
}

RG_FN streaks_shape streaks_shape_of(rg_ctx rg, streaks_params p, streaks_particle t)
{
    int splash = t.state == STREAKS_SPLASH ? 1 : 0;
    uint random = streaks_hash(t.number);
    float size = streaks_size(random) * t.radius;
    float tall = p.splash_height * streaks_size(random >> 22) * t.radius;
    float fall = p.fall * t.speed;
    float drop_radius = p.drop_radius * t.radius;
    float half_width = p.half_width * t.radius;
    streaks_shape shape;
    shape.weight = t.weight;
    shape.up = streaks_up(rg, p, t);
    float under = splash != 0 ? tall * p.splash_foot : 0.0f;
    float foot = t.hit + streaks_slope(rg, p, t, shape.up);
    float stands = rg_to_float(splash);
    float fallen = stands * (foot - shape.up.z * under) + (1.0f - stands) * t.s;
    shape.base = v3_make(t.x - shape.up.x * under, t.y - shape.up.y * under, fallen);
    shape.axis =
        v3_make(splash != 0 ? shape.up.x * tall : 0.0f, splash != 0 ? shape.up.y * tall : 0.0f,
                splash != 0 ? shape.up.z * tall : -fall);
    shape.middle = v3_add(shape.base, v3_scale(shape.axis, 0.5f));
    shape.pixel = rg_max(m4_project(p.to_clip, shape.middle).w, 1e-3f) / p.focal_px;
    shape.half_width = splash != 0 ? 0.5f * p.splash_width * size : half_width;
    float thinnest = p.thinnest_px * shape.pixel;
    float covering = rg_max(shape.half_width, 0.5f * thinnest);
    v3 to_eye = v3_unit(
        v3_make(p.eye_x - shape.middle.x, p.eye_y - shape.middle.y, p.eye_s - shape.middle.z));
    float way = fall * rg_hypot(to_eye.x, to_eye.y);
    float lacking = rg_max(0.5f * (thinnest - way), 0.0f);
    shape.to_eye = to_eye;
    shape.nearer = splash != 0 ? streaks_nearer(shape, under) : 0.0f;
    shape.way = rg_max(way / drop_radius, 1e-3f);
    shape.lacking = lacking / drop_radius;
    float seen = tall * streaks_across_of(shape.up, to_eye);
    float short_by = 0.5f * rg_max(thinnest - seen, 0.0f);
    shape.covering = covering;
    shape.thinner = shape.half_width / covering * (seen / rg_max(seen + 2.0f * short_by, 1e-6f));
    shape.rim = splash != 0 ? short_by : rg_max(drop_radius, lacking);
    return shape;
}

// A billboard's directions as the eye sees it: to the left of its axis, and along it. The axis is
// foreshortened; a drop's width is not.
RG_STRUCT(streaks_frame)
{
    v3 left;
    v3 along;
};

RG_FN streaks_frame streaks_frame_of(streaks_params p, streaks_shape shape)
{
    v3 from_eye = v3_make(shape.base.x - p.eye_x, shape.base.y - p.eye_y, shape.base.z - p.eye_s);
    streaks_frame frame;
    frame.left = streaks_unit(v3_cross(shape.axis, from_eye));
    frame.along = streaks_unit(v3_cross(from_eye, frame.left));
    return frame;
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
    streaks_frame frame = streaks_frame_of(p, shape);
    v3 rim = v3_scale(frame.along, shape.rim);
    v3 length = v3_add(shape.axis, v3_scale(rim, 2.0f));
    rg_corner base = m4_project(p.to_clip, v3_add(shape.base, v3_scale(rim, -1.0f)));
    rg_corner end = streaks_sum(base, streaks_turned(p.to_clip, length), 1.0f);
    rg_corner side = streaks_turned(p.to_clip, v3_scale(frame.left, shape.covering));
    rg_item t;
    t.alive = 1;
    t.a = streaks_sum(base, side, 1.0f);
    t.b = streaks_sum(base, side, -1.0f);
    t.c = streaks_sum(end, side, -1.0f);
    t.d = streaks_sum(end, side, 1.0f);
    return t;
}

// --- record ---

// The level whose texels are nearest to pixels in size.
RG_FN int streaks_level(float texels, float pixels, int last)
{
    float ratio = rg_max(texels / rg_max(pixels, 1e-6f), 1.0f);
    return rg_imin(rg_to_int(rg_log2(ratio) + 0.5f), last);
}

// The word `look` from the lowest bit: three bits with names; three of the level, counted as in the
// full atlas or in a splash's images; six of the layer, which is a drop's oscillation or the first
// of a splash's; twelve of the row after a drop's second view.
#define STREAKS_LOOK_SPLASH   1u
#define STREAKS_LOOK_MIRRORED 2u // of splashes
#define STREAKS_LOOK_BELOW    4u // of drops: seen from below, so that elevations change their signs

RG_FN uint streaks_look(uint bits, int level, int layer)
{
    return bits + rg_to_uint(level) * 8u + rg_to_uint(layer) * 64u;
}

RG_FN int streaks_is(streaks_billboard r, uint bit)
{
    return (r.look & bit) != 0u ? 1 : 0;
}

RG_FN int streaks_level_of(streaks_billboard r)
{
    return rg_to_int((r.look >> 3) & 7u);
}

RG_FN int streaks_layer_of(streaks_billboard r)
{
    return rg_to_int((r.look >> 6) & 63u);
}

// The level of a billboard's images: a drop's, counted as in the full atlas, or a splash's.
RG_FN int streaks_level_for(streaks_params p, streaks_shape shape, int splash)
{
    float pixels = 2.0f * shape.half_width / shape.pixel;
    int texels = splash != 0 ? STREAKS_SPLASH_PX : STREAKS_CELL_PX;
    int first = splash != 0 ? 0 : p.first_level;
    int last = splash != 0 ? STREAKS_SPLASH_LAST : p.last_level;
    return rg_imax(streaks_level(rg_to_float(texels), pixels, last), first);
}

// A drop covers a place on its way for as long as its diameter takes to pass: the longer its
// streak, the fainter. A streak that is thinner than a pixel is drawn a pixel wide, and fainter.
RG_FN float streaks_share(streaks_shape shape, float shown)
{
    float one =
        2.0f / (shape.way * streaks_steadiness_at(shown)) * (shape.half_width / shape.covering);
    return one * shape.weight;
}

RG_FN streaks_billboard streaks_drop(streaks_params p, streaks_billboard of, streaks_particle t,
                                     streaks_shape shape, int level)
{
    streaks_billboard r = of;
    float elevation = streaks_elevation(shape.to_eye);
    uint below = rg_to_uint(streaks_below(elevation, 0.0f) * (1 - p.paper_angles));
    r.hit = t.hit;
    r.shown = rg_min(rg_abs(elevation), rg_to_float(STREAKS_VIEWS - 1));
    r.way = shape.way;
    r.lacking = shape.lacking;
    r.share = streaks_share(shape, r.shown);
    r.turn = streaks_turn(p, t);
    r.cycles = p.cycles * t.swing;
    int view = streaks_view(r.shown);
    uint end = rg_to_uint(streaks_row(view + 2) >> level);
    r.look = streaks_look(below * STREAKS_LOOK_BELOW + end * 4096u, level, t.oscillation);
    r.rows =
        rg_to_uint(streaks_row(view) >> level) + rg_to_uint(streaks_row(view + 1) >> level) * 4096u;
    return r;
}

// A splash's upward direction never points along the fall, so that its last component needs no
// sign. With ten bits each, signs included, light that grazes the surface was off by 1.5 %.
RG_FN uint streaks_up_pack(v3 up)
{
    float ends = 1023.0f;
    uint x = rg_to_uint(rg_to_int(rg_floor(rg_clamp(up.x, -1.0f, 1.0f) * ends + 1024.5f)));
    uint y = rg_to_uint(rg_to_int(rg_floor(rg_clamp(up.y, -1.0f, 1.0f) * ends + 1024.5f)));
    uint z = rg_to_uint(rg_to_int(rg_floor(rg_clamp(-up.z, 0.0f, 1.0f) * ends + 0.5f)));
    return x | (y << 11) | (z << 22);
}

RG_FN v3 streaks_up_unpack(uint bits)
{
    float x = rg_to_float(rg_to_int(bits & 0x7ffu) - 1024);
    float y = rg_to_float(rg_to_int((bits >> 11) & 0x7ffu) - 1024);
    return v3_scale(v3_make(x, y, -rg_to_float(rg_to_int(bits >> 22))), 1.0f / 1023.0f);
}

// A frame shows the middle of its time; the last one fades, so that no splash ends at once.
RG_FN streaks_billboard streaks_splash(rg_ctx rg, streaks_params p, streaks_billboard of,
                                       streaks_particle t, streaks_shape shape, int level)
{
    streaks_billboard r = of;
    int material = streaks_material(rg, p, t);
    float frames = rg_to_float(STREAKS_FRAMES);
    float passed = rg_clamp(t.age / p.splash_s, 0.0f, 1.0f) * frames;
    float away = rg_hypot(t.x - p.eye_x, t.y - p.eye_y);
    float kept = rg_clamp(p.splash_last - away * p.splash_fade, 0.0f, 1.0f);
    r.hit = RG_LARGEST;
    r.nearer = shape.nearer;
    r.up = streaks_up_pack(shape.up);
    r.share = t.weight * shape.thinner * rg_min(frames - passed, 1.0f) * kept;
    r.shown = rg_clamp(passed - 0.5f, 0.0f, frames - 1.001f);
    r.look = streaks_look(STREAKS_LOOK_SPLASH +
                              ((streaks_hash(t.number) >> 10) & 1u) * STREAKS_LOOK_MIRRORED,
                          level, material * STREAKS_FRAMES);
    r.rows = 0u;
    return r;
}

RG_FN streaks_billboard streaks_placed(rg_planes planes)
{
    streaks_billboard r;
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
    r.hit = 0.0f;
    r.nearer = 0.0f;
    r.up = 0u;
    r.shown = 0.0f;
    r.share = 1.0f;
    r.way = 1.0f;
    r.lacking = 0.0f;
    r.turn = 0.0f;
    r.cycles = 0.0f;
    r.look = 0u;
    r.rows = 0u;
    return r;
}

RG_FN streaks_billboard streaks_billboard_of(rg_ctx rg, rg_draw_state draw, streaks_params p, int i)
{
    streaks_particle t = streaks_particle_at(rg, p, i);
    streaks_shape shape = streaks_shape_of(rg, p, t);
    rg_item corner = streaks_item_of(p, shape);
    corner.c = corner.d;
    streaks_billboard placed = streaks_placed(rg_planes_of(draw, corner));
    int is_splash = t.state == STREAKS_SPLASH ? 1 : 0;
    int level = streaks_level_for(p, shape, is_splash);
    streaks_billboard drop = streaks_drop(p, placed, t, shape, level);
    streaks_billboard splash = streaks_splash(rg, p, placed, t, shape, level);
    streaks_billboard r = placed;
    r.hit = is_splash != 0 ? splash.hit : drop.hit;
    r.nearer = is_splash != 0 ? splash.nearer : drop.nearer;
    r.up = splash.up;
    r.shown = is_splash != 0 ? splash.shown : drop.shown;
    r.share = is_splash != 0 ? splash.share : drop.share;
    r.way = is_splash != 0 ? splash.way : drop.way;
    r.lacking = is_splash != 0 ? splash.lacking : drop.lacking;
    r.turn = is_splash != 0 ? splash.turn : drop.turn;
    r.cycles = is_splash != 0 ? splash.cycles : drop.cycles;
    r.look = is_splash != 0 ? splash.look : drop.look;
    r.rows = is_splash != 0 ? splash.rows : drop.rows;
    return r;
}

// --- fragment ---

// A pixel's place on its billboard, 0 to 1, and in the rain frame.
RG_STRUCT(streaks_spot)
{
    float u;
    float v;
    v3 at;
    float depth;
};

// The ray from the eye through a place of the picture, as long as 1 along the view.
RG_FN v3 streaks_ray(streaks_params p, float x, float y)
{
    return v3_make(p.rays.xx * x + p.rays.xy * y + p.rays.xz,
                   p.rays.yx * x + p.rays.yy * y + p.rays.yz,
                   p.rays.zx * x + p.rays.zy * y + p.rays.zz);
}

RG_FN streaks_spot streaks_spot_at(streaks_params p, streaks_billboard r, int px, int py)
{
    float x = rg_to_float(px) + 0.5f;
    float y = rg_to_float(py) + 0.5f;
    streaks_spot spot;
    float dx = x - r.origin_x;
    float dy = y - r.origin_y;
    float inverse_w = rg_max(
        RG_INTERPOLATED(gl_FragCoord.w, r.inverse_w_x * dx + r.inverse_w_y * dy + r.inverse_w_at),
        RG_LEAST_W);
    float w = 1.0f / inverse_w;
    spot.u = RG_INTERPOLATED(rg_at.x, rg_clamp((r.u_x * dx + r.u_y * dy + r.u_at) * w, 0.0f, 1.0f));
    spot.v = RG_INTERPOLATED(rg_at.y, rg_clamp((r.v_x * dx + r.v_y * dy + r.v_at) * w, 0.0f, 1.0f));
    v3 ray = streaks_ray(p, x, y);
    spot.at = v3_make(p.eye_x + ray.x * w, p.eye_y + ray.y * w, p.eye_s + ray.z * w);
    float before = inverse_w / rg_max(1.0f - r.nearer * inverse_w, 0.1f);
    spot.depth = p.depth_far + p.depth_per_w * before;
    return spot;
}

// A place on a streak.
RG_STRUCT(streaks_place)
{
    float passed; // the share of the exposure still to come when the drop is there, 0 to 1
    float window; // less than 1 at the ends, where only a part of the drop passes
};

// Half the width of a drop's picture, in its radii.
#define STREAKS_CELL_RADII 1.34771f

// The chord of a drop that passes a place covers it; it is lengthened, so that no streak is shorter
// than a pixel. Less of it passes if the exposure begins or ends meanwhile.
RG_FN streaks_place streaks_place_of(streaks_billboard r, float u, float v)
{
    float rim = rg_max(1.0f, r.lacking);
    float at = v * (r.way + 2.0f * rim) - rim;
    float x = (2.0f * u - 1.0f) * STREAKS_CELL_RADII;
    float half_chord = rg_max(rg_sqrt(rg_max(1.0f - x * x, 0.0f)), rg_max(r.lacking, 0.25f));
    float passes = rg_min(at + half_chord, r.way) - rg_max(at - half_chord, 0.0f);
    streaks_place t;
    t.passed = rg_clamp(at / r.way, 0.0f, 1.0f);
    t.window = rg_max(passes, 0.0f) / (2.0f * half_chord);
    return t;
}

// The places of a drop's textures; for a splash, any places in the atlas.
RG_STRUCT(streaks_strip)
{
    int oscillation;
    int level; // as the full atlas counts
    int view;  // the lower of two
    float between;
    float y0, y1; // of the lower view, and of the other, in texels
};

// A place in a view's row of the atlas, which shows one swing from top to bottom.
RG_FN float streaks_along(float first, float size, int level, float turn)
{
    float rim = STREAKS_RIM_PX / rg_to_float(1 << level);
    return first + rim + (size - 2.0f * rim) * turn;
}

RG_FN streaks_strip streaks_strip_of(streaks_params p, streaks_billboard r, float u, float v)
{
    int drop = 1 - streaks_is(r, STREAKS_LOOK_SPLASH);
    float first = rg_to_float(rg_to_int(r.rows & 4095u));
    float second = rg_to_float(rg_to_int(r.rows >> 12));
    float end = rg_to_float(rg_to_int(r.look >> 12));
    streaks_strip s;
    s.oscillation = streaks_layer_of(r) * drop;
    s.level = p.first_level + (streaks_level_of(r) - p.first_level) * drop;
    s.view = streaks_view(r.shown);
    s.between = r.shown - rg_to_float(s.view);
    float turn = streaks_part(r.turn - r.cycles * streaks_place_of(r, u, v).passed);
    s.y0 = streaks_along(first, second - first, s.level, turn);
    s.y1 = streaks_along(second, end - second, s.level, turn);
    return s;
}

RG_FN float streaks_between(float a, float b, float t)
{
    return a + (b - a) * t;
}
