// Opens flow on a device: its passes, maps, inputs and images.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/scene/environment/environment.h"
#include "core/scene/mesh/mesh.h"
#include "core/techniques/flow/instance.h"
#include "kernels/flow/glow/params.h"
#include "kernels/flow/panes/normal_map.h"

static const char *const counter_names[FLOW_COUNTER_COUNT] = {"drops_landed", "texels_moved",
                                                              "pixels_lit", "model_triangles"};

void flow_close(struct rg_instance *instance)
{
    struct flow *flow = (struct flow *)instance;
    for (int i = 0; i < FLOW_PASS_COUNT; i++)
        rg_pass_destroy(flow->passes[i]);
    struct rg_buf *const bufs[] = {
        flow->water,     flow->moved,         flow->given,     flow->arriving, flow->blurred,
        flow->normals,   flow->ledger,        flow->remainder, flow->noise,    flow->panes,
        flow->positions, flow->model_normals, flow->indices};
    for (size_t i = 0; i < sizeof(bufs) / sizeof(bufs[0]); i++)
        rg_buf_destroy(bufs[i]);
    struct rg_image *const images[] = {flow->environment, flow->behind, flow->depth,      flow->lit,
                                       flow->bright,      flow->spread, flow->base.target};
    for (size_t i = 0; i < sizeof(images) / sizeof(images[0]); i++)
        rg_image_destroy(images[i]);
    free(flow);
}

// --- passes ---

bool flow_has_behind(const struct flow_settings *s)
{
    return s->stage == FLOW_STAGE_FINAL && s->panes == FLOW_GLASS;
}

static bool has_model(const struct flow_settings *s)
{
    return flow_has_behind(s) && s->view == FLOW_BOX && strcmp(s->model, "none") && s->model[0];
}

static const char *kernel_of(const struct flow_settings *s, enum flow_pass pass)
{
    const bool final = s->stage == FLOW_STAGE_FINAL, glow = final && s->glow > 0;
    switch (pass) {
    case FLOW_SPLAT:
        return "flow_splat";
    case FLOW_GIVEN:
        return "flow_given";
    case FLOW_DRAIN:
        return "flow_drain";
    case FLOW_MOVE:
        return "flow_move";
    case FLOW_REACH:
        return s->reach_texels > 2 ? "flow_reach" : NULL;
    case FLOW_ARRIVE:
        return s->run_on && s->view == FLOW_BOX ? "flow_arrive" : NULL;
    case FLOW_BLUR:
        return "flow_blur";
    case FLOW_NORMALS:
        return "flow_normals";
    case FLOW_SKY:
        return final && (s->view == FLOW_BOX || flow_has_behind(s)) ? "flow_sky" : NULL;
    case FLOW_MODEL:
        return has_model(s) ? "flow_model" : NULL;
    case FLOW_COPY:
        return flow_has_behind(s) ? "flow_copy" : NULL;
    case FLOW_PANES:
        return !final ? NULL : s->panes == FLOW_GLASS ? "flow_glass" : "flow_mirror";
    case FLOW_SHOW_STAGE:
        return final ? NULL : "flow_stage";
    case FLOW_GLOW_BRIGHT:
        return glow ? "flow_glow_bright" : NULL;
    case FLOW_GLOW_BLUR:
        return glow ? "flow_glow_blur" : NULL;
    case FLOW_GLOW:
        return glow ? "flow_glow" : NULL;
    default:
        return NULL;
    }
}

static bool create_passes(struct flow *flow)
{
    for (int i = 0; i < FLOW_PASS_COUNT; i++) {
        const char *kernel = kernel_of(&flow->settings, (enum flow_pass)i);
        if (kernel && !(flow->passes[i] = rg_pass_create(flow->base.device, kernel)))
            return false;
    }
    return true;
}

// --- buffers ---

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
    const int64_t texels =
        (int64_t)flow->pane_count * flow_map_length(flow->settings.resolution_px);
    const int64_t pane_words = sizeof(flow_pane) / 4;
    return (flow->water = create_filled(device, texels, NULL, "water")) &&
           (flow->moved = create_filled(device, texels, NULL, "moved water")) &&
           (flow->given = create_filled(device, texels, NULL, "given water")) &&
           (flow->arriving = create_filled(device, texels, NULL, "arriving water")) &&
           (flow->blurred = create_filled(device, texels, NULL, "blurred water")) &&
           (flow->panes = create_filled(device, FLOW_MAX_PANES * pane_words, NULL, "panes")) &&
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

// --- images ---

static struct rg_image *create_image(struct flow *flow, enum rg_format format, int width,
                                     int height, const char *name)
{
    return rg_image_create(flow->base.device, &(struct rg_image_desc){format, width, height, 1, 1},
                           name);
}

static bool create_glow(struct flow *flow, int width, int height)
{
    const int w = (width + FLOW_GLOW_REDUCTION - 1) / FLOW_GLOW_REDUCTION;
    const int h = (height + FLOW_GLOW_REDUCTION - 1) / FLOW_GLOW_REDUCTION;
    return (flow->lit = create_image(flow, RG_RGBA16F, width, height, "lit panes")) &&
           (flow->bright = create_image(flow, RG_RGBA16F, w, h, "bright light")) &&
           (flow->spread = create_image(flow, RG_RGBA16F, w, h, "spread light"));
}

static bool create_images(struct flow *flow, int width, int height)
{
    struct rg_environment *environment = rg_environment_load(flow->settings.environment);
    if (!environment)
        return false;
    flow->environment =
        rg_environment_upload(environment, flow->settings.environment_px,
                              flow_environment_levels(&flow->settings), flow->base.device);
    rg_environment_destroy(environment);
    if (!flow->environment ||
        !(flow->base.target = create_image(flow, RG_RGBA16F, width, height, "target")))
        return false;
    if (flow_has_behind(&flow->settings) &&
        (!(flow->behind = create_image(flow, RG_RGBA16F, width, height, "behind")) ||
         !(flow->depth = create_image(flow, RG_D32F, width, height, "depth"))))
        return false;
    return !flow->passes[FLOW_GLOW] || create_glow(flow, width, height);
}

// --- the model ---

static void tell(struct flow *flow, const char *name, double number, const char *text)
{
    struct rg_fact *fact = &flow->base.facts[flow->base.fact_count++];
    fact->name = name;
    fact->number = number;
    snprintf(fact->text, sizeof(fact->text), "%s", text);
}

static bool upload_model(struct flow *flow, const struct rg_mesh *mesh)
{
    uint32_t *normals = rg_mesh_pack_normals(mesh);
    if (!normals)
        return false;
    struct rg_device *device = flow->base.device;
    const int64_t vertices = mesh->vertex_count, faces = mesh->face_count;
    flow->positions = create_filled(device, 3 * vertices, mesh->positions, "model's vertices");
    flow->model_normals = create_filled(device, vertices, normals, "model's normals");
    flow->indices = create_filled(device, 3 * faces, mesh->indices, "model's faces");
    free(normals);
    flow->model_faces = mesh->face_count;
    memcpy(flow->model_low, mesh->low, sizeof(mesh->low));
    memcpy(flow->model_high, mesh->high, sizeof(mesh->high));
    return flow->positions && flow->model_normals && flow->indices;
}

static bool create_model(struct flow *flow)
{
    if (!flow->passes[FLOW_MODEL]) {
        const int corners_a_pane = 4;
        tell(flow, "vertices", flow->pane_count * corners_a_pane, "");
        tell(flow, "faces", flow->pane_count, "");
        return true;
    }
    struct rg_mesh *mesh = rg_mesh_load_faces(flow->settings.model, flow->settings.model_faces);
    if (!mesh)
        return false;
    char text[RG_FACT_SIZE];
    snprintf(text, sizeof(text), "%s, XXH3 %016" PRIx64, mesh->name, mesh->hash);
    tell(flow, "model", 0, text);
    tell(flow, "vertices", mesh->vertex_count, "");
    tell(flow, "faces", mesh->face_count, "");
    const bool ok = upload_model(flow, mesh);
    rg_mesh_destroy(mesh);
    return ok;
}

// --- opening ---

void flow_show_state(struct flow *flow)
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

struct rg_instance *flow_open(struct rg_device *device, const void *settings, int width, int height)
{
    struct flow *flow = rg_alloc(1, sizeof(*flow), "flow");
    if (!flow)
        return NULL;
    flow->base.technique = rg_technique_find("flow");
    flow->base.device = device;
    flow->settings = *(const struct flow_settings *)settings;
    flow->settings.resolution_px = flow_texels(&flow->settings, height);
    flow->pane_count = flow_pane_count(&flow->settings);
    flow->base.counter_count = has_model(&flow->settings) ? FLOW_COUNTER_COUNT : FLOW_TRIANGLES;
    for (int i = 0; i < FLOW_COUNTER_COUNT; i++)
        flow->base.counters[i].name = counter_names[i];
    if (!create_passes(flow) || !create_buffers(flow) || !create_maps(flow) ||
        !create_images(flow, width, height) || !create_model(flow) ||
        !flow_land(flow, -1, flow->settings.drops)) {
        flow_close(&flow->base);
        return NULL;
    }
    flow->base.texture_count = 1;
    flow->base.textures[0] = (struct rg_texture){"environment", flow->environment, 0};
    flow_show_state(flow);
    return &flow->base;
}
