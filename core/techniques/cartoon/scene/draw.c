// Draws a frame's scene: its normal map and depth, then its picture.
#include <string.h>

#include "core/techniques/cartoon/instance.h"

static int opened(const struct cartoon *c, enum cartoon_stage stage)
{
    return c->first_stage + (int)stage;
}

// Draws the first `items` faces or edges of a stage; there may be none.
static bool draw_some(struct cartoon *c, enum cartoon_stage stage, int items)
{
    const struct rg_draw draw = rg_stage_draw(&c->base, opened(c, stage));
    return !items || rg_stage_onto(&c->base, opened(c, stage), items, &draw);
}

static bool draw_faces(struct cartoon *c)
{
    static const uint16_t nothing[4] = {0};
    const float farthest = 1;
    const int solid = c->diorama->solid_faces, all = c->diorama->mesh->face_count;
    return rg_image_clear(c->normal_map->image, nothing) &&
           rg_image_clear(c->depth_map->image, &farthest) &&
           draw_some(c, CARTOON_RUN_SOLIDS, solid) && draw_some(c, CARTOON_RUN_THIN, all - solid);
}

// Draws face numbers in the same way as the maps, so that the same face is nearest.
static bool draw_numbers(struct cartoon *c)
{
    static const uint32_t nothing = 0;
    const float farthest = 1;
    const int solid = c->diorama->solid_faces, all = c->diorama->mesh->face_count;
    return !rg_stage_runs(&c->base, opened(c, CARTOON_RUN_SOLID_NUMBERS)) ||
           (rg_image_clear(c->face_map->image, &nothing) &&
            rg_image_clear(c->number_depth->image, &farthest) &&
            draw_some(c, CARTOON_RUN_SOLID_NUMBERS, solid) &&
            draw_some(c, CARTOON_RUN_THIN_NUMBERS, all - solid));
}

static bool draw_outlines(struct cartoon *c)
{
    const float none = 1;
    return !rg_stage_runs(&c->base, opened(c, CARTOON_RUN_INK)) ||
           (rg_image_clear(c->ink->image, &none) && draw_some(c, CARTOON_RUN_INK, c->edge_count));
}

// Whether the maps hold the current view: they were drawn in this frame, or in one with the same
// view.
static bool is_found(const struct cartoon *c)
{
    const bool is_same = !memcmp(&c->found_by, &c->view.to_clip, sizeof(c->found_by));
    return c->found_in && is_same &&
           (c->settings.redraw == CARTOON_MOVED || c->found_in == c->base.frame + 1);
}

bool cartoon_scene_find(struct cartoon *c)
{
    if (is_found(c))
        return true;
    c->found_in = c->base.frame + 1;
    c->found_by = c->view.to_clip;
    c->has_picture = false;
    return draw_faces(c) && draw_numbers(c) && draw_outlines(c);
}

static bool draw_in_style(struct cartoon *c)
{
    bool ok = true;
    for (int style = CARTOON_RUN_GOOCH; ok && style <= CARTOON_RUN_HATCHING; style++)
        ok = rg_stage(&c->base, opened(c, (enum cartoon_stage)style));
    return ok;
}

bool cartoon_scene_draw(struct cartoon *c)
{
    if (!cartoon_scene_find(c) || !(c->has_picture || draw_in_style(c)))
        return false;
    c->has_picture = c->settings.redraw == CARTOON_MOVED;
    return true;
}
