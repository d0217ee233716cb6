// Cool to warm shading (Gooch et al., 1998): what turns away from the light is cool, what faces it
// warm, each with a share of the material's own colour, and a highlight.
#include "kernels/cartoon/scene/shade_params.h"

#define RG_PARAMS cartoon_shade_params
#define RG_SLOTS  IMAGE(1, D32F, depth_map) IMAGE(2, RGBA16F, normal_map) IN(3, float, palette)
#include "kernels/dialect/draw/view_quad.h"

#include "kernels/cartoon/scene/seen.h"

RG_DRAW_ITEM(cartoon_gooch)
{
    return view_quad();
}

RG_DRAW_RECORD(cartoon_gooch)
{
    return view_quad_record();
}

RG_FN v3 cartoon_cool_to_warm(cartoon_shade_params p, cartoon_seen s)
{
    float t = 0.5f + 0.5f * s.facing;
    float mine = p.alpha + (p.beta - p.alpha) * t; // the material's share
    float yellow = p.yellow * t + cartoon_shine(s);
    return v3_make(yellow + mine * s.colour.x, yellow + mine * s.colour.y,
                   p.blue * (1.0f - t) + cartoon_shine(s) + mine * s.colour.z);
}

RG_DRAW_FRAGMENT(cartoon_gooch)
{
    cartoon_seen s = cartoon_seen_at(rg, p, px, py);
    v3 sky = cartoon_sky(p, py);
    v3 c = cartoon_cool_to_warm(p, s);
    bool nothing = s.nothing != 0;
    return cartoon_shown(
        v3_make(nothing ? sky.x : c.x, nothing ? sky.y : c.y, nothing ? sky.z : c.z));
}
