// A step of the rain: drops are released, fall, hit and splash; splashes age.
//
// Late answers belong to the queries at the end of the step before. With them, hits are found
// first, on the paths of that step; a drop that has hit sticks in this step.
#include "core/techniques/cartoon/rain/rain.h"

static bool run(struct cartoon_rain *r, enum cartoon_rain_stage stage, int items)
{
    if (items <= 0)
        return true;
    return rg_stage_over(r->instance, r->first_stage + (int)stage, (struct rg_extent){0, 0, 0},
                         (struct rg_extent){items, 1, 1});
}

// Returns the slots of dead particles to the free lists, from which new ones take theirs. The host
// reads the lengths of the lists, so that stages cover only the living.
static bool make_lists(struct cartoon_rain *r)
{
    cartoon_rain_params *p = &r->params;
    const int drops = p->drop_slots, slots = drops + p->spray_slots;
    uint32_t free_drops, all_free;
    if (!run(r, CARTOON_RAIN_FREE, slots) ||
        !rg_scan_sum(r->scan, r->flags->buf, r->before->buf, slots) ||
        !rg_buf_read(r->before->buf, drops * 4, &free_drops, 4) ||
        !rg_buf_read(r->before->buf, slots * 4, &all_free, 4))
        return false;
    p->free_drops = (int)free_drops;
    p->free_sprays = (int)(all_free - free_drops);
    const int created = p->released < p->free_drops ? p->released : p->free_drops;
    r->drops = drops - p->free_drops + created;
    r->sprays_before = p->spray_slots - p->free_sprays;
    return run(r, CARTOON_RAIN_LIST, slots) && run(r, CARTOON_RAIN_RELEASE, p->released);
}

// Counts visible samples, with whichever query stages are open.
static bool query(struct cartoon_rain *r)
{
    const int spheres = r->first_stage + CARTOON_RAIN_SPHERES;
    const struct rg_draw how = rg_stage_draw(r->instance, spheres);
    r->instance->counters[CARTOON_DROPS_ASKED].value += r->drops;
    return run(r, CARTOON_RAIN_COUNT, r->drops) &&
           (!rg_stage_runs(r->instance, spheres) || !r->drops ||
            rg_stage_onto(r->instance, spheres, r->drops * r->params.facets, &how)) &&
           run(r, CARTOON_RAIN_SUM, r->drops);
}

static bool collide(struct cartoon_rain *r)
{
    return run(r, CARTOON_RAIN_COLLIDE, r->drops) &&
           rg_scan_sum(r->scan, r->hits->buf, r->hits_before->buf, r->drops) &&
           run(r, CARTOON_RAIN_SPLASH, r->drops);
}

bool cartoon_rain_step(struct cartoon_rain *r)
{
    // Keeps answers only while the queries' list and view still hold.
    if (!run(r, CARTOON_RAIN_KEEP, r->drops))
        return false;
    cartoon_rain_refill(r);
    return make_lists(r) && (!r->params.late || collide(r)) &&
           run(r, CARTOON_RAIN_MOVE, r->drops) && run(r, CARTOON_RAIN_AGE, r->sprays_before) &&
           query(r) && (r->params.late || collide(r));
}
