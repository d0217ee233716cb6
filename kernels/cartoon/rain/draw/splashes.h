// Splashes: point sprites, turned by the angle between the eye's up and the surface's normal on the
// screen (section 5), as large as their drops were.
#include "kernels/cartoon/rain/draw/record.h"
#include "kernels/cartoon/rain/params.h"

#define RG_PARAMS cartoon_rain_params
#define RG_SLOTS                                                                                   \
    IN(1, uint, living)                                                                            \
    IN(2, cartoon_spray, sprays) SAMPLED(3, RGBA8, rain_textures, FILTERED) IN(4, float, boxes)
#define RG_CORNERS 4
#define RG_RECORD  cartoon_sprite
#include "kernels/dialect/draw/draw.h"

#include "kernels/cartoon/rain/draw/sprite.h"

// The texture's top points along the normal. A splash gets the depth of a place half its side
// nearer to the eye, so that the surface it stands on does not cut it.
RG_FN cartoon_sprite cartoon_sprite_of_splash(rg_ctx rg, cartoon_rain_params p, int i)
{
    cartoon_spray d = sprays_at(rg, rg_to_int(living_at(rg, p.drop_slots + i)));
    v3 at = v3_make(d.x, d.y, d.z);
    v3 n = v3_make(d.nx, d.ny, d.nz);
    float side_m = p.splash_m * (p.least + (1.0f - p.least) * d.weight);
    cartoon_sprite s =
        cartoon_sprite_at(p, at, side_m, -v3_dot(n, v3_make(p.right_x, p.right_y, p.right_z)),
                          -v3_dot(n, v3_make(p.up_x, p.up_y, p.up_z)));
    float distance_m = cartoon_spot_of(p, at).distance_m;
    float near_m = rg_max(distance_m - 0.5f * side_m, 0.5f * distance_m);
    s.depth = p.depth_at + p.depth_by / rg_max(near_m, 1e-6f);
    s.seen = s.seen & (d.state != CARTOON_DEATH ? 1 : 0);
    s.alpha = d.alpha;
    s.layer = CARTOON_SPLASH_LAYER(d.pattern, d.texture);
    return s;
}

RG_DRAW_ITEM(cartoon_splashes)
{
    return cartoon_sprite_item(rg, p, cartoon_sprite_of_splash(rg, p, i));
}

RG_DRAW_RECORD(cartoon_splashes)
{
    return cartoon_sprite_of_splash(rg, p, i);
}

RG_DRAW_FRAGMENT(cartoon_splashes)
{
    return cartoon_sprite_fragment(rg, r, px, py);
}
