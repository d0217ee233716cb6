// streaks from outside: each drop as a line along its fall, each splash as a shorter one on the
// surface it hits. Colours show the height: from blue at the rain space's top, by green, to red on
// its ground (Creus, figure 4.1). Where p.narrowing is not 0, the rain space is a frustum (figure
// 4.3): each particle advances p.map_height along its ray, a line through the camera above.
#include "kernels/streaks/params.h"
#include "kernels/dialect/draw/line.h"

#define RG_PARAMS streaks_params
#define RG_SLOTS                                                                                   \
    IN(1, float, particles)                                                                        \
    IN(2, uint, blocks)                                                                            \
    IMAGE(3, D32F, depths)
#define RG_CORNERS 4

RG_STRUCT(streaks_mark)
{
    rg_line line;
    float fallen; // 0 at the rain space's top, 1 on its ground
    int seen;
};
#define RG_RECORD streaks_mark
#include "kernels/dialect/draw/draw.h"

#include "kernels/streaks/particle.h"

// A line of p.thinnest_px pixels; its smooth sides end half a pixel further.
RG_FN float streaks_mark_reach(streaks_params p)
{
    return 0.5f * p.thinnest_px + 0.5f;
}

// The way along a particle's ray for each metre down: 1 over the cosine of its angle.
RG_FN float streaks_ray_slope(streaks_params p, streaks_particle t)
{
    float x = t.x * p.narrowing;
    float y = t.y * p.narrowing;
    return rg_sqrt(1.0f + x * x + y * y);
}

// The place so far from the top along a particle's ray, which has the particle's x and y on the
// ground.
RG_FN v3 streaks_ray_place(streaks_params p, streaks_particle t, float slope, float way)
{
    float s = way / slope;
    float wide = 1.0f - p.narrowing * (p.map_height - s);
    return v3_make(t.x * wide, t.y * wide, s);
}

// A particle whose s and hit are ways along its ray. In a frustum, the map's depth is by
// perspective, and the state follows from the ways; limits=off leaves out no particle but those of
// its block.
RG_FN streaks_particle streaks_ray_particle(rg_ctx rg, streaks_params p, int i)
{
    streaks_block b = streaks_block_at(rg, p, i >> 5);
    streaks_particle t = streaks_particle_of(rg, p, b, i & 31);
    int counted = rg_to_int((b.counted >> rg_to_uint(i & 31)) & 1u);
    int in_box = t.state;
    float narrow = 1.0f - p.narrowing * p.map_height;
    float there = 1.0f - p.narrowing * t.hit;
    t.hit = t.hit * narrow / there * streaks_ray_slope(p, t);
    t = streaks_state(p, t);
    t.state = p.narrowing > 0.0f ? t.state * counted : in_box;
    return t;
}

// With limits=off the local space repeats beyond the rain space's top, and a drop's lower end may
// be below the ground: nothing is shown there. A drop's mark reaches up from the drop by p.fall, a
// splash's from the surface by half of that.
RG_FN streaks_mark streaks_mark_of(rg_ctx rg, rg_draw_state draw, streaks_params p, int i)
{
    streaks_particle t = streaks_ray_particle(rg, p, i);
    int splash = t.state == STREAKS_SPLASH ? 1 : 0;
    float way = splash != 0 ? t.hit : t.s;
    float up = splash != 0 ? 0.5f * p.fall : p.fall;
    float slope = streaks_ray_slope(p, t);
    v3 low = streaks_ray_place(p, t, slope, way);
    v3 high = streaks_ray_place(p, t, slope, way - up);
    int beyond = streaks_below(way, p.map_top) | streaks_below(p.map_top + p.map_height, way);
    streaks_mark mark;
    mark.line =
        rg_line_seen(draw, m4_project(p.to_clip, low), m4_project(p.to_clip, high), p.thinnest_px);
    mark.fallen = rg_clamp((low.z - p.map_top) / p.map_height, 0.0f, 1.0f);
    mark.seen = (t.state == STREAKS_NOTHING ? 0 : 1) * (1 - beyond);
    return mark;
}

RG_DRAW_ITEM(streaks_marks)
{
    streaks_mark mark = streaks_mark_of(rg, draw, p, i);
    rg_item t = rg_line_item(draw, mark.line, streaks_mark_reach(p));
    t.alive = t.alive * mark.seen;
    return t;
}

RG_DRAW_RECORD(streaks_marks)
{
    return streaks_mark_of(rg, draw, p, i);
}

RG_DRAW_FRAGMENT(streaks_marks)
{
    float covered = rg_line_covered(r.line, px, py, streaks_mark_reach(p));
    float green = 1.0f - rg_abs(2.0f * r.fallen - 1.0f);
    return rg_fragment_make(
        rg_rgba(r.fallen * covered, green * covered, (1.0f - r.fallen) * covered, covered),
        rg_line_depth(r.line, px, py));
}
