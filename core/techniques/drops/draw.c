// Draws drops: the pane, as large as the picture has room for.
#include "core/techniques/drops/instance.h"

bool drops_draw(struct rg_instance *instance)
{
    struct drops *d = (struct drops *)instance;
    const struct rg_image_desc *target = &instance->target->desc;
    const struct drops_settings *s = &d->settings;
    const float across = (float)s->columns / (float)target->width;
    const float down = (float)s->rows / (float)target->height;
    const float cells = across > down ? across : down;
    d->show = (drops_show_params){
        .columns = s->columns,
        .rows = s->rows,
        .stride = d->params.stride,
        .is_of_ids = s->view == DROPS_VIEW_IDS,
        .cells_per_px = cells,
        .first_column = ((float)s->columns - cells * (float)target->width) / 2,
        .first_row = ((float)s->rows - cells * (float)target->height) / 2,
        .white_mm = 3,
    };
    const struct rg_draw draw = rg_stage_draw(instance, DROPS_RUN_SHOW);
    return rg_stage_onto(instance, DROPS_RUN_SHOW, 1, &draw);
}
