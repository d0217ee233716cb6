// Puddles: a bluish film where the water on an upward face is deep enough, with a rim of ink and,
// towards the light, a stroke of white inside it. The ground has hollows: `beds` says how much
// earlier than elsewhere water is seen in a column.
#include "kernels/cartoon/water/params.h"
#include "kernels/dialect/math.h"

#define RG_PARAMS cartoon_water_params
#define RG_SLOTS                                                                                   \
    IN(1, uint, water) IMAGE(2, D32F, depth_map) IMAGE(3, RGBA16F, normal_map) IN(4, float, beds)
#include "kernels/dialect/draw/view_quad.h"

RG_DRAW_ITEM(cartoon_puddles)
{
    return view_quad();
}

RG_DRAW_RECORD(cartoon_puddles)
{
    return view_quad_record();
}

// The film, in display values, and how much of the ground it covers.
#define CARTOON_FILM_R     0.52f
#define CARTOON_FILM_G     0.72f
#define CARTOON_FILM_B     0.92f
#define CARTOON_FILM_COVER 0.6f
#define CARTOON_RIM_COVER  0.9f
// Places of the rim and the highlight, in pixels from the water's edge.
#define CARTOON_RIM_PX   1.3f
#define CARTOON_SHINE_PX 3.6f

RG_FN v3 cartoon_ground_at(cartoon_water_params p, float depth, int px, int py)
{
    rg_corner c =
        m4_project(p.from_pixel, v3_make(rg_to_float(px) + 0.5f, rg_to_float(py) + 0.5f, depth));
    float over_w = 1.0f / rg_max(c.w, 1e-9f);
    return v3_make(c.x * over_w, c.y * over_w, c.z * over_w);
}

RG_FN float cartoon_level_of(rg_ctx rg, cartoon_water_params p, int x, int y)
{
    int column = rg_iclamp(x, 0, CARTOON_COLUMNS - 1);
    int row = rg_iclamp(y, 0, CARTOON_COLUMNS - 1);
    int at = row * CARTOON_COLUMNS + column;
    float halves = rg_to_float(rg_to_int(water_at(rg, at) >> 1u));
    return halves * 2.0f * p.per_unit * beds_at(rg, at);
}

RG_STRUCT(cartoon_puddle)
{
    float level;   // 1: water is just seen
    float slope_x; // of the level, a metre
    float slope_z;
};

// Interpolates between the middles of four columns.
RG_FN cartoon_puddle cartoon_puddle_at(rg_ctx rg, cartoon_water_params p, v3 at)
{
    float u = (at.x - p.low_x) * p.per_column_x - 0.5f;
    float v = (at.z - p.low_z) * p.per_column_z - 0.5f;
    int x = rg_to_int(rg_floor(u));
    int y = rg_to_int(rg_floor(v));
    float s = u - rg_floor(u);
    float t = v - rg_floor(v);
    float a = cartoon_level_of(rg, p, x, y);
    float b = cartoon_level_of(rg, p, x + 1, y);
    float c = cartoon_level_of(rg, p, x, y + 1);
    float d = cartoon_level_of(rg, p, x + 1, y + 1);
    float above = a + (b - a) * s;
    float below = c + (d - c) * s;
    cartoon_puddle w;
    w.level = above + (below - above) * t;
    w.slope_x = ((b - a) + ((d - c) - (b - a)) * t) * p.per_column_x;
    w.slope_z = (below - above) * p.per_column_z;
    return w;
}

RG_FN float cartoon_paint(float film, float ink, float shine, float rim)
{
    float shown = film + (1.0f - film) * shine;
    float inked = shown + (ink - shown) * rim;
    return inked * inked;
}

// The distance of a place inside the water's edge, in pixels, estimated from the level's slope.
RG_FN float cartoon_inside_px(cartoon_water_params p, cartoon_puddle w, v3 at, float slope)
{
    v3 view = v3_make(at.x - p.eye_x, at.y - p.eye_y, at.z - p.eye_z);
    float pixel_m = p.px * rg_sqrt(rg_max(v3_dot(view, view), 1e-12f));
    return (w.level - 1.0f) / (slope * pixel_m);
}

RG_DRAW_FRAGMENT(cartoon_puddles)
{
    rgba n = normal_map_texel(rg, px, py, 0, 0);
    v3 at = cartoon_ground_at(p, depth_map_texel(rg, px, py, 0, 0).r, px, py);
    cartoon_puddle w = cartoon_puddle_at(rg, p, at);
    float slope = rg_max(rg_sqrt(w.slope_x * w.slope_x + w.slope_z * w.slope_z), 1e-6f);
    float inside_px = cartoon_inside_px(p, w, at, slope);
    float rim = rg_clamp(CARTOON_RIM_PX + 0.5f - inside_px, 0.0f, 1.0f);
    float shine = rg_clamp(1.5f - rg_abs(inside_px - CARTOON_SHINE_PX), 0.0f, 1.0f);
    shine = w.slope_x * p.light_x + w.slope_z * p.light_z < -0.5f * slope ? shine : 0.0f;
    float alpha = rg_clamp(inside_px, 0.0f, 1.0f) *
                  rg_max(CARTOON_FILM_COVER, rg_max(CARTOON_RIM_COVER * rim, shine));
    rg_fragment f =
        rg_fragment_make(rg_rgba(cartoon_paint(CARTOON_FILM_R, p.ink_r, shine, rim) * alpha,
                                 cartoon_paint(CARTOON_FILM_G, p.ink_g, shine, rim) * alpha,
                                 cartoon_paint(CARTOON_FILM_B, p.ink_b, shine, rim) * alpha, alpha),
                         0.0f);
    f.kept = n.a > 0.0f && n.g >= CARTOON_UPWARD && alpha > 0.0f ? 1 : 0;
    return f;
}
