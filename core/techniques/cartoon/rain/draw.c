// Draws the rain: splashes, then the drops in front of them.
#include "core/techniques/cartoon/rain/rain.h"

static bool draw(struct cartoon_rain *r, enum cartoon_rain_stage stage, int items)
{
    if (items <= 0)
        return true;
    const int opened = r->first_stage + (int)stage;
    const struct rg_draw how = rg_stage_draw(r->instance, opened);
    return rg_stage_onto(r->instance, opened, items, &how);
}

// The splashes to draw: each hit of the last step has made one, as far as slots were free.
static bool count_sprays(struct cartoon_rain *r, int *sprays)
{
    uint32_t hits = 0;
    if (r->drops && !rg_buf_read(r->hits_before->buf, r->drops * 4, &hits, 4))
        return false;
    const int room = r->params.free_sprays;
    *sprays = r->sprays_before + ((int)hits < room ? (int)hits : room);
    return true;
}

bool cartoon_rain_draw(struct cartoon_rain *r)
{
    int sprays;
    return count_sprays(r, &sprays) && draw(r, CARTOON_RAIN_SPLASHES, sprays) &&
           draw(r, CARTOON_RAIN_DROPS, r->drops);
}
