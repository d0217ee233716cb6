// flow: water on a mirror pane as a cellular automaton on a height map. Stuppacher & Supan,
// "Rendering of Water Drops in Real-Time" (2007). This file holds the order of the passes; formulas
// are in kernels/flow*.h, what the host computes in flow_model.c, and docs/flow.md explains.
#include "core/techniques/flow.h"

#include <stdlib.h>
#include <string.h>

#include "core/alloc.h"
#include "core/log.h"
#include "core/scene/environment.h"
#include "core/techniques/technique.h"
#include "kernels/normal_map.h"

enum flow_pass { SPLAT, GIVEN, DRAIN, MOVE, BLUR, NORMALS, LIGHT, PASS_COUNT };

static const char *const kernels[PASS_COUNT] = {
    "flow_splat", "flow_given",   "flow_drain", "flow_move",
    "flow_blur",  "flow_normals", "flow_light",
};

enum flow_counter { DROPS, TEXELS, PIXELS, COUNTER_COUNT };

static const char *const counter_names[COUNTER_COUNT] = {"drops_landed", "texels_moved",
                                                         "pixels_lit"};

struct flow {
    struct rg_instance base;
    struct flow_settings settings;
    int noise_size;
    struct rg_pass *passes[PASS_COUNT];
    struct rg_buf *water, *moved; // of this frame, and scratch for the next
    struct rg_buf *given, *ledger, *remainder, *noise, *blurred, *normals;
    struct rg_image *environment;
};

static void flow_destroy(struct rg_instance *instance)
{
    struct flow *flow = (struct flow *)instance;
    for (int i = 0; i < PASS_COUNT; i++)
        rg_pass_destroy(flow->passes[i]);
    rg_buf_destroy(flow->water);
    rg_buf_destroy(flow->moved);
    rg_buf_destroy(flow->given);
    rg_buf_destroy(flow->ledger);
    rg_buf_destroy(flow->remainder);
    rg_buf_destroy(flow->noise);
    rg_buf_destroy(flow->blurred);
    rg_buf_destroy(flow->normals);
    rg_image_destroy(flow->environment);
    rg_image_destroy(flow->base.target);
    free(flow);
}

// --- opening ---

static bool create_passes(struct flow *flow)
{
    for (int i = 0; i < PASS_COUNT; i++)
        if (!(flow->passes[i] = rg_pass_create(flow->base.device, kernels[i])))
            return false;
    return true;
}

// A buffer of 4-byte elements with these contents; zeroes where `data` is NULL.
static struct rg_buf *create_filled(struct rg_device *device, int64_t count, const void *data,
                                    const char *name)
{
    void *zeroes = data ? NULL : rg_alloc((size_t)count, 4, name);
    const void *contents = data ? data : zeroes;
    struct rg_buf *buf = contents ? rg_buf_create(device, count * 4, name) : NULL;
    if (buf && !rg_buf_write(buf, 0, contents, count * 4)) {
        rg_buf_destroy(buf);
        buf = NULL;
    }
    free(zeroes);
    return buf;
}

static bool create_map(struct rg_device *device, float *values, int64_t count, const char *name,
                       struct rg_buf **buf)
{
    *buf = values ? create_filled(device, count, values, name) : NULL;
    free(values);
    return *buf != NULL;
}

// The normal map's margin is never written, and reads as flat and dry.
static bool create_normals(struct flow *flow, int64_t texels)
{
    uint32_t *flat = rg_alloc((size_t)texels, sizeof(*flat), "normal map");
    if (!flat)
        return false;
    for (int64_t i = 0; i < texels; i++)
        flat[i] = wet_normal_pack(0, 0, 0);
    flow->normals = create_filled(flow->base.device, texels, flat, "normal map");
    free(flat);
    return flow->normals;
}

static bool create_buffers(struct flow *flow)
{
    struct rg_device *device = flow->base.device;
    const int64_t texels = flow_map_length(flow->settings.resolution_px);
    return (flow->water = create_filled(device, texels, NULL, "water")) &&
           (flow->moved = create_filled(device, texels, NULL, "moved water")) &&
           (flow->given = create_filled(device, texels, NULL, "given water")) &&
           (flow->blurred = create_filled(device, texels, NULL, "blurred water")) &&
           create_normals(flow, texels) &&
           (flow->ledger = create_filled(device, FLOW_LEDGER_WORDS, NULL, "ledger"));
}

static bool create_maps(struct flow *flow)
{
    float *remainder = flow_remainder_map(&flow->settings);
    float *noise = flow_noise_map(&flow->settings, &flow->noise_size);
    const int64_t noise_texels = (int64_t)flow->noise_size * flow->noise_size;
    bool ok = create_map(flow->base.device, remainder, FLOW_REMAINDER_ENTRIES, "remainder map",
                         &flow->remainder);
    return create_map(flow->base.device, noise, noise_texels, "noise map", &flow->noise) && ok;
}

static bool create_images(struct flow *flow, int width, int height)
{
    struct rg_environment *environment = rg_environment_load(flow->settings.environment);
    if (!environment)
        return false;
    flow->environment =
        rg_environment_upload(environment, flow->settings.environment_px,
                              flow_reflection_level(&flow->settings) + 1, flow->base.device);
    rg_environment_destroy(environment);
    flow->base.target = rg_image_create(
        flow->base.device, &(struct rg_image_desc){RG_RGBA16F, width, height, 1, 1}, "target");
    return flow->environment && flow->base.target;
}

static void show_state(struct flow *flow)
{
    flow->base.state_count = FLOW_STATE_COUNT;
    flow->base.state[FLOW_STATE_WATER] = (struct rg_state){
        .name = "water",
        .buf = flow->water,
        .is_float = true,
        .row = flow->settings.resolution_px + 2 * FLOW_MARGIN,
        .margin = FLOW_MARGIN,
    };
    flow->base.state[FLOW_STATE_LEDGER] = (struct rg_state){.name = "ledger", .buf = flow->ledger};
}

static bool land(struct flow *flow, int64_t frame, int count);

static struct rg_instance *flow_create(struct rg_device *device, const void *settings, int width,
                                       int height)
{
    struct flow *flow = rg_alloc(1, sizeof(*flow), "flow");
    if (!flow)
        return NULL;
    flow->base.technique = rg_technique_find("flow");
    flow->base.device = device;
    flow->settings = *(const struct flow_settings *)settings;
    flow->base.counter_count = COUNTER_COUNT;
    for (int i = 0; i < COUNTER_COUNT; i++)
        flow->base.counters[i].name = counter_names[i];
    if (!create_passes(flow) || !create_buffers(flow) || !create_maps(flow) ||
        !create_images(flow, width, height) || !land(flow, -1, flow->settings.drops)) {
        flow_destroy(&flow->base);
        return NULL;
    }
    show_state(flow);
    return &flow->base;
}

// --- a frame ---

static int clamp(double value, int low, int high)
{
    return value < low ? low : value > high ? high : (int)value;
}

// Runs the splat of one drop over the texels that it covers, if any.
static bool land_drop(struct flow *flow, const flow_splat_params *drop)
{
    const double reach = (double)drop->radius_px + 1;
    const int x0 = clamp((double)drop->centre_x - reach, 0, drop->size);
    const int y0 = clamp((double)drop->centre_y - reach, 0, drop->size);
    const int x1 = clamp((double)drop->centre_x + reach, 0, drop->size);
    const int y1 = clamp((double)drop->centre_y + reach, 0, drop->size);
    if (x0 >= x1 || y0 >= y1)
        return true;
    flow->base.counters[DROPS].value++;
    return rg_instance_run(&flow->base, flow->passes[SPLAT],
                           &(struct rg_run){
                               .params = drop,
                               .slots = {[1].buf = flow->water, [2].buf = flow->ledger},
                               .origin = {x0, y0, 0},
                               .extent = {x1 - x0, y1 - y0, 1},
                           });
}

static bool land(struct flow *flow, int64_t frame, int count)
{
    for (int i = 0; i < count; i++) {
        flow_splat_params drop = flow_drop(&flow->settings, frame, i);
        if (!land_drop(flow, &drop))
            return false;
    }
    return true;
}

static bool run(struct flow *flow, enum flow_pass pass, struct rg_run run)
{
    return rg_instance_run(&flow->base, flow->passes[pass], &run);
}

static bool move(struct flow *flow)
{
    const int n = flow->settings.resolution_px;
    const struct rg_extent pane = {n, n, 1};
    const flow_params p = flow_params_at(&flow->settings, flow->noise_size, flow->base.frame);
    bool ok =
        run(flow, GIVEN,
            (struct rg_run){.params = &p,
                            .slots = {[1].buf = flow->water,
                                      [2].buf = flow->remainder,
                                      [3].buf = flow->noise,
                                      [4].buf = flow->given},
                            .extent = pane}) &&
        run(flow, DRAIN,
            (struct rg_run){
                .params = &p,
                .slots = {[1].buf = flow->water, [2].buf = flow->given, [3].buf = flow->ledger},
                .extent = {n, FLOW_DRAIN_SIDES, 1}}) &&
        run(flow, MOVE,
            (struct rg_run){
                .params = &p,
                .slots = {[1].buf = flow->water, [2].buf = flow->given, [3].buf = flow->moved},
                .extent = pane});
    struct rg_buf *moved = flow->moved;
    flow->moved = flow->water;
    flow->water = moved;
    flow->base.counters[TEXELS].value += (int64_t)n * n;
    return ok;
}

static bool flow_step(struct rg_instance *instance)
{
    struct flow *flow = (struct flow *)instance;
    bool ok =
        land(flow, instance->frame, flow_drops_at(&flow->settings, instance->frame)) && move(flow);
    instance->frame++;
    show_state(flow);
    return ok;
}

static bool flow_draw(struct rg_instance *instance)
{
    struct flow *flow = (struct flow *)instance;
    const int n = flow->settings.resolution_px;
    const struct rg_image_desc *target = &instance->target->desc;
    const flow_params p = flow_params_at(&flow->settings, flow->noise_size, instance->frame);
    const flow_light_params l =
        flow_light_params_of(&flow->settings, target->width, target->height);
    instance->counters[PIXELS].value += (int64_t)target->width * target->height;
    return run(flow, BLUR,
               (struct rg_run){.params = &p,
                               .slots = {[1].buf = flow->water, [2].buf = flow->blurred},
                               .extent = {n, n, 1}}) &&
           run(flow, NORMALS,
               (struct rg_run){.params = &l,
                               .slots = {[1].buf = flow->blurred, [2].buf = flow->normals},
                               .extent = {n, n, 1}}) &&
           run(flow, LIGHT,
               (struct rg_run){.params = &l,
                               .slots = {[1].buf = flow->normals,
                                         [2].image = flow->environment,
                                         [3].image = instance->target},
                               .extent = {target->width, target->height, 1}});
}

const struct rg_technique rg_technique_flow = {
    .name = "flow",
    .paper = "stuppacher",
    .about = "water flowing down a mirror pane, on a height map (Stuppacher & Supan 2007)",
    .params = &flow_param_table,
    .proof = &flow_proof,
    .create = flow_create,
    .destroy = flow_destroy,
    .step = flow_step,
    .draw = flow_draw,
};
