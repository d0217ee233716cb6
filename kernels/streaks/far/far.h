// streaks: rain beyond the culling radius, as slabs of the rain space (Creus, section 5.5, after
// section 3.2.1). A slab adds and hides as much as the drops between its planes would, in the mean
// and the variance of a pixel. The mean is drops per cubic metre, times their light, times the
// length of the pixel's ray in the slab. Slabs stand still in the rain space: x = i * thickness for
// rays that run along x more than along y, and y = i * thickness for the others.
#include "kernels/dialect/math.h"
#include "kernels/dialect/rng.h"
#include "kernels/scenery/light.h"
#include "kernels/streaks/cells.h"
#include "kernels/streaks/far/params.h"

#define RG_PARAMS streaks_far_params
#define RG_SLOTS                                                                                   \
    IN(1, float, means)                                                                            \
    IMAGE(2, D32F, density)                                                                        \
    IMAGE(3, D32F, depths)                                                                         \
    IN(4, scenery_light, lights) SAMPLED(5, D32F, shadows, SHADOW)
#define RG_LIGHTS

RG_STRUCT(streaks_far_slab)
{
    int number; // counted from the one in which far rain begins
};
#define RG_RECORD streaks_far_slab
#include "kernels/dialect/draw/view_quad.h"

#include "kernels/scenery/shadow.h"
#include "kernels/streaks/hit.h"

RG_DRAW_ITEM(streaks_far)
{
    return view_quad();
}

// Item 0 is the farthest slab.
RG_DRAW_RECORD(streaks_far)
{
    streaks_far_slab r;
    r.number = draw.item_end - 1 - i;
    return r;
}

// --- what a pixel's ray has of a slab ---

RG_STRUCT(streaks_far_way)
{
    v3 ray;      // of length 1, from the eye
    float first; // metres along it
    float last;
    float ahead; // along the view, to the middle
    float plane; // metres along the ray, to the slab's middle plane
    float away;  // of that plane, straight from the eye
    int side;    // 0 to 3: the direction that the slab faces
    int index;   // of the slab in the rain space
    v3 middle;
};

RG_FN streaks_far_way streaks_far_way_of(streaks_far_params p, streaks_far_slab r, int px, int py)
{
    m4 m = p.rain.rays;
    float x = rg_to_float(px) + 0.5f;
    float y = rg_to_float(py) + 0.5f;
    v3 ray =
        v3_make(m.xx * x + m.xy * y + m.xz, m.yx * x + m.yy * y + m.yz, m.zx * x + m.zy * y + m.zz);
    int along_x = rg_abs(ray.x) >= rg_abs(ray.y) ? 1 : 0;
    float towards = along_x != 0 ? ray.x : ray.y;
    float eye = along_x != 0 ? p.rain.eye_x : p.rain.eye_y;
    float turned = towards < 0.0f ? -eye : eye;
    float steep = rg_max(rg_abs(towards), 1e-6f);
    float length = rg_sqrt(rg_max(v3_dot(ray, ray), 1e-12f));
    float begin = rg_floor((turned + p.nearest) / p.thickness) + rg_to_float(r.number);
    float low = begin * p.thickness - turned;
    float first = rg_max(low, p.nearest);
    float last = rg_max(rg_min(low + p.thickness, p.farthest), first);
    streaks_far_way way;
    way.away = low + 0.5f * p.thickness;
    way.ahead = 0.5f * (first + last) / steep;
    way.first = first / steep * length;
    way.last = last / steep * length;
    way.plane = way.away / steep * length;
    way.ray = v3_scale(ray, 1.0f / length);
    way.side = 2 * along_x + (towards < 0.0f ? 1 : 0);
    way.index = rg_to_int(begin);
    way.middle =
        v3_add(v3_make(p.rain.eye_x, p.rain.eye_y, p.rain.eye_s), v3_scale(ray, way.ahead));
    return way;
}

// Drops per cubic metre at a place: 0 outside the rain space, and below the surface that they hit.
RG_FN float streaks_far_drops(rg_ctx rg, streaks_far_params p, v3 at)
{
    float width = rg_to_float(density_width(rg, 0));
    float height = rg_to_float(density_height(rg, 0));
    float u = (at.x / p.rain.half_x + 1.0f) * 0.5f;
    float v = (at.y / p.rain.half_y + 1.0f) * 0.5f;
    float there = density_texel(rg, rg_to_int(rg_clamp(u * width, 0.0f, width - 1.0f)),
                                rg_to_int(rg_clamp(v * height, 0.0f, height - 1.0f)), 0, 0)
                      .r;
    int outside = streaks_below(u, 0.0f) | streaks_below(v, 0.0f) | streaks_below(1.0f, u) |
                  streaks_below(1.0f, v) | streaks_below(at.z, 0.0f);
    streaks_map_place under =
        streaks_map_place_at(p.rain, at.x, at.y, depths_width(rg, 0), depths_height(rg, 0));
    int falls = streaks_below(at.z, streaks_hit(rg, p.rain, under)) & (1 - outside);
    return p.drops_m3 * there * rg_to_float(falls);
}

// --- what a drop adds ---

RG_FN float streaks_far_shown(streaks_far_way way)
{
    return streaks_elevation(v3_scale(way.ray, -1.0f));
}

RG_FN float streaks_far_view(float elevation)
{
    return rg_min(rg_abs(elevation), rg_to_float(STREAKS_VIEWS - 1));
}

// The light that a streak adds: its mean over all oscillations and places on the swing, and its
// mean square.
RG_STRUCT(streaks_far_lit)
{
    float mean;
    float square;
};

// Weights of two neighbours along an axis of the atlas. `parts` has those of each for the mean.
// `squares` has those for the mean square: of the first one's square, of the product of both, and
// of the second one's square.
RG_STRUCT(streaks_far_blend)
{
    int low; // the first neighbour
    v3 parts;
    v3 squares;
};

// With `both` 1, each drop shows a part t of the second neighbour. With 0, a part t of the drops
// shows the second neighbour alone.
RG_FN streaks_far_blend streaks_far_blend_of(int low, float t, float both)
{
    float product = both * t * (1.0f - t);
    streaks_far_blend blend;
    blend.low = low;
    blend.parts = v3_make(1.0f - t, t, 0.0f);
    blend.squares = v3_make(1.0f - t - product, 2.0f * product, t - product);
    return blend;
}

RG_FN streaks_far_blend streaks_far_views(float shown)
{
    int view = streaks_view(shown);
    return streaks_far_blend_of(view, shown - rg_to_float(view), 1.0f);
}

RG_FN float streaks_far_pair(rg_ctx rg, int at, v3 weights)
{
    return means_at(rg, at) * weights.x + means_at(rg, at + 1) * weights.y;
}

RG_FN float streaks_far_triple(rg_ctx rg, int at, v3 weights)
{
    return means_at(rg, at) * weights.x + means_at(rg, at + 1) * weights.y +
           means_at(rg, at + 2) * weights.z;
}

// The light of the sky, blended from two views.
RG_FN streaks_far_lit streaks_far_sky(rg_ctx rg, float shown)
{
    streaks_far_blend views = streaks_far_views(shown);
    int at = STREAKS_FAR_BLOCKS * STREAKS_FAR_BLOCK + views.low * STREAKS_FAR_SKY;
    streaks_far_lit lit;
    lit.mean = streaks_far_pair(rg, at, views.parts);
    lit.square = streaks_far_triple(rg, at + 2, views.squares);
    return lit;
}

// Blends 4 means, in rows of azimuths.
RG_FN float streaks_far_flat(rg_ctx rg, int at, v3 on, v3 up)
{
    return streaks_far_pair(rg, at, on) * up.x + streaks_far_pair(rg, at + 2, on) * up.y;
}

// Blends 9 products, in rows of azimuths.
RG_FN float streaks_far_square(rg_ctx rg, int at, v3 on, v3 up)
{
    return streaks_far_triple(rg, at, on) * up.x + streaks_far_triple(rg, at + 3, on) * up.y +
           streaks_far_triple(rg, at + 6, on) * up.z;
}

// A light as one half of a slab sees it, at one of the two places of Gauss' rule: its place in the
// atlas, and its strength.
RG_STRUCT(streaks_far_seen)
{
    float elevation;
    float azimuth;
    float reaches; // of the light, as if it were at 1 m
};

// Blends elevations, azimuths and views.
RG_FN streaks_far_lit streaks_far_cell(rg_ctx rg, streaks_far_blend up, streaks_far_blend on,
                                       float shown)
{
    streaks_far_blend views = streaks_far_views(shown);
    int at =
        ((views.low * STREAKS_FAR_HIGH + up.low) * STREAKS_FAR_WIDE + on.low) * STREAKS_FAR_BLOCK;
    int squares = at + STREAKS_FAR_SQUARES;
    streaks_far_lit lit;
    lit.mean = streaks_far_flat(rg, at, on.parts, up.parts) * views.parts.x +
               streaks_far_flat(rg, at + 4, on.parts, up.parts) * views.parts.y;
    lit.square = streaks_far_square(rg, squares, on.squares, up.squares) * views.squares.x +
                 streaks_far_square(rg, squares + 9, on.squares, up.squares) * views.squares.y +
                 streaks_far_square(rg, squares + 18, on.squares, up.squares) * views.squares.z;
    return lit;
}

// Shares of the distance between the two places of Gauss' rule: from one of them to the middle of
// its half, towards the other; and the half's length.
#define STREAKS_FAR_INWARDS 0.0669872981f
#define STREAKS_FAR_HALF    0.866025404f

// With `both` 1, drops show both neighbours; with 0, the nearer one. Then the drops of the half
// about a place are spread evenly over the part of the axis that the half sees.
RG_FN streaks_far_blend streaks_far_axis(float here, float other, int last, float both)
{
    float place = here + (other - here) * (STREAKS_FAR_INWARDS * (1.0f - both));
    float extent = rg_clamp(rg_abs(other - here) * STREAKS_FAR_HALF, 1e-4f, 1.0f);
    int low = rg_imin(rg_to_int(place), last);
    float on = place - rg_to_float(low);
    float beyond = rg_clamp((on - 0.5f) / extent + 0.5f, 0.0f, 1.0f);
    return streaks_far_blend_of(low, beyond + (on - beyond) * both, both);
}

// The light of the half of a slab about one place of Gauss' rule. It blends as many textures of the
// atlas as streaks near the observer read.
RG_FN streaks_far_lit streaks_far_streak(rg_ctx rg, streaks_far_params p, float shown,
                                         streaks_far_seen here, streaks_far_seen other)
{
    streaks_far_blend up = streaks_far_axis(here.elevation, other.elevation, STREAKS_FAR_HIGH - 1,
                                            p.taps == 8 ? 1.0f : 0.0f);
    streaks_far_blend on = streaks_far_axis(here.azimuth, other.azimuth, STREAKS_FAR_WIDE - 1,
                                            p.taps >= 4 ? 1.0f : 0.0f);
    streaks_far_lit lit = streaks_far_cell(rg, up, on, shown);
    lit.mean = lit.mean * here.reaches;
    lit.square = lit.square * here.reaches * here.reaches;
    return lit;
}

// The strength of a light between two places of a ray, which falls off with the squared distance:
// its mean, and its mean square. Drops are lit as at two places, by Gauss' rule in the angle at
// which the light sees them.
RG_STRUCT(streaks_far_fall)
{
    float mean;
    float square;
    float at0, at1; // metres along the ray
    float nearer;   // the first place's share of the mean square
};

RG_FN float streaks_far_strength(float beside2, float x)
{
    return 1.0f / (beside2 + x * x);
}

// The distance from the middle to a place of Gauss' rule of two points, which is at 1 / sqrt(3) of
// the half.
#define STREAKS_FAR_NODE 0.288675135f

RG_FN float streaks_far_tangent(float angle)
{
    return rg_sin(angle) / rg_max(rg_cos(angle), 1e-5f);
}

RG_FN streaks_far_fall streaks_far_fall_of(v3 eye, streaks_far_way way, scenery_light l)
{
    v3 to = v3_make(l.x - eye.x, l.y - eye.y, l.z - eye.z);
    float foot = v3_dot(to, way.ray);
    float beside2 = rg_max(v3_dot(to, to) - foot * foot, SCENERY_NEAREST_SQUARED_M2);
    float beside = rg_sqrt(beside2);
    float x0 = way.first - foot;
    float x1 = way.last - foot;
    float length = rg_max(x1 - x0, 1e-6f);
    float angle = rg_atan2(beside * length, beside2 + x0 * x1);
    float middle = rg_atan2(x0, beside) + 0.5f * angle;
    float node = STREAKS_FAR_NODE * angle;
    int sun = l.kind == SCENERY_SUN ? 1 : 0;
    float at0 = sun != 0 ? x0 + 0.25f * length : beside * streaks_far_tangent(middle - node);
    float at1 = sun != 0 ? x0 + 0.75f * length : beside * streaks_far_tangent(middle + node);
    float s0 = sun != 0 ? 1.0f : streaks_far_strength(beside2, at0);
    float s1 = sun != 0 ? 1.0f : streaks_far_strength(beside2, at1);
    float f0 = streaks_far_strength(beside2, x0);
    float f1 = streaks_far_strength(beside2, x1);
    float fm = streaks_far_strength(beside2, 0.5f * (x0 + x1));
    float near = (x1 * f1 - x0 * f0 + angle / beside) / (2.0f * beside2 * length);
    float far = (f0 * f0 + 4.0f * fm * fm + f1 * f1) / 6.0f;
    float nearest = rg_min(x0 * x0, x1 * x1) + beside2;
    streaks_far_fall fall;
    fall.mean = sun != 0 ? 1.0f : angle / (beside * length);
    // Far away the exact form is a difference of large numbers, and Simpson's rule is as good. A
    // sum makes the choice, because gcc does not vectorise a choice that is the same for all pixels
    // inside one that is not.
    float lamp = rg_to_float(1 - sun);
    fall.square = 1.0f - lamp + lamp * (nearest > 9.0f * length * length ? far : near);
    fall.at0 = foot + at0;
    fall.at1 = foot + at1;
    fall.nearer = s0 / (s0 + s1);
    return fall;
}

RG_FN streaks_far_seen streaks_far_seen_at(rg_ctx rg, streaks_far_params p, scenery_light l,
                                           streaks_far_way way, v3 at)
{
    scenery_reach reach = scenery_light_reach(l, at);
    float cosine = -(reach.to_light.x * l.dx + reach.to_light.y * l.dy + reach.to_light.z * l.dz);
    float cone = l.kind == SCENERY_SPOT ? scenery_cone(l, cosine) : 1.0f;
    float below = 1.0f - rg_to_float(2 * streaks_below(streaks_far_shown(way), 0.0f) *
                                     (1 - p.rain.paper_angles));
    streaks_far_seen seen;
    seen.reaches = SCENERY_IRRADIANCE * cone * scenery_unshadowed(rg, l, at);
    seen.elevation = rg_clamp(streaks_elevation(reach.to_light) * below + 4.5f, 0.0f,
                              rg_to_float(STREAKS_HEIGHTS - 1));
    seen.azimuth =
        rg_clamp(streaks_azimuth(reach.to_light, way.ray), 0.0f, rg_to_float(STREAKS_AZIMUTHS - 1));
    return seen;
}

RG_FN float streaks_far_grey(float r, float g, float b)
{
    return (r + g + b) * 0.333333343f;
}

// The light that a drop of the slab adds: the mean, and in `a` the variance of the mean of the
// colours. Variances of several lights are added up, because the lights of a drop hardly correlate.
RG_DRAW_LIGHT(streaks_far)
{
    scenery_light l = lights_at(rg, light);
    streaks_far_way way = streaks_far_way_of(p, r, px, py);
    v3 eye = v3_make(p.rain.eye_x, p.rain.eye_y, p.rain.eye_s);
    streaks_far_fall fall = streaks_far_fall_of(eye, way, l);
    streaks_far_seen first =
        streaks_far_seen_at(rg, p, l, way, v3_add(eye, v3_scale(way.ray, fall.at0)));
    streaks_far_seen second =
        streaks_far_seen_at(rg, p, l, way, v3_add(eye, v3_scale(way.ray, fall.at1)));
    float shown = streaks_far_view(streaks_far_shown(way));
    streaks_far_lit a = streaks_far_streak(rg, p, shown, first, second);
    streaks_far_lit b = streaks_far_streak(rg, p, shown, second, first);
    float share = fall.mean * 0.5f * (a.mean + b.mean);
    float square = fall.square * (b.square + (a.square - b.square) * fall.nearer);
    float grey = streaks_far_grey(l.r, l.g, l.b);
    return rg_rgba(l.r * share, l.g * share, l.b * share, grey * grey * (square - share * share));
}

// --- the pattern ---

// The square metres that a streak covers, if it were equally strong all over. Its light is spread
// over them like that of streaks near the observer (kernels/streaks/rain.h).
RG_FN float streaks_far_footprint(streaks_far_params p, streaks_far_way way)
{
    float thinnest = p.rain.thinnest_px * way.ahead / p.rain.focal_px;
    float covering = rg_max(2.0f * p.rain.half_width, thinnest);
    float fallen = p.rain.fall * rg_hypot(way.ray.x, way.ray.y);
    float chord = rg_max(1.57079637f * p.rain.drop_radius, thinnest - fallen);
    float longer = rg_max(fallen, chord);
    return covering * longer * longer / (longer - rg_min(fallen, chord) / 3.0f);
}

RG_FN float streaks_far_random(uint a, uint b, uint c)
{
    uint h = a * 0x9e3779b9u + b * 0x85ebca6bu + c * 0xc2b2ae35u;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return rg_uniform(h ^ (h >> 16));
}

// The random number, 0 to 1, of the grain that a pixel sees. Grains are as long as a streak, and
// fall in columns of the slab's middle plane. Columns are one to two pixels wide, in powers of 2 of
// a metre, so that they do not change while the observer moves.
RG_FN float streaks_far_grain(streaks_far_params p, streaks_far_way way)
{
    float thinnest = rg_max(p.rain.thinnest_px * way.away / p.rain.focal_px, p.rain.half_width);
    float wide = rg_exp2(-rg_floor(-rg_log2(thinnest)));
    float across =
        way.side >= 2 ? p.rain.eye_y + way.ray.y * way.plane : p.rain.eye_x + way.ray.x * way.plane;
    float s = p.rain.eye_s + way.ray.z * way.plane;
    uint slab = rg_to_uint(4 * way.index + way.side) + 7919u * rg_to_uint(p.seed);
    uint column = rg_to_uint(rg_to_int(rg_floor(across / wide)));
    float begin = 64.0f * streaks_far_random(slab, column, 0x10001u);
    float row = rg_floor((s - p.fallen) / (p.rain.fall + wide) + begin);
    return streaks_far_random(slab, column, rg_to_uint(rg_to_int(row)) & 0xffffu);
}

// Turns uniform numbers, 0 to 1, into numbers with a mean of 1 and this variance. These are uniform
// up to a variance of a third; beyond it, more and more of them are 0.
RG_FN float streaks_far_spread(float random, float variance)
{
    float some = rg_min(4.0f / (3.0f * (1.0f + variance)), 1.0f);
    float few = random < some ? 2.0f * random / (some * some) : 0.0f;
    float many = 1.0f + rg_sqrt(3.0f * variance) * (2.0f * random - 1.0f);
    return variance > 0.333333343f ? few : many;
}

RG_DRAW_FRAGMENT(streaks_far)
{
    streaks_far_way way = streaks_far_way_of(p, r, px, py);
    float shown = streaks_far_view(streaks_far_shown(way));
    v3 step = v3_scale(way.ray, (way.last - way.first) / 3.0f);
    float drops_m3 = streaks_far_drops(rg, p, way.middle) +
                     streaks_far_drops(rg, p, v3_add(way.middle, step)) +
                     streaks_far_drops(rg, p, v3_add(way.middle, v3_scale(step, -1.0f)));
    float drops_m2 = drops_m3 / 3.0f * (way.last - way.first);
    streaks_far_lit sky = streaks_far_sky(rg, shown);
    float section =
        drops_m2 * 4.0f * p.rain.drop_radius * p.rain.half_width / streaks_steadiness_at(shown);
    float light_r = p.rain.sky_r * sky.mean + lit.r;
    float light_g = p.rain.sky_g * sky.mean + lit.g;
    float light_b = p.rain.sky_b * sky.mean + lit.b;
    float grey = rg_max(streaks_far_grey(light_r, light_g, light_b), 1e-12f);
    float grey_sky = streaks_far_grey(p.rain.sky_r, p.rain.sky_g, p.rain.sky_b);
    float of_sky = sky.square - sky.mean * sky.mean;
    float crowded = 1.0f / rg_max(drops_m2 * streaks_far_footprint(p, way), 1e-6f);
    float hidden = crowded * (1.0f + of_sky / rg_max(sky.mean * sky.mean, 1e-12f));
    float varied = rg_max(grey_sky * grey_sky * of_sky + lit.a, 0.0f);
    float spread = crowded * (1.0f + varied / (grey * grey));
    float grain = streaks_far_grain(p, way);
    float light = p.rain.gain * section * streaks_far_spread(grain, spread);
    float alpha = p.rain.opacity * section * sky.mean * streaks_far_spread(grain, hidden);
    rg_fragment f = rg_fragment_make(
        rg_rgba(light_r * light, light_g * light, light_b * light, rg_min(alpha, 1.0f)),
        p.rain.depth_far + p.rain.depth_per_w / way.ahead);
    f.kept = drops_m2 > 0.0f ? 1 : 0;
    return f;
}
