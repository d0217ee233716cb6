// Cartoon shading (Lake et al., 2000): the material's colour in three tones, shadow, middle and
// lit, and a highlight with an edge of its own.
#include "kernels/cartoon/scene/shade_params.h"

#define RG_PARAMS cartoon_shade_params
#define RG_SLOTS                                                                                   \
    IMAGE(1, D32F, depth_map)                                                                      \
    IMAGE(2, RGBA16F, normal_map) IN(3, uint, palette) IMAGE(4, D32F, ink)
#include "kernels/dialect/draw/view_quad.h"

#include "kernels/cartoon/scene/seen.h"

RG_DRAW_ITEM(cartoon_tones)
{
    return view_quad();
}

RG_DRAW_RECORD(cartoon_tones)
{
    return view_quad_record();
}

// Rises from 0 to 1 about `edge`.
RG_FN float cartoon_step(cartoon_shade_params p, float value, float edge)
{
    return rg_clamp((value - edge) * p.per_softness + 0.5f, 0.0f, 1.0f);
}

RG_FN v3 cartoon_toned(cartoon_shade_params p, cartoon_seen s, float shine)
{
    float u = rg_max(s.facing, 0.0f);
    float lower = cartoon_mix(p.shadow_tone, p.middle_tone, cartoon_step(p, u, p.middle_from));
    float tone = cartoon_mix(lower, 1.0f, cartoon_step(p, u, p.lit_from));
    float glint = s.shine * cartoon_step(p, shine, p.glint_from);
    // Shadows are a little blue.
    float cool = p.shadow_blue * (1.0f - tone);
    return v3_make(cartoon_mix(s.colour.x * tone, 1.0f, glint),
                   cartoon_mix(s.colour.y * tone, 1.0f, glint),
                   cartoon_mix(s.colour.z * tone + cool, 1.0f, glint));
}

RG_DRAW_FRAGMENT(cartoon_tones)
{
    cartoon_seen s = cartoon_seen_at(rg, p, px, py);
    float shine = cartoon_shine(p, s, depth_map_texel(rg, px, py, 0, 0).r, px, py);
    v3 c = cartoon_or(s.nothing, cartoon_sky(p, py), cartoon_toned(p, s, shine));
    return cartoon_inked(rg, p, c, px, py);
}
