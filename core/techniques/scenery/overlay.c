#include "core/techniques/scenery/overlay.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "kernels/scenery/overlay/lines_params.h"

// Items of one program, on the host and on the device.
struct items {
    const char *kernel, *name;
    int words; // an item
    struct rg_pass *pass;
    struct rg_buf *buf;
    float *list;
    int count, room, buf_room; // items
    bool full;                 // there was no memory
};

struct scenery_overlay {
    struct rg_device *device;
    struct items sheets, lines;
    struct rg_pass *inset;
};

struct scenery_overlay *scenery_overlay_open(struct rg_device *device)
{
    struct scenery_overlay *overlay = rg_alloc(1, sizeof(*overlay), "overlay");
    if (!overlay)
        return NULL;
    overlay->device = device;
    overlay->sheets = (struct items){
        .kernel = "streaks_sheets", .name = "overlay's sheets", .words = SCENERY_SHEET_WORDS};
    overlay->lines = (struct items){
        .kernel = "streaks_lines", .name = "overlay's lines", .words = SCENERY_LINE_WORDS};
    if (!(overlay->sheets.pass = rg_pass_create(device, overlay->sheets.kernel)) ||
        !(overlay->lines.pass = rg_pass_create(device, overlay->lines.kernel)) ||
        !(overlay->inset = rg_pass_create(device, "streaks_inset"))) {
        scenery_overlay_close(overlay);
        return NULL;
    }
    return overlay;
}

static void free_items(struct items *items)
{
    rg_pass_destroy(items->pass);
    rg_buf_destroy(items->buf);
    free(items->list);
}

void scenery_overlay_close(struct scenery_overlay *overlay)
{
    if (!overlay)
        return;
    free_items(&overlay->sheets);
    free_items(&overlay->lines);
    rg_pass_destroy(overlay->inset);
    free(overlay);
}

// --- items ---

void scenery_overlay_begin(struct scenery_overlay *overlay)
{
    overlay->sheets.count = overlay->lines.count = 0;
    overlay->sheets.full = overlay->lines.full = false;
}

// The words of a new item; NULL where there is no memory.
static float *add_item(struct items *items)
{
    if (items->count == items->room) {
        const int room = items->room ? 2 * items->room : 64;
        float *list = realloc(items->list, (size_t)room * (size_t)items->words * sizeof(float));
        if (!list) {
            items->full = true;
            return NULL;
        }
        items->list = list;
        items->room = room;
    }
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

static bool upload(struct items *items, struct rg_device *device)
{
    const int64_t item_bytes = (int64_t)items->words * 4;
    if (items->full)
        return rg_error("%s: no memory for more than %d; show less", items->name, items->room);
    if (items->buf_room < items->count) {
        rg_buf_destroy(items->buf);
        items->buf_room = items->room;
        items->buf = rg_buf_create(device, items->room * item_bytes, items->name);
    }
    return items->buf && rg_buf_write(items->buf, 0, items->list, items->count * item_bytes);
}

static bool draw_items(struct items *items, struct rg_instance *instance,
                       const scenery_lines_params *params, const struct rg_draw *draw)
{
    if (!items->count && !items->full)
        return true;
    if (!upload(items, items->pass->device)) {
        items->buf_room = items->buf ? items->buf_room : 0;
        return false;
    }
    return rg_instance_run(instance, items->pass,
                           &(struct rg_run){.params = params,
                                            .slots = {[1].buf = items->buf},
                                            .extent = {items->count, 1, 1},
                                            .draw = draw});
}

bool scenery_overlay_draw(struct scenery_overlay *overlay, struct rg_instance *instance,
                          const float to_clip[16], struct rg_image *colour, struct rg_image *depth)
{
    const struct rg_draw draw = {.colour = colour,
                                 .depth = depth,
                                 .blend = RG_BLEND_OVER,
                                 .depth_mode = depth ? RG_DEPTH_TEST : RG_DEPTH_OFF};
    scenery_lines_params params;
    memcpy(&params.to_clip, to_clip, sizeof(params.to_clip));
    return draw_items(&overlay->sheets, instance, &params, &draw) &&
           draw_items(&overlay->lines, instance, &params, &draw);
}

bool scenery_overlay_inset(struct scenery_overlay *overlay, struct rg_instance *instance,
                           const scenery_inset_params *inset, struct rg_image *map,
                           struct rg_image *colour)
{
    const struct rg_draw draw = {
        .colour = colour, .x0 = inset->x0, .y0 = inset->y0, .x1 = inset->x1, .y1 = inset->y1};
    return rg_instance_run(
        instance, overlay->inset,
        &(struct rg_run){
            .params = inset, .slots = {[1].image = map}, .extent = {1, 1, 1}, .draw = &draw});
}
