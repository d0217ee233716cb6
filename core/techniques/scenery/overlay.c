#include "core/techniques/scenery/overlay.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "core/scene/matrix.h"
#include "kernels/scenery/overlay/lines_params.h"

enum overlay_pass { SHEETS, LINES, INSET, PLATE, PASS_COUNT };

// The items of one stage, on the host and on the device.
struct items {
    const char *name;
    int words; // words of an item
    struct rg_asset *asset;
    float *list;
    int count; // items
    int64_t room;
    bool full; // memory ran out
};

struct scenery_overlay {
    struct rg_instance *instance;
    int first_stage;
    struct items sheets, lines;
    struct rg_asset *map; // the inset's or the plate's map
    scenery_lines_params view;
    scenery_inset_params inset;
    scenery_plate_params plate;
};

#define AT(field) offsetof(struct scenery_overlay, field)

struct scenery_overlay *scenery_overlay_open(struct rg_instance *instance)
{
    static const struct rg_stage stages[PASS_COUNT] = {
        [SHEETS] = {"streaks_sheets", .params = AT(view)},
        [LINES] = {"streaks_lines", .params = AT(view)},
        [INSET] = {"streaks_inset", .params = AT(inset)},
        [PLATE] = {"streaks_plate", .params = AT(plate)},
    };
    struct scenery_overlay *overlay = rg_alloc(1, sizeof(*overlay), "overlay");
    if (!overlay)
        return NULL;
    overlay->instance = instance;
    overlay->sheets = (struct items){.name = "overlay's sheets",
                                     .words = SCENERY_SHEET_WORDS,
                                     .asset = rg_lend_buf(instance, "overlay.sheets", NULL)};
    overlay->lines = (struct items){.name = "overlay's lines",
                                    .words = SCENERY_LINE_WORDS,
                                    .asset = rg_lend_buf(instance, "overlay.lines", NULL)};
    overlay->map = rg_lend_image(instance, "overlay.map", NULL);
    overlay->first_stage = rg_open_stages(instance, stages, PASS_COUNT, overlay, "overlay");
    if (overlay->first_stage >= 0)
        return overlay;
    scenery_overlay_close(overlay);
    return NULL;
}

void scenery_overlay_close(struct scenery_overlay *overlay)
{
    if (!overlay)
        return;
    free(overlay->sheets.list);
    free(overlay->lines.list);
    free(overlay);
}

// --- items ---

void scenery_overlay_begin(struct scenery_overlay *overlay)
{
    overlay->sheets.count = overlay->lines.count = 0;
    overlay->sheets.full = overlay->lines.full = false;
}

// Appends an item and returns its words; NULL when memory runs out, which is logged for the first
// lost item.
static float *add_item(struct items *items)
{
    items->full = items->full || !rg_array_fit(&items->list, &items->room, items->count + 1,
                                               (size_t)items->words * sizeof(float), items->name);
    if (items->full)
        return NULL;
    return items->list + (size_t)items->count++ * (size_t)items->words;
}

static void put_colour(float words[4], const struct scenery_ink *ink, float share)
{
    const float alpha = ink->a * share;
    words[0] = ink->r * alpha;
    words[1] = ink->g * alpha;
    words[2] = ink->b * alpha;
    words[3] = alpha;
}

void scenery_overlay_line(struct scenery_overlay *overlay, const float a[3], const float b[3],
                          const struct scenery_ink *ink)
{
    float *words = add_item(&overlay->lines);
    if (!words)
        return;
    memcpy(words, a, 3 * sizeof(float));
    memcpy(words + 3, b, 3 * sizeof(float));
    put_colour(words + 6, ink, 1);
    words[10] = ink->width_px;
}

void scenery_overlay_box(struct scenery_overlay *overlay, float corners[8][3],
                         const struct scenery_ink *ink)
{
    for (int k = 0; k < 8; k++)
        for (int bit = 1; bit < 8; bit *= 2)
            if (!(k & bit))
                scenery_overlay_line(overlay, corners[k], corners[k | bit], ink);
}

void scenery_overlay_sheet(struct scenery_overlay *overlay, float corners[4][3],
                           const struct scenery_ink *ink, float fill)
{
    for (int k = 0; k < 4; k++)
        scenery_overlay_line(overlay, corners[k], corners[(k + 1) % 4], ink);
    float *words = fill > 0 ? add_item(&overlay->sheets) : NULL;
    if (!words)
        return;
    memcpy(words, corners, 12 * sizeof(float));
    put_colour(words + 12, ink, fill);
}

// --- drawing ---

static bool upload(struct items *items, struct rg_instance *instance)
{
    if (items->full)
        return false;
    return rg_make_room(instance, items->asset, items->room * items->words) &&
           rg_buf_write(items->asset->buf, 0, items->list,
                        (int64_t)items->count * items->words * 4);
}

static bool draw_items(struct scenery_overlay *overlay, struct items *items, enum overlay_pass pass,
                       const struct rg_draw *draw)
{
    if (!items->count && !items->full)
        return true;
    return upload(items, overlay->instance) &&
           rg_stage_onto(overlay->instance, overlay->first_stage + (int)pass, items->count, draw);
}

bool scenery_overlay_draw(struct scenery_overlay *overlay, const float to_clip[16],
                          struct rg_image *colour, struct rg_image *depth)
{
    const struct rg_draw draw = {.colour = colour,
                                 .depth = depth,
                                 .blend = RG_BLEND_OVER,
                                 .depth_mode = depth ? RG_DEPTH_TEST : RG_DEPTH_OFF};
    overlay->view.to_clip = rg_m4_of(to_clip);
    return draw_items(overlay, &overlay->sheets, SHEETS, &draw) &&
           draw_items(overlay, &overlay->lines, LINES, &draw);
}

bool scenery_overlay_inset(struct scenery_overlay *overlay, const scenery_inset_params *inset,
                           struct rg_image *map, struct rg_image *colour)
{
    overlay->inset = *inset;
    overlay->map->image = map;
    return rg_stage_onto(
        overlay->instance, overlay->first_stage + INSET, 1,
        &(struct rg_draw){
            .colour = colour, .x0 = inset->x0, .y0 = inset->y0, .x1 = inset->x1, .y1 = inset->y1});
}

bool scenery_overlay_plate(struct scenery_overlay *overlay, const scenery_plate_params *plate,
                           struct rg_image *map, struct rg_image *colour, struct rg_image *depth)
{
    overlay->plate = *plate;
    overlay->map->image = map;
    return rg_stage_onto(
        overlay->instance, overlay->first_stage + PLATE, 1,
        &(struct rg_draw){.colour = colour, .depth = depth, .depth_mode = RG_DEPTH_TEST});
}
