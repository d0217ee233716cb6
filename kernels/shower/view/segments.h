// shower: drops as line segments (section III.A), one pixel wide: a pixel in each row, or in each
// column if the line is flatter, as OpenGL draws lines without smoothing.
#include "kernels/shower/view/params.h"
#include "kernels/shower/particle.h"

#define RG_PARAMS  shower_view_params
#define RG_SLOTS   IN(1, float, particles)
#define RG_CORNERS 4

RG_STRUCT(shower_segment)
{
    float depth;
    float alpha;
};
#define RG_RECORD shower_segment
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

#include "kernels/shower/view/look.h"

RG_DRAW_ITEM(shower_segments)
{
    shower_drop d = shower_drop_at(rg, p, i);
    float is_steep = rg_abs(d.high_x - d.low_x) <= rg_abs(d.high_y - d.low_y) ? 1.0f : 0.0f;
    return shower_item(p, d, 0.5f * is_steep, 0.5f - 0.5f * is_steep);
}

RG_DRAW_RECORD(shower_segments)
{
    shower_drop d = shower_drop_at(rg, p, i);
    shower_segment r;
    r.depth = d.depth;
    r.alpha = shower_opacity(p, d) * p.mean;
    return r;
}

RG_DRAW_FRAGMENT(shower_segments)
{
    return rg_fragment_make(rg_rgba(p.r * r.alpha, p.g * r.alpha, p.b * r.alpha, r.alpha), r.depth);
}
