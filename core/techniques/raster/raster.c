// raster: drawing itself as the thing measured, so that rasterisers can be compared: rain as
// billboards, a model, a million tiny triangles, panes of all sizes. Programs are in
// kernels/raster_*.h, what the host computes in shapes.c and view.c, and
// docs/raster.md explains.
#include "core/techniques/raster/raster.h"

#include <stdio.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/techniques/technique.h"

// What a scene is drawn with, and how where the settings leave it to the scene.
static const struct scene {
    const char *program;
    enum rg_blend blend;
    enum rg_depth_mode depth;
    enum rg_cull cull; // of a closed mesh seen from outside
} scenes[RASTER_SCENES] = {
    [RASTER_BILLBOARDS] = {"raster_streaks", RG_BLEND_OVER, RG_DEPTH_OFF, RG_CULL_NONE},
    [RASTER_MESH] = {"raster_mesh", RG_BLEND_OFF, RG_DEPTH_WRITE, RG_CULL_BACK},
    [RASTER_TRIANGLES] = {"raster_mesh", RG_BLEND_OFF, RG_DEPTH_WRITE, RG_CULL_BACK},
    [RASTER_QUADS] = {"raster_quads", RG_BLEND_OVER, RG_DEPTH_OFF, RG_CULL_NONE},
};

enum raster_counter { ITEMS, ITEMS_SEEN, SAMPLES, COUNTER_COUNT };

static const char *const counter_names[COUNTER_COUNT] = {"items", "items_seen", "samples"};

enum { MAX_SLOTS = 3 };

struct raster {
    struct rg_instance base;
    struct raster_settings settings;
    int item_count, drawn_items; // of the scene, and those that the share leaves
    struct raster_shape shape;   // its bounds; the arrays are on the device
    struct rg_pass *program, *show;
    struct rg_buf *slots[MAX_SLOTS]; // what the program reads, from slot 1 on
    struct rg_image *colour;         // drawn to: the target, or one of another format
    struct rg_image *depth;
    // where items are counted
    struct rg_image *counted;
    struct rg_buf *samples;
    uint32_t *counts;
};

static void raster_destroy(struct rg_instance *instance)
{
    struct raster *r = (struct raster *)instance;
    rg_pass_destroy(r->program);
    rg_pass_destroy(r->show);
    for (int i = 0; i < MAX_SLOTS; i++)
        rg_buf_destroy(r->slots[i]);
    rg_buf_destroy(r->samples);
    if (r->colour != r->base.target)
        rg_image_destroy(r->colour);
    rg_image_destroy(r->base.target);
    rg_image_destroy(r->depth);
    rg_image_destroy(r->counted);
    raster_shape_free(&r->shape);
    free(r->counts);
    free(r);
}

// --- opening ---

static bool upload(struct raster *r, int slot, const void *data, int64_t words, const char *name)
{
    struct rg_buf *buf = r->slots[slot - 1] = rg_buf_create(r->base.device, words * 4, name);
    return buf && (!data || rg_buf_write(buf, 0, data, words * 4));
}

static bool create_mesh(struct raster *r)
{
    struct raster_shape *shape = &r->shape;
    const bool ok = r->settings.scene == RASTER_MESH
                        ? raster_shape_load(&r->settings, shape)
                        : raster_shape_knot(r->settings.triangles, shape);
    r->item_count = shape->face_count;
    return ok && upload(r, 1, shape->positions, 3 * (int64_t)shape->vertex_count, "positions") &&
           upload(r, 2, shape->normals, shape->vertex_count, "normals") &&
           upload(r, 3, shape->indices, 3 * (int64_t)shape->face_count, "indices");
}

static bool create_quads(struct raster *r)
{
    float *quads = raster_quads_make(&r->settings);
    r->item_count = r->settings.quads;
    const bool ok =
        quads && upload(r, 1, quads, (int64_t)r->item_count * RASTER_QUAD_WORDS, "quads");
    free(quads);
    return ok;
}

static bool create_drops(struct raster *r)
{
    const raster_drops_params p = {.count = r->settings.billboards, .seed = r->settings.seed};
    r->item_count = p.count;
    if (!upload(r, 1, NULL, 3 * (int64_t)p.count, "drops"))
        return false;
    struct rg_pass *scatter = rg_pass_create(r->base.device, "raster_drops");
    const bool ok =
        scatter && rg_pass_run(scatter, &(struct rg_run){.params = &p,
                                                         .slots = {[1].buf = r->slots[0]},
                                                         .extent = {p.count, 1, 1}});
    rg_pass_destroy(scatter);
    return ok;
}

static bool create_scene(struct raster *r)
{
    const int scene = r->settings.scene;
    r->program = rg_pass_create(r->base.device, scenes[scene].program);
    const bool ok = r->program && (scene == RASTER_BILLBOARDS ? create_drops(r)
                                   : scene == RASTER_QUADS    ? create_quads(r)
                                                              : create_mesh(r));
    r->drawn_items = (int)(r->item_count * r->settings.share + 0.5);
    return ok;
}

static struct rg_image *create_image(struct raster *r, enum rg_format format, int width, int height,
                                     const char *name)
{
    return rg_image_create(r->base.device, &(struct rg_image_desc){format, width, height, 1, 1},
                           name);
}

static bool create_targets(struct raster *r, int width, int height)
{
    const int format = r->settings.format;
    if (!(r->base.target = create_image(r, RG_RGBA16F, width, height, "target")) ||
        !(r->depth = create_image(r, RG_D32F, width, height, "depth")))
        return false;
    r->colour = r->base.target;
    if (format == RASTER_RGBA16F)
        return true;
    const bool is_8 = format == RASTER_RGBA8;
    r->colour = create_image(r, is_8 ? RG_RGBA8 : RG_RGBA32F, width, height, "drawing");
    r->show = rg_pass_create(r->base.device, is_8 ? "raster_show_rgba8" : "raster_show_rgba32f");
    return r->colour && r->show;
}

static bool create_counting(struct raster *r, int width, int height)
{
    if (!r->settings.count)
        return true;
    return (r->counted = create_image(r, RG_D32F, width, height, "counted")) &&
           (r->samples = rg_buf_create(r->base.device, (int64_t)r->item_count * 4, "samples")) &&
           (r->counts = rg_alloc((size_t)r->item_count, sizeof(*r->counts), "samples"));
}

static void show_facts(struct raster *r)
{
    struct rg_fact *facts = r->base.facts;
    if (!r->shape.face_count)
        return;
    facts[0] = (struct rg_fact){.name = "model"};
    snprintf(facts[0].text, RG_FACT_SIZE, "%.*s", RG_FACT_SIZE - 1, r->shape.name);
    facts[1] = (struct rg_fact){.name = "faces", .number = r->shape.face_count};
    facts[2] = (struct rg_fact){.name = "model_hash"};
    snprintf(facts[2].text, RG_FACT_SIZE, "%016llx", (unsigned long long)r->shape.hash);
    r->base.fact_count = r->shape.hash ? 3 : 2;
}

static void show_state(struct raster *r)
{
    r->base.counter_count = r->settings.count ? COUNTER_COUNT : ITEMS + 1;
    for (int i = 0; i < COUNTER_COUNT; i++)
        r->base.counters[i].name = counter_names[i];
    if (r->settings.scene != RASTER_BILLBOARDS)
        return;
    r->base.state_count = 1;
    r->base.state[0] = (struct rg_state){
        .name = "drops", .buf = r->slots[0], .is_float = true, .row = r->item_count};
}

static struct rg_instance *raster_create(struct rg_device *device, const void *settings, int width,
                                         int height)
{
    struct raster *r = rg_alloc(1, sizeof(*r), "raster");
    if (!r)
        return NULL;
    r->base.technique = rg_technique_find("raster");
    r->base.device = device;
    r->settings = *(const struct raster_settings *)settings;
    if (!create_scene(r) || !create_targets(r, width, height) ||
        !create_counting(r, width, height)) {
        raster_destroy(&r->base);
        return NULL;
    }
    show_facts(r);
    show_state(r);
    return &r->base;
}

// --- a frame ---

static bool raster_step(struct rg_instance *instance)
{
    instance->frame++;
    return true;
}

// A value that the settings may leave to the scene: 0 does, 1 is the first of the enum.
static int choose(int setting, int of_scene)
{
    return setting ? setting - 1 : of_scene;
}

static struct rg_draw draw_of(const struct raster *r)
{
    const struct raster_settings *s = &r->settings;
    const struct scene *scene = &scenes[s->scene];
    const bool looks_out = scene->cull == RG_CULL_BACK && s->inside;
    struct rg_draw draw = {
        .colour = r->colour,
        .blend = (enum rg_blend)choose(s->blend, (int)scene->blend),
        .depth_mode = (enum rg_depth_mode)choose(s->depth, (int)scene->depth),
        .cull = (enum rg_cull)choose(s->cull, looks_out ? RG_CULL_FRONT : (int)scene->cull),
    };
    if (draw.depth_mode != RG_DEPTH_OFF)
        draw.depth = r->depth;
    return draw;
}

static bool clear(struct raster *r)
{
    static const float background[4] = {0.0625f, 0.078125f, 0.109375f, 1};
    static const uint8_t codes[4] = {16, 20, 28, 255};
    static const uint16_t halves[4] = {0x2c00, 0x2d00, 0x2f00, 0x3c00}; // the same
    static const float farthest = 1;
    const void *texel = r->settings.format == RASTER_RGBA32F ? (const void *)background
                        : r->settings.format == RASTER_RGBA8 ? (const void *)codes
                                                             : (const void *)halves;
    return rg_image_clear(r->colour, texel) && rg_image_clear(r->depth, &farthest);
}

// All parameters that a program may have.
union params {
    raster_streaks_params streaks;
    raster_mesh_params mesh;
    raster_quads_params quads;
};

static bool fill_params(const struct raster *r, union params *p)
{
    const struct raster_settings *s = &r->settings;
    const int width = r->base.target->desc.width, height = r->base.target->desc.height;
    if (s->scene == RASTER_BILLBOARDS)
        p->streaks = raster_streaks_at(s, width, height, r->base.frame);
    else if (s->scene == RASTER_QUADS)
        p->quads = raster_quads_at(s, width, height, r->base.frame);
    else
        return raster_mesh_at(s, &r->shape, width, height, r->base.frame, &p->mesh);
    return true;
}

static bool draw_items(struct raster *r, const struct rg_draw *draw)
{
    union params params;
    if (!fill_params(r, &params))
        return false;
    struct rg_run run = {.params = &params, .extent = {r->drawn_items, 1, 1}, .draw = draw};
    for (int i = 0; i < MAX_SLOTS; i++)
        run.slots[i + 1].buf = r->slots[i];
    return !r->drawn_items || rg_instance_run(&r->base, r->program, &run);
}

// Draws once more, into a depth that nothing is tested against, and reads what each item covers.
static bool count_items(struct raster *r)
{
    const int64_t bytes = (int64_t)r->item_count * 4;
    struct rg_draw draw = {.depth = r->counted, .cull = draw_of(r).cull, .samples = r->samples};
    memset(r->counts, 0, (size_t)bytes);
    if (!rg_buf_write(r->samples, 0, r->counts, bytes) || !draw_items(r, &draw) ||
        !rg_buf_read(r->samples, 0, r->counts, bytes))
        return false;
    for (int i = 0; i < r->item_count; i++) {
        r->base.counters[ITEMS_SEEN].value += r->counts[i] > 0;
        r->base.counters[SAMPLES].value += r->counts[i];
    }
    return true;
}

static bool show(struct raster *r)
{
    const raster_show_params p = {.layer = 0};
    const struct rg_image_desc *desc = &r->base.target->desc;
    return !r->show ||
           rg_instance_run(
               &r->base, r->show,
               &(struct rg_run){.params = &p,
                                .slots = {[1].image = r->colour, [2].image = r->base.target},
                                .extent = {desc->width, desc->height, 1}});
}

static bool raster_draw(struct rg_instance *instance)
{
    struct raster *r = (struct raster *)instance;
    const struct rg_draw draw = draw_of(r);
    instance->counters[ITEMS].value += r->drawn_items;
    return clear(r) && draw_items(r, &draw) && (!r->settings.count || count_items(r)) && show(r);
}

const struct rg_technique rg_technique_raster = {
    .name = "raster",
    .paper = "",
    .about = "drawing itself: rain as billboards, models, a million triangles, overlapping panes",
    .params = &raster_param_table,
    .proof = &raster_proof,
    .create = raster_create,
    .destroy = raster_destroy,
    .step = raster_step,
    .draw = raster_draw,
};
