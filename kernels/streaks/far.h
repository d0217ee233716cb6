// streaks: rain beyond the culling radius as layers around the observer, patterns that scroll down
// with the fall (Creus, section 5.5, after section 3.2.1). A layer is a cylinder about the fall's
// axis. It hides as much of what lies behind it as all drops within its thickness would.
#include "kernels/dialect/math.h"
#include "kernels/dialect/rng.h"
#include "kernels/streaks/far_params.h"

#define RG_PARAMS streaks_far_params
#define RG_SLOTS

RG_STRUCT(streaks_far_layer)
{
    float distance;
    float columns;
    int layer;
};
#define RG_RECORD streaks_far_layer
#include "kernels/dialect/draw/view_quad.h"

RG_DRAW_ITEM(streaks_far)
{
    return view_quad();
}

// Item 0 is the farthest layer.
RG_DRAW_RECORD(streaks_far)
{
    streaks_far_layer r;
    r.layer = draw.item_end - 1 - i;
    r.distance = p.nearest + (rg_to_float(r.layer) + 0.5f) * p.thickness;
    r.columns = rg_floor(p.columns * r.distance / p.nearest + 0.5f);
    return r;
}

// 0 to 1, of one cell of the pattern.
RG_FN float streaks_far_noise(int seed, int column, int row)
{
    uint repeated = rg_to_uint(row) & (STREAKS_FAR_ROWS - 1u);
    uint h = rg_to_uint(column) * 0x9e3779b9u + repeated * 0x85ebca6bu + rg_to_uint(seed);
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return rg_uniform(h ^ (h >> 16));
}

// The pattern's brightness, 0 to 1: columns without a seam, each with a phase of its own.
RG_FN float streaks_far_pattern(streaks_far_params p, streaks_far_layer r, float azimuth, float s)
{
    float across = (azimuth * 0.159154943f + 0.5f) * r.columns;
    int column = rg_to_int(rg_clamp(across, 0.0f, r.columns - 1.0f));
    int seed = p.seed + 7919 * r.layer;
    float along = s / p.cell_length + 64.0f * streaks_far_noise(seed, column, -1);
    float row = rg_floor(along);
    float t = along - row;
    float smooth_t = t * t * (3.0f - 2.0f * t);
    float above = streaks_far_noise(seed, column, rg_to_int(row));
    float below = streaks_far_noise(seed, column, rg_to_int(row) + 1);
    return above + (below - above) * smooth_t;
}

RG_DRAW_FRAGMENT(streaks_far)
{
    float x = rg_to_float(px) + 0.5f;
    float y = rg_to_float(py) + 0.5f;
    v3 ray = v3_make(p.rays.xx * x + p.rays.xy * y + p.rays.xz,
                     p.rays.yx * x + p.rays.yy * y + p.rays.yz,
                     p.rays.zx * x + p.rays.zy * y + p.rays.zz);
    float across = rg_max(rg_hypot(ray.x, ray.y), 1e-3f);
    v3 at = v3_add(v3_make(p.eye_x, p.eye_y, p.eye_s), v3_scale(ray, r.distance / across));
    float pattern = streaks_far_pattern(p, r, rg_atan2(ray.y, ray.x), at.z - p.fallen);
    float alpha = rg_clamp(p.opacity * (1.0f + p.contrast * (2.0f * pattern - 1.0f)), 0.0f, 1.0f);
    rg_corner clip = m4_project(p.to_clip, at);
    return rg_fragment_make(rg_rgba(p.r * alpha, p.g * alpha, p.b * alpha, alpha),
                            clip.z / rg_max(clip.w, RG_LEAST_W));
}
