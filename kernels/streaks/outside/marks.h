// streaks from outside: each drop as a line along its fall, each splash as a shorter one on the
// surface it hits. Colours show the height: from blue at the rain space's top, by green, to red on
// its ground (Creus, figure 4.1).
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

// With limits=off the local space repeats beyond the rain space's top, where nothing is shown. A
// drop's mark reaches up from the drop by p.fall, a splash's from the surface by half of that.
RG_FN streaks_mark streaks_mark_of(rg_ctx rg, rg_draw_state draw, streaks_params p, int i)
{
    streaks_particle t = streaks_particle_at(rg, p, i);
    int splash = t.state == STREAKS_SPLASH ? 1 : 0;
    float s = splash != 0 ? t.hit : t.s;
    float up = splash != 0 ? 0.5f * p.fall : p.fall;
    streaks_mark mark;
    mark.line = rg_line_seen(draw, m4_project(p.to_clip, v3_make(t.x, t.y, s)),
                             m4_project(p.to_clip, v3_make(t.x, t.y, s - up)), p.thinnest_px);
    mark.fallen = rg_clamp((s - p.map_top) / p.map_height, 0.0f, 1.0f);
    mark.seen = (t.state == STREAKS_NOTHING ? 0 : 1) * (1 - streaks_below(s, p.map_top));
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
