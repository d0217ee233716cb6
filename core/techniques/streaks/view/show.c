// The additions of the thesis's figures: the spaces of the simulation, packets, lights, and the
// depth map (figures 4.4, 4.5, 4.11, 4.14 and 5.7).
#include <math.h>

#include "core/techniques/scenery/overlay.h"
#include "core/techniques/streaks/instance.h"

// The colours of the thesis's figures 4.4, 4.11, 4.14 and 5.7.
static const struct scenery_ink grey = {0.45f, 0.45f, 0.45f, 1, 1.5f};
static const struct scenery_ink green = {0.05f, 0.75f, 0.10f, 1, 1.5f};
static const struct scenery_ink red = {0.95f, 0.05f, 0.03f, 1, 2};
static const struct scenery_ink blue = {0.05f, 0.15f, 1, 1, 2};
static const struct scenery_ink purple = {0.55f, 0.08f, 0.80f, 1, 1.5f};
static const struct scenery_ink bold_purple = {0.55f, 0.08f, 0.80f, 1, 4};
static const struct scenery_ink black = {0, 0, 0, 1, 2};

// A box of the rain frame.
struct box {
    double low[3], high[3];
};

static void to_world(const struct streaks *s, double x, double y, double along, float world[3])
{
    const double rain[3] = {x, y, along};
    double point[3];
    streaks_world_point(s, rain, point);
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

// Shows a rectangle across the fall.
static void show_sheet(const struct streaks *s, const double low[2], const double high[2],
                       double along, const struct scenery_ink *ink)
{
    float corners[4][3];
    to_world(s, low[0], low[1], along, corners[0]);
    to_world(s, high[0], low[1], along, corners[1]);
    to_world(s, high[0], high[1], along, corners[2]);
    to_world(s, low[0], high[1], along, corners[3]);
    scenery_overlay_sheet(s->overlay, corners, ink, 0);
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
    if (!s->settings.limits)
        return; // the local space repeats, so it has no outline
    show_sheet(s, local.low, local.high, top, &green);
    show_sheet(s, local.low, local.high, ground, &green);
    show_box(s, &prism, &red);
    show_box(s, &volume, &blue);
}

// Shows all packets as outlines on the top plane, the selected ones bolder.
static void show_packets(const struct streaks *s)
{
    const struct streaks_packets_info *info = streaks_packets_info(s->rain->packets);
    const int most = 20000; // more would be a blur
    int next = 0;
    for (int place = 0; place < info->places && info->places <= most; place++) {
        double r[4];
        const bool selected = next < s->selection.packets && s->selection.selected[next] == place;
        next += selected;
        if (!streaks_packets_count(s->rain->packets, place))
            continue;
        streaks_packets_rectangle(s->rain->packets, place, r);
        show_sheet(s, (double[]){r[0], r[1]}, (double[]){r[2], r[3]}, 0,
                   selected ? &bold_purple : &purple);
    }
}

// --- the observer's view, from outside ---

// Shows a light's frustum in its colour.
static void show_light(const struct streaks *s, const scenery_light *light)
{
    const float most = fmaxf(fmaxf(light->r, light->g), fmaxf(light->b, 1e-6f));
    const struct scenery_ink ink = {light->r / most, light->g / most, light->b / most, 0.9f, 1.5f};
    scenery_overlay_light(s->overlay, light, &ink);
}

// Shows the part of the segment from a to b that is above the top plane, projected onto it.
static void show_on_top(const struct streaks *s, const double a[3], const double b[3])
{
    const double half[2] = {s->space.half_x_m, s->space.half_y_m};
    double from = 0, to = 1;
    for (int axis = 0; axis < 2; axis++)
        for (int side = -1; side <= 1; side += 2) {
            const double in_a = half[axis] - side * a[axis], in_b = half[axis] - side * b[axis];
            if (in_a < 0 && in_b < 0)
                return;
            if (in_a < 0)
                from = fmax(from, in_a / (in_a - in_b));
            if (in_b < 0)
                to = fmin(to, in_a / (in_a - in_b));
        }
    float ends[2][3];
    if (from >= to)
        return;
    to_world(s, a[0] + from * (b[0] - a[0]), a[1] + from * (b[1] - a[1]), 0, ends[0]);
    to_world(s, a[0] + to * (b[0] - a[0]), a[1] + to * (b[1] - a[1]), 0, ends[1]);
    scenery_overlay_line(s->overlay, ends[0], ends[1], &black);
}

// Shows the observer's frustum on the top plane: its edges along the view and at its end. Also
// shows its bounding rectangle, by which packets are selected (figure 4.14).
static bool show_frustum(const struct streaks *s)
{
    static const int end[4][2] = {{4, 5}, {6, 7}, {4, 6}, {5, 7}}; // edges between far corners
    const struct rg_image_desc *desc = &s->base.target->desc;
    double corners[8][3], low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    if (!rg_rain_view_corners(&s->space, &s->observer.camera, (double)desc->width / desc->height,
                              corners))
        return false;
    for (int k = 0; k < 4; k++)
        show_on_top(s, corners[k], corners[k + 4]);
    for (int k = 0; k < 4; k++)
        show_on_top(s, corners[end[k][0]], corners[end[k][1]]);
    for (int k = 0; k < 8; k++)
        for (int axis = 0; axis < 2; axis++) {
            const double half = axis ? s->space.half_y_m : s->space.half_x_m;
            const double at = fmax(-half, fmin(half, corners[k][axis]));
            low[axis] = fmin(low[axis], at);
            high[axis] = fmax(high[axis], at);
        }
    show_sheet(s, low, high, 0, &black);
    return true;
}

// --- maps in the picture's corner ---

// Shows a map as the n-th inset from the top.
static bool show_map(struct streaks *s, struct rg_image *map, int n, float white_at)
{
    const struct rg_image_desc *desc = &s->base.target->desc;
    const int size = (desc->width < desc->height ? desc->width : desc->height) / 4, gap = size / 16;
    if (size < 16)
        return true;
    const int top = gap + n * (size + gap);
    const scenery_inset_params inset = {.x0 = desc->width - size - gap,
                                        .y0 = top,
                                        .x1 = desc->width - gap,
                                        .y1 = top + size,
                                        .u1 = 1,
                                        .v1 = 1,
                                        .near_depth = white_at,
                                        .far_depth = 1 - white_at};
    return scenery_overlay_inset(s->overlay, &inset, map, s->base.target);
}

static bool show_maps(struct streaks *s)
{
    int shown = 0;
    if (s->density && !show_map(s, s->density, shown++, 1))
        return false;
    return show_map(s, s->map->depths, shown, 0);
}

bool streaks_show(struct streaks *s)
{
    const bool all = s->settings.overlay == STREAKS_OVERLAY_ALL;
    scenery_overlay_begin(s->overlay);
    if (all) {
        show_spaces(s);
        show_packets(s);
    }
    for (int i = 0; i < s->lights->count; i++)
        show_light(s, &s->lights->world[i]);
    // The observer is in a box, and selects packets there.
    const bool is_box = !streaks_narrowing(s);
    return (!all || !s->settings.outside || !is_box || show_frustum(s)) &&
           scenery_overlay_draw(s->overlay, streaks_viewer(s)->world_to_clip, s->base.target,
                                rg_asset_find(&s->base, "depth")->image) &&
           (!all || show_maps(s));
}
