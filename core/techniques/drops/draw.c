// Draws drops: the lit pane, or one of the simulation's maps.
#include "core/techniques/drops/instance.h"

// Runs a stage that draws onto the target, over `items` items.
static bool draw(struct drops *d, int stage, int items)
{
    const struct rg_draw how = rg_stage_draw(&d->base, stage);
    return !rg_stage_runs(&d->base, stage) || rg_stage_onto(&d->base, stage, items, &how);
}

bool drops_draw(struct rg_instance *instance)
{
    struct drops *d = (struct drops *)instance;
    const struct rg_image_desc *target = &instance->target->desc;
    d->show = drops_view_of(d, target->width, target->height);
    if (d->background)
        d->pane = drops_pane_of(d, &d->show);
    return draw(d, DROPS_RUN_PANE, 1) && draw(d, DROPS_RUN_SHOW, 1) &&
           draw(d, DROPS_RUN_DISCS, d->settings.max_drops);
}
