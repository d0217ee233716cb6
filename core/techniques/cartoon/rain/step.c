// A step of the rain: drops are released, fall, hit and splash; splashes age.
#include "core/techniques/cartoon/rain/rain.h"

static bool run(struct cartoon_rain *r, enum cartoon_rain_stage stage, int items)
{
    if (items <= 0)
        return true;
    return rg_stage_over(r->instance, r->first_stage + (int)stage, (struct rg_extent){0, 0, 0},
                         (struct rg_extent){items, 1, 1});
}

// Slots of the dead go to the free lists, and what is created takes them from there.
static bool make_lists(struct cartoon_rain *r)
{
    const int slots = r->params.drop_slots + r->params.spray_slots;
    return run(r, CARTOON_RAIN_FREE, slots) &&
           rg_scan_sum(r->scan, r->flags->buf, r->before->buf, slots) &&
           run(r, CARTOON_RAIN_LIST, slots) && run(r, CARTOON_RAIN_RELEASE, r->params.released);
}

// Counts of visible samples, by whichever stages are open.
static bool query(struct cartoon_rain *r)
{
    const int drops = r->params.drop_slots, spheres = r->first_stage + CARTOON_RAIN_SPHERES;
    const struct rg_draw how = rg_stage_draw(r->instance, spheres);
    return run(r, CARTOON_RAIN_COUNT, drops) &&
           (!rg_stage_runs(r->instance, spheres) ||
            rg_stage_onto(r->instance, spheres, drops * r->params.facets, &how)) &&
           run(r, CARTOON_RAIN_SUM, drops);
}

static bool collide(struct cartoon_rain *r)
{
    const int drops = r->params.drop_slots;
    return query(r) && run(r, CARTOON_RAIN_COLLIDE, drops) &&
           rg_scan_sum(r->scan, r->hits->buf, r->hits_before->buf, drops) &&
           run(r, CARTOON_RAIN_SPLASH, drops);
}

bool cartoon_rain_step(struct cartoon_rain *r)
{
    cartoon_rain_refill(r);
    r->instance->counters[CARTOON_DROPS_ASKED].value += r->params.drop_slots;
    return make_lists(r) && run(r, CARTOON_RAIN_MOVE, r->params.drop_slots) &&
           run(r, CARTOON_RAIN_AGE, r->params.spray_slots) && collide(r);
}
