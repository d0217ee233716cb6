// raster: drawing itself as the thing measured, to compare rasterisers: rain as billboards, a
// model, a million tiny triangles, panes of all sizes. kernels/raster/ has the programs, meshes.c
// and view.c the host's computations, and docs/raster.md explains.
#include "core/techniques/raster/raster.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/techniques/technique.h"

// A scene's program, and its default way of drawing.
static const struct scene {
    const char *program;
    enum rg_blend blend;
    enum rg_depth_mode depth;
    enum rg_cull cull; // for a closed mesh seen from outside
} scenes[RASTER_SCENES] = {
    [RASTER_BILLBOARDS] = {"raster_streaks", RG_BLEND_OVER, RG_DEPTH_OFF, RG_CULL_NONE},
    [RASTER_MESH] = {"raster_mesh", RG_BLEND_OFF, RG_DEPTH_WRITE, RG_CULL_BACK},
    [RASTER_TRIANGLES] = {"raster_mesh", RG_BLEND_OFF, RG_DEPTH_WRITE, RG_CULL_BACK},
    [RASTER_QUADS] = {"raster_quads", RG_BLEND_OVER, RG_DEPTH_OFF, RG_CULL_NONE},
};

enum raster_counter { ITEMS, ITEMS_SEEN, SAMPLES, COUNTER_COUNT };

static const char *const counter_names[COUNTER_COUNT] = {"items", "items_seen", "samples"};

enum raster_pass { SCATTER, DRAW, COUNT, SHOW, PASS_COUNT };

struct raster {
    struct rg_instance base;
    struct raster_settings settings;
    int item_count, drawn_items; // items of the scene, and those drawn after applying the share
    struct raster_mesh mesh;     // only its bounds; the arrays are on the device
    struct rg_image *colour;     // the image drawn to: the target, or one of another format
    uint32_t *counts;            // samples of each item, if they are counted
    // The stages' parameters at the current frame.
    raster_drops_params drops;
    raster_show_params show;
    union {
        raster_streaks_params streaks;
        raster_mesh_params mesh;
        raster_quads_params quads;
    } view;
};

static void raster_close(struct rg_instance *instance)
{
    struct raster *r = (struct raster *)instance;
    raster_mesh_free(&r->mesh);
    free(r->counts);
}

// --- opening ---

static void add_mesh(struct raster *r)
{
    struct rg_instance *i = &r->base;
    struct raster_mesh *mesh = &r->mesh;
    const bool ok = r->settings.scene == RASTER_MESH
                        ? raster_mesh_load(&r->settings, mesh)
                        : raster_mesh_knot(r->settings.triangles, mesh);
    i->has_failed |= !ok;
    r->item_count = mesh->face_count;
    rg_add_buf(i, "positions", 3 * (int64_t)mesh->vertex_count, mesh->positions);
    rg_add_buf(i, "normals", mesh->vertex_count, mesh->normals);
    rg_add_buf(i, "indices", 3 * (int64_t)mesh->face_count, mesh->indices);
}

static void add_quads(struct raster *r)
{
    float *quads = raster_quads_make(&r->settings);
    r->base.has_failed |= !quads;
    r->item_count = r->settings.quads;
    rg_add_buf(&r->base, "quads", (int64_t)r->item_count * RASTER_QUAD_WORDS, quads);
    free(quads);
}

// The stage SCATTER fills in the drops, so they start without contents.
static void add_drops(struct raster *r)
{
    r->drops = (raster_drops_params){.count = r->settings.billboards, .seed = r->settings.seed};
    r->item_count = r->drops.count;
    struct rg_asset *drops = rg_add_room(&r->base, "drops", 3 * (int64_t)r->item_count);
    rg_set_items(drops, r->item_count, 1, 1);
    rg_add_state(&r->base, drops, "drops", r->item_count, 0);
}

static void add_scene(struct raster *r)
{
    const int scene = r->settings.scene;
    if (scene == RASTER_BILLBOARDS)
        add_drops(r);
    else if (scene == RASTER_QUADS)
        add_quads(r);
    else
        add_mesh(r);
    r->drawn_items = (int)(r->item_count * r->settings.share + 0.5);
}

static void add_targets(struct raster *r)
{
    static const enum rg_format formats[] = {
        [RASTER_RGBA16F] = RG_RGBA16F, [RASTER_RGBA8] = RG_RGBA8, [RASTER_RGBA32F] = RG_RGBA32F};
    struct rg_instance *i = &r->base;
    const struct rg_image_desc *target = &i->target->desc;
    const enum rg_format format = formats[r->settings.format];
    rg_add_image(i, "depth", RG_D32F, target->width, target->height);
    const struct rg_asset *drawn =
        format == RG_RGBA16F ? rg_lend_image(i, "drawn", i->target)
                             : rg_add_image(i, "drawn", format, target->width, target->height);
    r->colour = drawn ? drawn->image : NULL;
}

static void add_counting(struct raster *r)
{
    const struct rg_image_desc *target = &r->base.target->desc;
    if (!r->settings.count)
        return;
    rg_add_image(&r->base, "counted", RG_D32F, target->width, target->height);
    rg_add_room(&r->base, "samples", r->item_count);
    r->counts = rg_alloc((size_t)r->item_count, sizeof(*r->counts), "samples");
    r->base.has_failed |= !r->counts;
}

// Resolves a setting: 0 leaves the choice to the scene, 1 is the first value of the enum.
static int choose(int setting, int of_scene)
{
    return setting ? setting - 1 : of_scene;
}

#define AT(field) offsetof(struct raster, field)

static bool open_stages(struct raster *r)
{
    const struct raster_settings *s = &r->settings;
    const struct scene *scene = &scenes[s->scene];
    const bool looks_out = scene->cull == RG_CULL_BACK && s->inside;
    const enum rg_cull cull =
        (enum rg_cull)choose(s->cull, looks_out ? RG_CULL_FRONT : (int)scene->cull);
    const enum rg_depth_mode depth = (enum rg_depth_mode)choose(s->depth, (int)scene->depth);
    const struct rg_stage stages[PASS_COUNT] = {
        [SCATTER] = {s->scene == RASTER_BILLBOARDS ? "raster_drops" : NULL, .params = AT(drops),
                     .over = "drops"},
        [DRAW] = {scene->program, .params = AT(view), .colour = "drawn",
                  .depth = depth == RG_DEPTH_OFF ? NULL : "depth", .depth_mode = depth,
                  .blend = (enum rg_blend)choose(s->blend, (int)scene->blend), .cull = cull},
        // Draws once more to count, with a depth image of its own, so that nothing is hidden.
        [COUNT] = {s->count ? scene->program : NULL, .params = AT(view), .depth = "counted",
                   .samples = "samples", .cull = cull},
        [SHOW] = {s->format == RASTER_RGBA8     ? "raster_show_rgba8"
                  : s->format == RASTER_RGBA32F ? "raster_show_rgba32f"
                                                : NULL,
                  .params = AT(show), .over = "target"},
    };
    return rg_open_stages(&r->base, stages, PASS_COUNT, r, NULL) >= 0;
}

static void tell_facts(struct raster *r)
{
    if (!r->mesh.face_count)
        return;
    rg_tell_text(&r->base, "model", "%.*s", RG_FACT_SIZE - 1, r->mesh.name);
    rg_tell(&r->base, "faces", r->mesh.face_count);
    if (r->mesh.hash)
        rg_tell_text(&r->base, "model_hash", "%016llx", (unsigned long long)r->mesh.hash);
}

static bool raster_open(struct rg_instance *instance)
{
    struct raster *r = (struct raster *)instance;
    add_scene(r);
    add_targets(r);
    add_counting(r);
    tell_facts(r);
    rg_add_counters(instance, counter_names, r->settings.count ? COUNTER_COUNT : ITEMS + 1);
    return open_stages(r) && rg_stage(instance, SCATTER);
}

// --- a frame ---

static bool raster_step(struct rg_instance *instance)
{
    instance->frame++;
    return true;
}

static bool clear(struct raster *r)
{
    static const float background[4] = {0.0625f, 0.078125f, 0.109375f, 1};
    static const uint8_t codes[4] = {16, 20, 28, 255};
    static const uint16_t halves[4] = {0x2c00, 0x2d00, 0x2f00, 0x3c00}; // the same as half floats
    static const float farthest = 1;
    const void *texel = r->settings.format == RASTER_RGBA32F ? (const void *)background
                        : r->settings.format == RASTER_RGBA8 ? (const void *)codes
                                                             : (const void *)halves;
    return rg_image_clear(r->colour, texel) &&
           rg_image_clear(rg_asset_find(&r->base, "depth")->image, &farthest);
}

static bool look(struct raster *r)
{
    const struct raster_settings *s = &r->settings;
    const int width = r->base.target->desc.width, height = r->base.target->desc.height;
    if (s->scene == RASTER_BILLBOARDS)
        r->view.streaks = raster_streaks_at(s, width, height, r->base.frame);
    else if (s->scene == RASTER_QUADS)
        r->view.quads = raster_quads_at(s, width, height, r->base.frame);
    else
        return raster_mesh_at(s, &r->mesh, width, height, r->base.frame, &r->view.mesh);
    return true;
}

static bool draw_items(struct raster *r, enum raster_pass pass)
{
    const struct rg_draw draw = rg_stage_draw(&r->base, pass);
    return !r->drawn_items || rg_stage_onto(&r->base, pass, r->drawn_items, &draw);
}

// Draws once more, and reads how many samples each item covers.
static bool count_items(struct raster *r)
{
    const int64_t bytes = (int64_t)r->item_count * 4;
    struct rg_buf *samples = rg_asset_find(&r->base, "samples")->buf;
    memset(r->counts, 0, (size_t)bytes);
    if (!rg_buf_write(samples, 0, r->counts, bytes) || !draw_items(r, COUNT) ||
        !rg_buf_read(samples, 0, r->counts, bytes))
        return false;
    for (int i = 0; i < r->item_count; i++) {
        r->base.counters[ITEMS_SEEN].value += r->counts[i] > 0;
        r->base.counters[SAMPLES].value += r->counts[i];
    }
    return true;
}

static bool raster_draw(struct rg_instance *instance)
{
    struct raster *r = (struct raster *)instance;
    instance->counters[ITEMS].value += r->drawn_items;
    return clear(r) && look(r) && draw_items(r, DRAW) && (!r->settings.count || count_items(r)) &&
           rg_stage(instance, SHOW);
}

const struct rg_technique rg_technique_raster = {
    .name = "raster",
    .paper = "",
    .about = "drawing itself: rain as billboards, models, a million triangles, overlapping panes",
    .shown = {"scene=mesh", 640, 360, 0, 1.0},
    .params = &raster_param_table,
    .proof = &raster_proof,
    .size = sizeof(struct raster),
    .settings = offsetof(struct raster, settings),
    .open = raster_open,
    .close = raster_close,
    .step = raster_step,
    .draw = raster_draw,
};
