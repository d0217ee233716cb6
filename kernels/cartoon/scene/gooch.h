// Cool to warm shading (Gooch et al., 1998): surfaces that face the light are warm, those that turn
// away cool. Each keeps a share of the material's own colour; a highlight is added.
#include "kernels/cartoon/scene/shade_params.h"

#define RG_PARAMS cartoon_shade_params
#define RG_SLOTS                                                                                   \
    IMAGE(1, D32F, depth_map)                                                                      \
    IMAGE(2, RGBA16F, normal_map) IN(3, uint, palette) IMAGE(4, D32F, ink)
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

RG_FN v3 cartoon_cool_to_warm(cartoon_shade_params p, cartoon_seen s, float shine)
{
    float t = 0.5f + 0.5f * s.facing;
    float mine = cartoon_mix(p.alpha, p.beta, t); // the material's share
    float yellow = p.yellow * t + shine;
    return v3_make(yellow + mine * s.colour.x, yellow + mine * s.colour.y,
                   p.blue * (1.0f - t) + shine + mine * s.colour.z);
}

RG_DRAW_FRAGMENT(cartoon_gooch)
{
    cartoon_seen s = cartoon_seen_at(rg, p, px, py);
    float shine = cartoon_shine(p, s, depth_map_texel(rg, px, py, 0, 0).r, px, py);
    v3 c = cartoon_or(s.nothing, cartoon_sky(p, py), cartoon_cool_to_warm(p, s, shine));
    return cartoon_inked(rg, p, c, px, py);
}
