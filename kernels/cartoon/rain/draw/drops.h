// Drops: a drop's size selects the texture, whose v runs along the drop's velocity (figure 3).
#include "kernels/cartoon/rain/draw/record.h"
#include "kernels/cartoon/rain/params.h"

#define RG_PARAMS cartoon_rain_params
#define RG_SLOTS                                                                                   \
    IN(1, uint, living)                                                                            \
    IN(2, cartoon_raindrop, raindrops)                                                             \
    SAMPLED(3, RGBA8, rain_textures, FILTERED) IN(4, float, boxes)
#define RG_CORNERS 4
#define RG_RECORD  cartoon_sprite
#include "kernels/dialect/draw/draw.h"

#include "kernels/cartoon/rain/draw/sprite.h"

RG_FN cartoon_sprite cartoon_sprite_of_drop(rg_ctx rg, cartoon_rain_params p, int i)
{
    cartoon_raindrop d = raindrops_at(rg, rg_to_int(living_at(rg, i)));
    v3 v = v3_make(d.vx, d.vy, d.vz);
    float side_m = p.drop_m * (p.least + (1.0f - p.least) * d.size);
    cartoon_sprite s = cartoon_sprite_at(p, v3_make(d.x, d.y, d.z), side_m,
                                         v3_dot(v, v3_make(p.right_x, p.right_y, p.right_z)),
                                         v3_dot(v, v3_make(p.up_x, p.up_y, p.up_z)));
    s.seen = s.seen & (d.state != CARTOON_DEATH ? 1 : 0);
    s.alpha = d.alpha;
    s.layer =
        rg_imin(rg_to_int(d.size * rg_to_float(CARTOON_DROP_TEXTURES)), CARTOON_DROP_TEXTURES - 1);
    return s;
}

RG_DRAW_ITEM(cartoon_drops)
{
    return cartoon_sprite_item(rg, p, cartoon_sprite_of_drop(rg, p, i));
}

RG_DRAW_RECORD(cartoon_drops)
{
    return cartoon_sprite_of_drop(rg, p, i);
}

RG_DRAW_FRAGMENT(cartoon_drops)
{
    return cartoon_sprite_fragment(rg, r, px, py);
}
