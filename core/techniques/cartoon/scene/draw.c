// The scene of a frame: its normal map and depth, then its picture.
#include "core/techniques/cartoon/instance.h"

static bool draw_faces(struct cartoon *c)
{
    static const uint16_t nothing[4] = {0};
    const float farthest = 1;
    const struct rg_draw draw = rg_stage_draw(&c->base, CARTOON_RUN_FACES);
    return rg_image_clear(c->normal_map->image, nothing) &&
           rg_image_clear(c->depth_map->image, &farthest) &&
           rg_stage_onto(&c->base, CARTOON_RUN_FACES, c->diorama->mesh->face_count, &draw);
}

static bool draw_outlines(struct cartoon *c)
{
    const float none = 1;
    const struct rg_draw draw = rg_stage_draw(&c->base, CARTOON_RUN_INK);
    return !rg_stage_runs(&c->base, CARTOON_RUN_INK) ||
           (rg_image_clear(c->ink->image, &none) &&
            rg_stage_onto(&c->base, CARTOON_RUN_INK, c->edge_count, &draw));
}

bool cartoon_scene_draw(struct cartoon *c)
{
    bool ok = draw_faces(c) && draw_outlines(c);
    for (int style = CARTOON_RUN_GOOCH; ok && style <= CARTOON_RUN_HATCHING; style++)
        ok = rg_stage(&c->base, style);
    return ok;
}
