// Draws the rain: splashes, then drops before them.
#include "core/techniques/cartoon/rain/rain.h"

static bool draw(struct cartoon_rain *r, enum cartoon_rain_stage stage, int items)
{
    const int opened = r->first_stage + (int)stage;
    const struct rg_draw how = rg_stage_draw(r->instance, opened);
    return rg_stage_onto(r->instance, opened, items, &how);
}

bool cartoon_rain_draw(struct cartoon_rain *r)
{
    return draw(r, CARTOON_RAIN_SPLASHES, r->params.spray_slots) &&
           draw(r, CARTOON_RAIN_DROPS, r->params.drop_slots);
}
