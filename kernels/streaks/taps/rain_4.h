// streaks: particles, with 4 streak textures for each light.
#define STREAKS_TAPS 4
#include "kernels/streaks/taps/light.h"
#include "kernels/streaks/taps/unseen.h"

RG_DRAW_ITEM(streaks_rain_4)
{
    streaks_particle t = streaks_particle_at(rg, p, i);
    rg_item item = streaks_item_of(p, streaks_shape_of(rg, p, t));
    item.alive = t.state != STREAKS_NOTHING ? 1 : 0;
    return item;
}

RG_DRAW_GROUP(streaks_rain_4)
{
    return streaks_block_ahead(rg, p, number);
}

RG_DRAW_UNSEEN(streaks_rain_4)
{
    return streaks_unseen(rg, p, streaks_particle_of(rg, p, group, i & (STREAKS_BLOCK - 1)));
}

RG_DRAW_RECORD(streaks_rain_4)
{
    return streaks_billboard_of(rg, draw, p, i);
}

RG_DRAW_PLAIN(streaks_rain_4)
{
    return 1 - streaks_is(r, STREAKS_LOOK_SPLASH);
}

RG_DRAW_RECORD_LIGHT(streaks_rain_4)
{
    return streaks_lighting_of(rg, p, r, light);
}

RG_DRAW_LIGHT(streaks_rain_4)
{
    return streaks_lit_by(rg, p, r, px, py, light, by);
}

RG_DRAW_FRAGMENT(streaks_rain_4)
{
    return streaks_fragment_of(rg, p, r, px, py, lit);
}
