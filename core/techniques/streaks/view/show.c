// What the thesis's figures show beside the rain: the spaces in which it is simulated, packets,
// lights, and the depth map (figures 4.4, 4.5, 4.11, 4.14 and 5.7).
#include <math.h>

#include "core/techniques/scenery/overlay.h"
#include "core/techniques/streaks/instance.h"

// The inks of the thesis's figures 4.4, 4.11, 4.14 and 5.7.
static const struct scenery_ink grey = {0.45f, 0.45f, 0.45f, 1, 1.5f};
static const struct scenery_ink green = {0.05f, 0.75f, 0.10f, 1, 1.5f};
static const struct scenery_ink red = {0.95f, 0.05f, 0.03f, 1, 2};
static const struct scenery_ink blue = {0.05f, 0.15f, 1, 1, 2};
static const struct scenery_ink purple = {0.55f, 0.08f, 0.80f, 1, 1.5f};
static const struct scenery_ink white = {1, 1, 1, 0.9f, 1.5f};

// A box of the rain frame.
struct box {
    double low[3], high[3];
};

static void to_world(const struct streaks *s, double x, double y, double along, float world[3])
{
    const double rain[3] = {x, y, along};
    double point[3];
    rg_rain_world_point(&s->space, rain, point);
    for (int i = 0; i < 3; i++)
        world[i] = (float)point[i];
}

static void show_box(const struct streaks *s, const struct box *box, const struct scenery_ink *ink)
{
    float corners[8][3];
    for (int k = 0; k < 8; k++)
        to_world(s, (k & 1 ? box->high : box->low)[0], (k & 2 ? box->high : box->low)[1],
                 (k & 4 ? box->high : box->low)[2], corners[k]);
    scenery_overlay_box(s->overlay, corners, ink);
}

// A rectangle across the fall.
static void show_sheet(const struct streaks *s, const double low[2], const double high[2],
                       double along, const struct scenery_ink *ink, float fill)
{
    float corners[4][3];
    to_world(s, low[0], low[1], along, corners[0]);
    to_world(s, high[0], low[1], along, corners[1]);
    to_world(s, high[0], high[1], along, corners[2]);
    to_world(s, low[0], high[1], along, corners[3]);
    scenery_overlay_sheet(s->overlay, corners, ink, fill);
}

static struct box meet(const struct box *a, const struct box *b)
{
    struct box both;
    for (int i = 0; i < 3; i++) {
        both.low[i] = fmax(a->low[i], b->low[i]);
        both.high[i] = fmax(both.low[i], fmin(a->high[i], b->high[i]));
    }
    return both;
}

static void show_spaces(const struct streaks *s)
{
    const streaks_params *p = &s->params;
    const double x = (double)p->eye_x, y = (double)p->eye_y, radius = (double)p->radius;
    const double top = (double)p->top, ground = top + (double)p->local_height;
    const struct box space = {{-s->space.half_x_m, -s->space.half_y_m, 0},
                              {s->space.half_x_m, s->space.half_y_m, s->space.height_m}};
    const struct box prism = {{x - radius, y - radius, 0},
                              {x + radius, y + radius, s->space.height_m}};
    const struct box local = {{space.low[0], space.low[1], top},
                              {space.high[0], space.high[1], ground}};
    const struct box volume = meet(&prism, &local);
    show_box(s, &space, &grey);
    show_sheet(s, local.low, local.high, top, &green, 0.1f);
    show_sheet(s, local.low, local.high, ground, &green, 0.1f);
    if (!s->settings.limits)
        return;
    show_box(s, &prism, &red);
    show_box(s, &volume, &blue);
}

// All packets as outlines on the top plane, the selected ones filled.
static void show_packets(const struct streaks *s)
{
    const struct streaks_packets_info *info = streaks_packets_info(s->packets);
    const int most = 20000; // more are a blur
    int next = 0;
    for (int place = 0; place < info->places && info->places <= most; place++) {
        double r[4];
        const bool selected = next < s->selection.packets && s->selection.selected[next] == place;
        next += selected;
        if (!streaks_packets_count(s->packets, place))
            continue;
        streaks_packets_rectangle(s->packets, place, r);
        show_sheet(s, (double[]){r[0], r[1]}, (double[]){r[2], r[3]}, 0, &purple,
                   selected ? 0.5f : 0);
    }
}

static bool show_map(struct streaks *s)
{
    const struct rg_image_desc *desc = &s->base.target->desc;
    const int size = (desc->width < desc->height ? desc->width : desc->height) / 4, gap = size / 16;
    if (size < 16)
        return true;
    const scenery_inset_params inset = {.x0 = desc->width - size - gap,
                                        .y0 = gap,
                                        .x1 = desc->width - gap,
                                        .y1 = gap + size,
                                        .u1 = 1,
                                        .v1 = 1,
                                        .far_depth = 1};
    return scenery_overlay_inset(s->overlay, &inset, s->map->depths, s->base.target);
}

bool streaks_show(struct streaks *s)
{
    scenery_overlay_begin(s->overlay);
    show_spaces(s);
    show_packets(s);
    for (int i = 0; i < s->lights->count; i++)
        scenery_overlay_light(s->overlay, &s->lights->world[i], &white);
    return scenery_overlay_draw(s->overlay, s->observer.world_to_clip, s->base.target,
                                rg_asset_find(&s->base, "depth")->image) &&
           show_map(s);
}
