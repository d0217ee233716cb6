#include "core/techniques/cartoon/water/water.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "kernels/dialect/rng.h"

enum { CELLS = CARTOON_COLUMNS * CARTOON_COLUMNS };

#define PARAMS .params = offsetof(struct cartoon_water, params)

// A column gives each of its four neighbours at most a fifth, so that water never oscillates.
#define MOST_SPREAD 0.2

static const struct rg_stage stages[CARTOON_WATER_STAGES] = {
    [CARTOON_WATER_GATHER] = {"cartoon_gather", PARAMS},
    [CARTOON_WATER_SPREAD] = {"cartoon_spread", PARAMS, .over = "water"},
    [CARTOON_WATER_PUDDLES] = {"cartoon_puddles", PARAMS, .colour = RG_LAYER,
                               .blend = RG_BLEND_OVER},
};

// If the volume of drops is left to the scene, this many of the heaviest, spread over the whole
// ground, make water of visible depth.
#define DROPS_DEEP 5000.0

// Hollows: their spacing in columns, and the largest factor by which they deepen or raise the
// ground.
#define HOLLOW_COLUMNS 9
#define HOLLOW         3.0

static double chance_at(int x, int y)
{
    return 2 * (double)rg_uniform(rg_random(5, (uint32_t)x, (uint32_t)y, 0).x) - 1;
}

// Smooth noise, -1 to 1.
static double hollow_at(double x, double y)
{
    const int i = (int)x, j = (int)y;
    const double s = x - i, t = y - j, u = s * s * (3 - 2 * s), v = t * t * (3 - 2 * t);
    const double above = chance_at(i, j) + (chance_at(i + 1, j) - chance_at(i, j)) * u;
    const double below = chance_at(i, j + 1) + (chance_at(i + 1, j + 1) - chance_at(i, j + 1)) * u;
    return above + (below - above) * v;
}

static void add_beds(struct rg_instance *instance)
{
    float *beds = rg_alloc(CELLS, sizeof(*beds), "beds");
    instance->has_failed |= !beds;
    for (int i = 0; beds && i < CELLS; i++) {
        const double x = (double)(i % CARTOON_COLUMNS) / HOLLOW_COLUMNS,
                     y = (double)(i / CARTOON_COLUMNS) / HOLLOW_COLUMNS;
        beds[i] = (float)pow(HOLLOW, hollow_at(x, y));
    }
    rg_add_buf(instance, "beds", CELLS, beds);
    free(beds);
}

static uint32_t share_of_2_32(double share)
{
    return (uint32_t)(fmin(fmax(share, 0), 1) * 4294967295.0);
}

static void fill(struct cartoon_water *w)
{
    const struct cartoon_water_settings *s = w->settings;
    const struct rg_mesh *mesh = w->rain->scene.diorama->mesh;
    const double step_s = (double)w->rain->params.step_s;
    const double wide_m = (double)mesh->high[0] - (double)mesh->low[0],
                 deep_m = (double)mesh->high[2] - (double)mesh->low[2];
    const double area_m2 = wide_m * deep_m / CELLS;
    const double drop_m3 = s->drop_m3 > 0 ? s->drop_m3 : s->from_m * wide_m * deep_m / DROPS_DEEP;
    w->params = (cartoon_water_params){
        .low_x = mesh->low[0],
        .low_z = mesh->low[2],
        .per_column_x = (float)(CARTOON_COLUMNS / wide_m),
        .per_column_z = (float)(CARTOON_COLUMNS / deep_m),
        .units = (float)(drop_m3 / CARTOON_UNIT_M3),
        .least = w->rain->params.least,
        .spread = share_of_2_32(fmin(s->spread_m2_s * step_s / area_m2, MOST_SPREAD)),
        .dried = share_of_2_32(1 - exp(-step_s / s->dry_s)),
        .per_unit = (float)(CARTOON_UNIT_M3 / area_m2 / s->from_m),
    };
}

bool cartoon_water_open(struct cartoon_water *w, const struct cartoon_rain *rain,
                        const struct cartoon_water_settings *settings)
{
    struct rg_instance *i = rain->instance;
    w->rain = rain;
    w->settings = settings;
    if (!settings->on)
        return true;
    fill(w);
    w->now = rg_add_buf(i, "water", CELLS, NULL);
    w->next = rg_add_buf(i, "water_next", CELLS, NULL);
    add_beds(i);
    w->account = rg_add_buf(i, "account", CARTOON_ACCOUNT, NULL);
    rg_add_state(i, w->now, "water", CARTOON_COLUMNS, 0);
    rg_add_state(i, w->account, "account", 0, 0);
    w->first_stage = rg_open_stages(i, stages, CARTOON_WATER_STAGES, w, NULL);
    return w->first_stage >= 0;
}

bool cartoon_water_step(struct cartoon_water *w)
{
    struct rg_instance *i = w->rain->instance;
    if (!w->settings->on)
        return true;
    const struct rg_extent drops = {w->rain->drops, 1, 1}, none = {0, 0, 0};
    if ((w->rain->drops && !rg_stage_over(i, w->first_stage + CARTOON_WATER_GATHER, none, drops)) ||
        !rg_stage(i, w->first_stage + CARTOON_WATER_SPREAD))
        return false;
    rg_swap(w->now, w->next);
    return true;
}

bool cartoon_water_draw(struct cartoon_water *w, const struct cartoon_water_view *view)
{
    const struct rg_camera *camera = w->rain->scene.camera;
    if (!w->settings->on)
        return true;
    w->params.from_pixel = view->from_pixel;
    w->params.eye_x = camera->position[0];
    w->params.eye_y = camera->position[1];
    w->params.eye_z = camera->position[2];
    w->params.px = 1 / w->rain->params.focal_px;
    w->params.light_x = view->to_light[0];
    w->params.light_z = view->to_light[2];
    w->params.ink_r = (float)view->ink[0];
    w->params.ink_g = (float)view->ink[1];
    w->params.ink_b = (float)view->ink[2];
    return rg_stage(w->rain->instance, w->first_stage + CARTOON_WATER_PUDDLES);
}

bool cartoon_water_holds(const struct cartoon_water *w, char *detail, size_t size)
{
    uint32_t account[CARTOON_ACCOUNT], held = 0;
    if (!w->settings->on)
        return true;
    uint32_t *cells = rg_alloc(CELLS, sizeof(*cells), "water");
    const bool is_read = cells && rg_buf_read(w->now->buf, 0, cells, CELLS * 4) &&
                         rg_buf_read(w->account->buf, 0, account, sizeof(account));
    for (int i = 0; is_read && i < CELLS; i++)
        held += cells[i];
    free(cells);
    if (!is_read)
        return false;
    const bool holds = account[CARTOON_WATER_HIT] ==
                       held + account[CARTOON_WATER_DRIED] + account[CARTOON_WATER_RUN];
    if (!holds)
        snprintf(detail, size, "%u units of water have hit; %u lie, %u evaporated, %u ran off",
                 account[CARTOON_WATER_HIT], held, account[CARTOON_WATER_DRIED],
                 account[CARTOON_WATER_RUN]);
    return holds;
}
