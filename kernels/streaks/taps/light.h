// The look of a billboard's pixel: a drop's streak textures, for each light and for the sky, or a
// splash's crown. A program defines STREAKS_TAPS and includes this file (kernels/streaks/rain.h).
#ifndef RG_KERNELS_STREAKS_TAPS_LIGHT_H
#define RG_KERNELS_STREAKS_TAPS_LIGHT_H

#include "kernels/streaks/rain.h"

// The sum of a drop's textures in its two views, for light of one elevation and azimuth, each times
// its share.
RG_FN float streaks_point(rg_ctx rg, streaks_params p, streaks_strip s, int column, float u,
                          float lower, float higher)
{
    float x = streaks_across(column, u, s.level);
    int level = s.level - p.first_level;
    return points_between(rg, x, s.y0, s.oscillation, level).r * lower +
           points_between(rg, x, s.y1, s.oscillation, level).r * higher;
}

// The weight of a column's texture in a drop's picture, in the lower of its views (0) or the other
// (1). A splash has one view, and a factor of its material, whose first layer it has.
RG_FN float streaks_part_of(rg_ctx rg, streaks_billboard r, int view, int column, float part)
{
    int splash = streaks_is(r, STREAKS_LOOK_SPLASH);
    int lower = streaks_view(r.shown);
    float higher = r.shown - rg_to_float(lower);
    float seen = view != 0 ? higher : 1.0f - higher;
    int drop_row = streaks_layer_of(r) * STREAKS_VIEWS + lower + view;
    int crown_row = streaks_layer_of(r) / STREAKS_FRAMES;
    int at = splash != 0 ? STREAKS_SPLASH_FACTORS + crown_row * STREAKS_COLUMNS
                         : drop_row * STREAKS_COLUMNS;
    float share = splash != 0 ? rg_to_float(1 - view) : seen;
    return factors_at(rg, at + column) * (share * part);
}

// Selects the textures that show light from a direction of length 1, on a streak that is seen along
// a ray (figure 4.6).
RG_FN streaks_lighting streaks_lighting_from(rg_ctx rg, streaks_billboard r, v3 to_light, v3 ray)
{
    float below = 1.0f - rg_to_float(2 * streaks_is(r, STREAKS_LOOK_BELOW));
    float height = rg_clamp(streaks_elevation(to_light) * below + 4.5f, 0.0f,
                            rg_to_float(STREAKS_HEIGHTS - 1));
    float azimuth =
        rg_clamp(streaks_azimuth(to_light, ray), 0.0f, rg_to_float(STREAKS_AZIMUTHS - 1));
#if STREAKS_TAPS == 8
    int elevation = rg_imin(rg_to_int(height), STREAKS_HEIGHTS - 2);
    float upper = height - rg_to_float(elevation);
#else
    int elevation = rg_to_int(height + 0.5f);
    float upper = 0.0f;
#endif
#if STREAKS_TAPS == 2
    int column = elevation * STREAKS_AZIMUTHS + rg_to_int(azimuth + 0.5f);
    float next = 0.0f;
#else
    int first = rg_imin(rg_to_int(azimuth), STREAKS_AZIMUTHS - 2);
    int column = elevation * STREAKS_AZIMUTHS + first;
    float next = azimuth - rg_to_float(first);
#endif
    streaks_lighting by;
    by.column = rg_to_uint(column) * 2u + (streaks_to_left(to_light, ray) > 0.0f ? 1u : 0u);
    by.lower = streaks_part_of(rg, r, 0, column, (1.0f - upper) * (1.0f - next));
    by.higher = streaks_part_of(rg, r, 1, column, (1.0f - upper) * (1.0f - next));
#if STREAKS_TAPS > 2
    by.lower_1 = streaks_part_of(rg, r, 0, column + 1, (1.0f - upper) * next);
    by.higher_1 = streaks_part_of(rg, r, 1, column + 1, (1.0f - upper) * next);
#endif
#if STREAKS_TAPS > 4
    int above = column + STREAKS_AZIMUTHS;
    by.lower_2 = streaks_part_of(rg, r, 0, above, upper * (1.0f - next));
    by.higher_2 = streaks_part_of(rg, r, 1, above, upper * (1.0f - next));
    by.lower_3 = streaks_part_of(rg, r, 0, above + 1, upper * next);
    by.higher_3 = streaks_part_of(rg, r, 1, above + 1, upper * next);
#endif
    return by;
}

// The vector from the eye to the middle of a billboard, where u and v are 0.5. It follows from the
// planes, so that the record need not have it.
RG_FN v3 streaks_to_middle(streaks_params p, streaks_billboard r)
{
    float ux = r.u_x - 0.5f * r.inverse_w_x;
    float uy = r.u_y - 0.5f * r.inverse_w_y;
    float u = 0.5f * r.inverse_w_at - r.u_at;
    float vx = r.v_x - 0.5f * r.inverse_w_x;
    float vy = r.v_y - 0.5f * r.inverse_w_y;
    float v = 0.5f * r.inverse_w_at - r.v_at;
    float area = ux * vy - uy * vx;
    float over_area = rg_abs(area) > 1e-30f ? 1.0f / area : 0.0f;
    float dx = (u * vy - uy * v) * over_area;
    float dy = (ux * v - u * vx) * over_area;
    float w = 1.0f / rg_max(r.inverse_w_x * dx + r.inverse_w_y * dy + r.inverse_w_at, RG_LEAST_W);
    return v3_scale(streaks_ray(p, r.origin_x + dx, r.origin_y + dy), w);
}

// Angles are those at the billboard's middle, as in the thesis.
RG_FN streaks_lighting streaks_lighting_of(rg_ctx rg, streaks_params p, streaks_billboard r,
                                           int light)
{
    scenery_light l = lights_at(rg, light);
    v3 ray = streaks_to_middle(p, r);
    v3 middle = v3_make(p.eye_x + ray.x, p.eye_y + ray.y, p.eye_s + ray.z);
    return streaks_lighting_from(rg, r, scenery_light_reach(l, middle).to_light, ray);
}

// A streak's radiance at a pixel, for light of irradiance 1.
RG_FN float streaks_streak(rg_ctx rg, streaks_params p, streaks_billboard r, streaks_spot spot,
                           streaks_lighting by)
{
    streaks_strip s = streaks_strip_of(p, r, spot.u, spot.v);
    int column = rg_to_int(by.column >> 1);
    float u = (by.column & 1u) != 0u ? 1.0f - spot.u : spot.u;
    float radiance = streaks_point(rg, p, s, column, u, by.lower, by.higher);
#if STREAKS_TAPS > 2
    radiance = radiance + streaks_point(rg, p, s, column + 1, u, by.lower_1, by.higher_1);
#endif
#if STREAKS_TAPS > 4
    int above = column + STREAKS_AZIMUTHS;
    radiance = radiance + streaks_point(rg, p, s, above, u, by.lower_2, by.higher_2);
    radiance = radiance + streaks_point(rg, p, s, above + 1, u, by.lower_3, by.higher_3);
#endif
    return radiance;
}

// The value of a drop, or of a splash (0 or 1). If all pixels show drops, nothing is computed for
// splashes.
RG_FN float streaks_either(rg_ctx rg, float drop, float crown, float splash)
{
    return rg_all_plain(rg) != 0 ? drop : streaks_between(drop, crown, splash);
}

// The part of a light that shows on a splash, which is a drop's without its textures.
RG_FN float streaks_glint(streaks_lighting by)
{
    float part = by.lower;
#if STREAKS_TAPS > 2
    part = part + by.lower_1;
#endif
#if STREAKS_TAPS > 4
    part = part + by.lower_2 + by.lower_3;
#endif
    return part;
}

// The thesis's splashes are matt, and face upwards from their surface; others are clear water.
RG_FN rgba streaks_lit_by(rg_ctx rg, streaks_params p, streaks_billboard r, int px, int py,
                          int light, streaks_lighting by)
{
    scenery_light l = lights_at(rg, light);
    streaks_spot spot = streaks_spot_at(p, r, px, py);
    scenery_reach reach = scenery_light_reach(l, spot.at);
    float matt = rg_max(v3_dot(reach.to_light, streaks_up_unpack(r.up)), 0.0f);
    float streak = SCENERY_IRRADIANCE * streaks_streak(rg, p, r, spot, by);
    float clear = SCENERY_IRRADIANCE * streaks_glint(by);
    float crown = p.splash_matt != 0 ? matt : clear;
    float splash = rg_to_float(streaks_is(r, STREAKS_LOOK_SPLASH));
    float share = reach.share * scenery_unshadowed(rg, l, spot.at) *
                  streaks_either(rg, streak, crown, splash);
    return rg_rgba(l.r * share, l.g * share, l.b * share, 0.0f);
}

RG_FN float streaks_sky_texture(rg_ctx rg, streaks_params p, streaks_strip s, int view, float x,
                                float y)
{
    float factor = factors_at(rg, STREAKS_SKY_FACTORS + s.oscillation * STREAKS_VIEWS + view);
    return skies_between(rg, x, y, s.oscillation, s.level - p.first_level).r * factor;
}

// A streak's radiance at a pixel under a sky of radiance 1 all around. It is also the share that
// the streak hides of its background.
RG_FN float scenery_sky(rg_ctx rg, streaks_params p, streaks_billboard r, streaks_spot spot)
{
    streaks_strip s = streaks_strip_of(p, r, spot.u, spot.v);
    float x = streaks_across(0, spot.u, s.level);
    return streaks_between(streaks_sky_texture(rg, p, s, s.view, x, s.y0),
                           streaks_sky_texture(rg, p, s, s.view + 1, x, s.y1), s.between);
}

RG_FN float streaks_crown_texture(rg_ctx rg, streaks_billboard r, int frame, float u, float v)
{
    int splash = streaks_is(r, STREAKS_LOOK_SPLASH);
    int layer = streaks_layer_of(r) * splash + rg_imin(frame, STREAKS_FRAMES - 1);
    return crowns_linear(rg, u, v, layer, streaks_level_of(r)).r;
}

// A splash's pixel, interpolated between the two nearest frames.
RG_FN float streaks_crown(rg_ctx rg, streaks_billboard r, streaks_spot spot)
{
    int frame = rg_to_int(r.shown);
    float mirrored = rg_to_float(streaks_is(r, STREAKS_LOOK_MIRRORED));
    float u = spot.u + mirrored * (1.0f - 2.0f * spot.u);
    return streaks_between(streaks_crown_texture(rg, r, frame, u, 1.0f - spot.v),
                           streaks_crown_texture(rg, r, frame + 1, u, 1.0f - spot.v),
                           r.shown - rg_to_float(frame));
}

// Streaks end at the surface that they hit.
RG_FN rg_fragment streaks_fragment_of(rg_ctx rg, streaks_params p, streaks_billboard r, int px,
                                      int py, rgba lit)
{
    streaks_spot spot = streaks_spot_at(p, r, px, py);
    float splash = rg_to_float(streaks_is(r, STREAKS_LOOK_SPLASH));
    float share = r.share * streaks_place_of(r, spot.u, spot.v).window;
    float sky = share * scenery_sky(rg, p, r, spot);
    float crown = r.share * streaks_crown(rg, r, spot);
    // A billboard that stands for many drops covers a pixel at most once, and shines no more than
    // that.
    float once = 1.0f / rg_max(streaks_either(rg, sky, crown, splash), 1.0f);
    float from_sky = once * streaks_either(rg, sky * p.gain, crown * p.splash_gain, splash);
    float from_lights = once * streaks_either(rg, share * p.gain, crown * p.splash_gain, splash);
    float opacity = once * streaks_either(rg, sky * p.opacity, crown * p.splash_opacity, splash);
    rgba c =
        rg_rgba(from_sky * p.sky_r + from_lights * lit.r, from_sky * p.sky_g + from_lights * lit.g,
                from_sky * p.sky_b + from_lights * lit.b, rg_min(opacity, 1.0f));
    rg_fragment f = rg_fragment_make(c, spot.depth);
    f.kept = 1 - streaks_below(r.hit, spot.at.z);
    return f;
}

#endif
