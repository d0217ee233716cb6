// Opens flow on a device: its stages, maps, inputs and images.
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/scene/mesh/mesh.h"
#include "core/techniques/flow/instance.h"
#include "core/techniques/scenery/environment.h"
#include "kernels/flow/panes/normal_map.h"

static const char *const counter_names[FLOW_COUNTER_COUNT] = {"drops_landed", "texels_moved",
                                                              "pixels_lit", "model_triangles"};

// --- choosing stages ---

static const struct flow_settings *settings_of(const struct rg_instance *instance)
{
    return &((const struct flow *)instance)->settings;
}

static bool is_final(const struct rg_instance *i)
{
    return settings_of(i)->stage == FLOW_STAGE_FINAL;
}

static bool is_stage(const struct rg_instance *i)
{
    return !is_final(i);
}

static bool is_glass(const struct rg_instance *i)
{
    return is_final(i) && settings_of(i)->panes == FLOW_GLASS;
}

static bool is_mirror(const struct rg_instance *i)
{
    return is_final(i) && settings_of(i)->panes == FLOW_MIRROR;
}

// A mirror pane that fills the view hides everything else.
static bool has_sky(const struct rg_instance *i)
{
    return is_glass(i) || (is_mirror(i) && settings_of(i)->view == FLOW_BOX);
}

static bool has_model(const struct rg_instance *i)
{
    const struct flow_settings *s = settings_of(i);
    return is_glass(i) && s->view == FLOW_BOX && strcmp(s->model, "none") && s->model[0];
}

static bool has_glow(const struct rg_instance *i)
{
    return is_final(i) && settings_of(i)->glow > 0;
}

static bool is_paper(const struct rg_instance *i)
{
    return settings_of(i)->move == FLOW_MOVE_PAPER;
}

static bool keeps_directions(const struct rg_instance *i)
{
    return is_paper(i) && settings_of(i)->direction == FLOW_EACH_TEXEL;
}

static bool has_one_direction(const struct rg_instance *i)
{
    return is_paper(i) && !keeps_directions(i);
}

static bool is_sliding(const struct rg_instance *i)
{
    return !is_paper(i);
}

static bool reaches_far(const struct rg_instance *i)
{
    return has_one_direction(i) && settings_of(i)->reach_texels > 2;
}

static bool runs_on(const struct rg_instance *i)
{
    return settings_of(i)->run_on && settings_of(i)->view == FLOW_BOX;
}

#define AT(field) offsetof(struct flow, field)

static const struct rg_stage stages[FLOW_PASS_COUNT] = {
    [FLOW_SPLAT] = {"flow_splat", is_paper, .params = AT(drop)},
    [FLOW_LAND] = {"flow_land", is_sliding, .params = AT(movement)},
    [FLOW_GIVEN] = {"flow_given", has_one_direction, .params = AT(movement), .over = "given"},
    [FLOW_DRAIN] = {"flow_drain", has_one_direction, .params = AT(movement), .over = "arriving"},
    [FLOW_MOVE] = {"flow_move", has_one_direction, .params = AT(movement), .over = "given"},
    [FLOW_REACH] = {"flow_reach", reaches_far, .params = AT(movement), .over = "given"},
    [FLOW_SWEPT_GIVEN] = {"flow_swept_given", keeps_directions, .params = AT(movement),
                          .over = "given"},
    [FLOW_SWEPT_DRAIN] = {"flow_swept_drain", keeps_directions, .params = AT(movement),
                          .over = "arriving"},
    [FLOW_SWEPT_MOVE] = {"flow_swept_move", keeps_directions, .params = AT(movement),
                         .over = "given"},
    [FLOW_ARRIVE] = {"flow_arrive", runs_on, .params = AT(movement), .over = "arriving",
                     .named = {{"water", "moved"}}},
    [FLOW_LEVEL] = {"flow_level", is_sliding, .params = AT(sliding), .over = "level"},
    [FLOW_SMOOTH_ONCE] = {"flow_smooth", is_sliding, .params = AT(sliding), .over = "level",
                          .named = {{"rough", "level"}, {"even", "wide"}}},
    [FLOW_SMOOTH_TWICE] = {"flow_smooth", is_sliding, .params = AT(sliding), .over = "level",
                           .named = {{"rough", "wide"}, {"even", "close"}}},
    [FLOW_SMOOTH_THRICE] = {"flow_smooth", is_sliding, .params = AT(sliding), .over = "level",
                            .named = {{"rough", "close"}, {"even", "level"}}},
    [FLOW_SMOOTH_WIDE] = {"flow_smooth", is_sliding, .params = AT(sliding), .over = "level",
                          .named = {{"rough", "level"}, {"even", "wide"}}},
    [FLOW_PACE] = {"flow_pace", is_sliding, .params = AT(sliding), .over = "level"},
    [FLOW_SPREAD] = {"flow_spread", is_sliding, .params = AT(sliding), .over = "level",
                     .named = {{"slow", "pace"}, {"cells", "mean"}, {"fast", "paces"}}},
    [FLOW_WET_ROWS] = {"flow_wet_rows", is_sliding, .params = AT(sliding), .over = "given"},
    [FLOW_WET] = {"flow_wet", is_sliding, .params = AT(sliding), .over = "given"},
    [FLOW_CLOSE_ACROSS] = {"flow_across", is_sliding, .params = AT(sliding), .over = "close_rows",
                           .named = {{"cells", "close"}, {"rows", "close_rows"}}},
    [FLOW_RIDGE_ACROSS] = {"flow_across", is_sliding, .params = AT(sliding), .over = "close_rows",
                           .named = {{"cells", "ridge"}, {"rows", "ridge_rows"}}},
    [FLOW_PULL] = {"flow_pull", is_sliding, .params = AT(sliding), .over = "given"},
    [FLOW_RELAX_FAR] = {"flow_relax_far", is_sliding, .params = AT(sliding), .over = "given"},
    [FLOW_RELAX] = {"flow_relax", is_sliding, .params = AT(sliding), .over = "given"},
    [FLOW_CLING] = {"flow_cling", is_sliding, .params = AT(sliding), .over = "given"},
    [FLOW_SLIDE_OFF] = {"flow_slide_off", is_sliding, .params = AT(sliding), .over = "arriving"},
    [FLOW_SLIDE] = {"flow_slide", is_sliding, .params = AT(sliding), .over = "given"},
    [FLOW_BLUR] = {"flow_blur", .params = AT(movement), .over = "given"},
    [FLOW_NORMALS] = {"flow_normals", .params = AT(surface), .over = "given"},
    [FLOW_SKY] = {"flow_sky", has_sky, .params = AT(view), .colour = "around"},
    [FLOW_DRY_MIRRORS] = {"flow_dry_mirror", is_mirror, .params = AT(view), .over = "panes",
                          .colour = "around", .cull = RG_CULL_BACK},
    [FLOW_BEHIND_MODEL] = {"flow_copy", has_model, .params = AT(view), .over = "around",
                           .named = {{"behind", "around"}, {"target", "behind"}}},
    [FLOW_MODEL] = {"flow_model", has_model, .params = AT(model_view), .over = "indices",
                    .colour = "behind", .depth = "depth", .depth_mode = RG_DEPTH_WRITE,
                    .cull = RG_CULL_BACK, .named = {{"normals", "model_normals"}}},
    [FLOW_COPY] = {"flow_copy", has_sky, .params = AT(view), .over = "around",
                   .named = {{"target", "canvas"}}},
    [FLOW_FAR_GLASS] = {"flow_glass", is_glass, .params = AT(view), .over = "panes",
                        .colour = "canvas", .depth = "depth", .depth_mode = RG_DEPTH_TEST,
                        .blend = RG_BLEND_OVER, .cull = RG_CULL_FRONT,
                        .named = {{"behind", "around"}}},
    [FLOW_NEAR_GLASS] = {"flow_glass", is_glass, .params = AT(view), .over = "panes",
                         .colour = "canvas", .blend = RG_BLEND_OVER, .cull = RG_CULL_BACK},
    [FLOW_MIRRORS] = {"flow_mirror", is_mirror, .params = AT(view), .over = "panes",
                      .colour = "canvas", .cull = RG_CULL_BACK},
    [FLOW_SHOW_STAGE] = {"flow_stage", is_stage, .params = AT(view), .over = "panes",
                         .colour = "target", .cull = RG_CULL_BACK},
    [FLOW_GLOW_BRIGHT] = {"flow_glow_bright", has_glow, .params = AT(glow), .over = "bright"},
    [FLOW_GLOW_ACROSS] = {"flow_glow_blur", has_glow, .params = AT(glow_across), .over = "bright",
                          .named = {{"source", "bright"}}},
    [FLOW_GLOW_DOWN] = {"flow_glow_blur", has_glow, .params = AT(glow_down), .over = "bright",
                        .named = {{"source", "spread"}, {"spread", "bright"}}},
    [FLOW_GLOW] = {"flow_glow", has_glow, .params = AT(glow), .over = "target",
                   .named = {{"glow", "bright"}}},
};

// --- maps ---

// The normal map's margin is never written; it reads as flat and dry.
static void add_normals(struct flow *flow, int64_t texels)
{
    uint32_t *flat = rg_alloc((size_t)texels, sizeof(*flat), "normal map");
    for (int64_t i = 0; flat && i < texels; i++)
        flat[i] = wet_normal_pack(0, 0, 0);
    flow->base.has_failed |= !flat;
    rg_add_buf(&flow->base, "normals", texels, flat);
    free(flat);
}

// Adds the maps of all panes, one after the other.
static void add_water(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    const int64_t texels = flow_most_sizes(flow).texels;
    const int row = 1; // placeholder; flow_use_detail sets it
    flow->water = rg_add_buf(i, "water", texels, NULL);
    flow->moved = rg_add_buf(i, "moved", texels, NULL);
    rg_add_buf(i, "given", texels, NULL);
    rg_add_buf(i, "arriving", texels, NULL);
    rg_add_buf(i, "blurred", texels, NULL);
    add_normals(flow, texels);
    flow->panes = rg_add_buf(i, "panes", FLOW_MAX_PANES * (int64_t)sizeof(flow_pane) / 4, NULL);
    rg_set_items(flow->panes, flow->pane_count, 1, 1);
    rg_add_state(i, flow->water, "water", row, FLOW_MARGIN);
    rg_add_state(i, rg_add_buf(i, "ledger", FLOW_LEDGER_WORDS, NULL), "ledger", 0, 0);
    if (!keeps_directions(i))
        return;
    flow->kept = rg_add_buf(i, "kept", texels, NULL);
    flow->heading = rg_add_buf(i, "heading", texels, NULL);
    rg_add_state(i, flow->kept, "directions", row, FLOW_MARGIN);
}

static void add_map(struct flow *flow, const char *name, float *values, int64_t count)
{
    flow->base.has_failed |= !values;
    rg_add_buf(&flow->base, name, count, values);
    free(values);
}

// Adds maps of the lattice over all panes, and the texels' other properties than water.
static void add_sliding(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    const struct flow_sizes most = flow_most_sizes(flow);
    const int64_t texels = most.texels, all = most.cells, rows = most.rows;
    rg_add_buf(i, "level", all, NULL);
    rg_add_buf(i, "close", all, NULL);
    rg_add_buf(i, "wide", all, NULL);
    flow->pace = rg_add_buf(i, "pace", all, NULL);
    flow->paces = rg_add_buf(i, "paces", all, NULL);
    rg_add_buf(i, "mean", all, NULL);
    rg_add_buf(i, "ridge", all, NULL);
    rg_add_buf(i, "close_rows", rows, NULL);
    rg_add_buf(i, "ridge_rows", rows, NULL);
    rg_add_buf(i, "pull", texels, NULL);
    rg_add_buf(i, "wet_rows", texels, NULL);
    rg_add_buf(i, "wet", texels, NULL);
    rg_add_buf(i, "paced", texels, NULL);
    rg_add_buf(i, "beads", 2 * (int64_t)flow->finest_px * flow->finest_px, NULL);
    flow_open_landing(flow);
    const struct flow_held held = flow_held_of(&flow->settings);
    rg_tell(i, "held_mm3", held.mm3);
    rg_tell(i, "receding_deg", held.receding_deg);
    flow->ways = rg_add_buf(i, "ways", 2 * FLOW_PACES * FLOW_MAX_PANES, NULL);
}

static void add_maps(struct flow *flow)
{
    add_map(flow, "remainder", flow_remainder_map(&flow->settings), FLOW_REMAINDER_ENTRIES);
    float *noise = flow_noise_map(&flow->settings, &flow->noise_size);
    add_map(flow, "noise", noise, (int64_t)flow->noise_size * flow->noise_size);
}

// --- images ---

static void add_environment(struct flow *flow)
{
    const struct flow_settings *s = &flow->settings;
    scenery_add_environment(&flow->base,
                            &(struct scenery_around){s->environment, s->environment_px,
                                                     flow_environment_levels(s), .blur_rad = 0});
}

static flow_glow_params glow_of(const struct rg_image_desc *from, int step_x, int step_y,
                                const struct flow_settings *s)
{
    return (flow_glow_params){.threshold = (float)s->glow_threshold,
                              .strength = (float)s->glow,
                              .step_x = step_x,
                              .step_y = step_y,
                              .last_x = from->width - 1,
                              .last_y = from->height - 1};
}

// Adds the image before the glow, and the glow at a quarter of the size.
static void add_glow(struct flow *flow)
{
    const struct rg_image_desc *target = &flow->base.target->desc;
    const struct rg_image_desc small = {
        .width = (target->width + FLOW_GLOW_REDUCTION - 1) / FLOW_GLOW_REDUCTION,
        .height = (target->height + FLOW_GLOW_REDUCTION - 1) / FLOW_GLOW_REDUCTION};
    rg_add_image(&flow->base, "lit", RG_RGBA16F, target->width, target->height);
    rg_add_image(&flow->base, "bright", RG_RGBA16F, small.width, small.height);
    rg_add_image(&flow->base, "spread", RG_RGBA16F, small.width, small.height);
    flow->glow = glow_of(target, 0, 0, &flow->settings);
    flow->glow_across = glow_of(&small, 1, 0, &flow->settings);
    flow->glow_down = glow_of(&small, 0, 1, &flow->settings);
}

// Adds the pictures that water refracts: for far panes the surroundings of the box, for near ones
// also the model.
static void add_behind(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    const struct rg_image_desc *target = &i->target->desc;
    const struct rg_asset *around =
        rg_add_image(i, "around", RG_RGBA16F, target->width, target->height);
    if (has_model(i))
        rg_add_image(i, "behind", RG_RGBA16F, target->width, target->height);
    else
        rg_lend_image(i, "behind", around ? around->image : NULL);
}

static void add_images(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    const struct rg_image_desc *target = &i->target->desc;
    add_environment(flow);
    if (is_final(i))
        add_behind(flow);
    if (is_glass(i))
        rg_add_image(i, "depth", RG_D32F, target->width, target->height);
    if (has_glow(i))
        add_glow(flow);
    const struct rg_asset *canvas = rg_asset_find(i, has_glow(i) ? "lit" : "target");
    rg_lend_image(i, "canvas", canvas ? canvas->image : NULL);
}

// --- the model ---

static void add_mesh(struct flow *flow, const struct rg_mesh *mesh)
{
    struct rg_instance *i = &flow->base;
    uint32_t *normals = rg_mesh_pack_normals(mesh);
    i->has_failed |= !normals;
    rg_add_buf(i, "positions", 3 * (int64_t)mesh->vertex_count, mesh->positions);
    rg_add_buf(i, "model_normals", mesh->vertex_count, normals);
    rg_set_items(rg_add_buf(i, "indices", 3 * (int64_t)mesh->face_count, mesh->indices),
                 mesh->face_count, 1, 1);
    free(normals);
    flow->model_faces = mesh->face_count;
    memcpy(flow->model_low, mesh->low, sizeof(mesh->low));
    memcpy(flow->model_high, mesh->high, sizeof(mesh->high));
}

static void add_model(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    const int corners_a_pane = 4;
    if (!has_model(i)) {
        rg_tell(i, "vertices", flow->pane_count * corners_a_pane);
        rg_tell(i, "faces", flow->pane_count);
        return;
    }
    struct rg_mesh *mesh = rg_mesh_load_faces(flow->settings.model, flow->settings.model_faces);
    i->has_failed |= !mesh;
    if (!mesh)
        return;
    rg_tell_text(i, "model", "%s, XXH3 %016" PRIx64, mesh->name, mesh->hash);
    rg_tell(i, "vertices", mesh->vertex_count);
    rg_tell(i, "faces", mesh->face_count);
    add_mesh(flow, mesh);
    rg_mesh_destroy(mesh);
}

// --- opening ---

bool flow_open(struct rg_instance *instance)
{
    struct flow *flow = (struct flow *)instance;
    const struct flow_settings *s = &flow->settings;
    flow->rain = flow_rain_of(s);
    if (!flow_rain_fits(&flow->rain))
        return false;
    flow->pane_count = flow_pane_count(s);
    flow_open_detail(flow);
    rg_add_counters(instance, counter_names,
                    has_model(instance) ? FLOW_COUNTER_COUNT : FLOW_TRIANGLES);
    add_water(flow);
    add_maps(flow);
    rg_tell(instance, "pane_rain_mm_h", flow->rain.mm_h);
    if (is_sliding(instance))
        add_sliding(flow);
    if (s->texels_a_pixel > 0)
        flow->texels = rg_tell(instance, "texels", s->resolution_px);
    flow_use_detail(flow);
    add_images(flow);
    add_model(flow);
    if (s->survey)
        flow_add_survey(flow);
    if (rg_open_stages(instance, stages, FLOW_PASS_COUNT, flow, NULL) < 0 ||
        !flow_write_beads(flow))
        return false;
    if (s->model_sides == FLOW_BOTH_SIDES)
        instance->stages[FLOW_MODEL].row.cull = RG_CULL_NONE;
    return is_paper(instance) ? flow_splat_drops(flow, -1, s->drops) : flow_land_initial(flow);
}

void flow_close(struct rg_instance *instance)
{
    free(((struct flow *)instance)->landing_words);
    free(((struct flow *)instance)->landing_mm);
}
