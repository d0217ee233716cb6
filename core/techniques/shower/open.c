// Opens shower on a device: its scene, particles and stages.
#include <inttypes.h>
#include <math.h>

#include "core/base/log.h"
#include "core/techniques/shower/instance.h"
#include "kernels/dialect/image/format.h"

static const char *const counter_names[SHOWER_COUNTERS] = {
    "particles_born",    "particles_died",   "particles_promoted",
    "particles_crossed", "particles_placed", "particles_drawn"};

void shower_close(struct rg_instance *instance)
{
    struct shower *s = (struct shower *)instance;
    rg_scan_destroy(s->scan);
    shower_heap_close(s->heap);
    scenery_lights_close(s->lights);
    scenery_close(s->scene);
}

// --- the scene ---

static bool create_scene(struct shower *s)
{
    const struct shower_settings *set = &s->settings;
    if (!set->geometry)
        return true;
    const struct scenery_settings settings =
        scenery_named(set->scene, (enum city_size)set->city, set->city_seed);
    s->scene = scenery_open(&s->base, &settings);
    if (!s->scene)
        return false;
    struct scenery_lights_settings lights = {.count = 1,
                                             .time = SCENERY_DAY,
                                             .shadows = set->shadows,
                                             .shadow_map_px = set->shadow_map_px};
    for (int i = 0; i < 4; i++)
        lights.world_to_frame[5 * i] = 1;
    s->lights = scenery_lit(s->scene, s->base.device, &lights, &s->camera);
    return s->lights;
}

// --- particles ---

// The slots for the most particles that eq. 1 can ask for; promotion keeps exactly the expected
// number.
static int64_t slots_of(const struct shower_settings *s)
{
    const double most = 1 + (shower_is_new(s, s->renewal) ? 0 : s->variation);
    const int64_t slots = (int64_t)ceil(s->particles * most);
    return slots ? slots : 1;
}

// The bytes of particles on the device, and with renewal=heap on the host too.
static int64_t bytes_of(const struct shower_settings *s, int64_t slots)
{
    const int64_t words = SHOWER_WORDS + (shower_is_new(s, s->state) ? 0 : SHOWER_ATTRIBUTES) +
                          (shower_is_new(s, s->renewal) ? 1 : 2);
    // For each particle a pointer, an allocation, and the copy for the device.
    const int64_t on_host = s->renewal == SHOWER_HEAP ? 8 + 64 + 4 * words : 0;
    return slots * (4 * words + on_host);
}

static bool fits(const struct shower_settings *s)
{
    const int64_t slots = slots_of(s), bytes = bytes_of(s, slots);
    return bytes <= s->memory_mb * INT64_C(1000000) ||
           rg_unsupported("particles: %" PRId64 " of them take %.0f MB, more than memory_mb=%d; "
                          "lower particles, or allow more",
                          slots, (double)bytes / 1e6, s->memory_mb);
}

static void set_params(struct shower *s)
{
    const struct shower_settings *set = &s->settings;
    shower_params *p = &s->params;
    p->slots = (int)slots_of(set);
    p->seed = (uint32_t)set->seed;
    p->step_s = (float)set->step_s;
    p->is_full = !shower_is_new(set, set->state);
    p->accelerates = !shower_is_new(set, set->motion);
    p->is_promoted = shower_is_new(set, set->renewal);
    p->is_layered = shower_is_new(set, set->layers);
    p->fall_m_s = (float)set->fall_m_s;
    p->gravity_m_s2 = (float)set->gravity_m_s2;
    p->height_m = (float)set->drop_height_m;
    p->width_m = (float)set->drop_width_m;
}

// Whether births take their slots from a free list.
static bool has_free_list(const struct shower *s)
{
    return !s->params.is_promoted && s->settings.renewal != SHOWER_HEAP;
}

static bool add_particles(struct shower *s)
{
    struct rg_instance *i = &s->base;
    const int64_t slots = s->params.slots;
    s->particles = rg_add_buf(i, "particles", SHOWER_WORDS * slots, NULL);
    s->attributes =
        rg_add_buf(i, "attributes", s->params.is_full ? SHOWER_ATTRIBUTES * slots : 1, NULL);
    s->marks = rg_add_buf(i, "marks", slots, NULL);
    s->unused = rg_add_buf(i, "unused", has_free_list(s) ? slots : 1, NULL);
    s->found = rg_add_buf(i, "found", 1, NULL);
    s->counts = rg_add_buf(i, "tally", SHOWER_TALLY, NULL);
    rg_add_state(i, s->particles, "particles", s->params.slots, 0);
    if (s->params.is_full)
        rg_add_state(i, s->attributes, "attributes", s->params.slots, 0);
    rg_add_state(i, s->counts, "tally", 0, 0);
    rg_add_counters(i, counter_names, SHOWER_COUNTERS);
    if (i->has_failed)
        return false;
    if (s->settings.renewal == SHOWER_HEAP)
        return (s->heap = shower_heap_open(s, rg_asset_find(i, "heights")->image));
    return !has_free_list(s) || (s->scan = rg_scan_create(i->device, s->params.slots));
}

// --- the drop's texture ---

// How much a drop hides at a point of its picture, 0 to 1: most along its middle, nothing at its
// rims.
static double thickness(double u, double v)
{
    const double across = 1 - pow(2 * u - 1, 2), along = 1 - pow(2 * v - 1, 4);
    return across * along;
}

enum { TEXTURE_WIDTH = 16, TEXTURE_HEIGHT = 64 };

static bool add_texture(struct shower *s)
{
    uint16_t texels[TEXTURE_HEIGHT][TEXTURE_WIDTH];
    double sum = 0;
    for (int y = 0; y < TEXTURE_HEIGHT; y++)
        for (int x = 0; x < TEXTURE_WIDTH; x++) {
            const double value = thickness((x + 0.5) / TEXTURE_WIDTH, (y + 0.5) / TEXTURE_HEIGHT);
            texels[y][x] = (uint16_t)rg_pack_half((float)value);
            sum += value;
        }
    s->view.mean = (float)(sum / (TEXTURE_WIDTH * TEXTURE_HEIGHT));
    const struct rg_asset *drop =
        rg_add_image(&s->base, "drop", RG_R16F, TEXTURE_WIDTH, TEXTURE_HEIGHT);
    return drop && rg_image_write(drop->image, 0, 0, texels);
}

// --- stages ---

#define AT(field) offsetof(struct shower, field)
#define MOVE      .params = AT(params), .over = "marks"
#define RAIN      .params = AT(view), .over = "marks", .colour = RG_LAYER, .blend = RG_BLEND_OVER

static bool open_stages(struct shower *s)
{
    static const char *const moves[2][2] = {
        {"shower_move_compact_point", "shower_move_compact_body"},
        {"shower_move_full_point", "shower_move_full_body"},
    };
    const struct shower_settings *set = &s->settings;
    const bool is_heap = set->renewal == SHOWER_HEAP, are_segments = shower_is_new(set, set->shape);
    const char *depth = s->scene ? "depth" : NULL;
    const enum rg_depth_mode mode = s->scene ? RG_DEPTH_TEST : RG_DEPTH_OFF;
    const struct rg_stage stages[SHOWER_STAGES] = {
        [SHOWER_RUN_MOVE] = {is_heap ? NULL
                                     : moves[s->params.is_full][!shower_is_new(set, set->crop)],
                             MOVE},
        [SHOWER_RUN_BEAR] = {has_free_list(s) ? "shower_bear" : NULL, MOVE},
        [SHOWER_RUN_PROMOTE] = {s->params.is_promoted ? "shower_promote" : NULL,
                                .params = AT(params)},
        [SHOWER_RUN_SEGMENTS] = {are_segments ? "shower_segments" : NULL, RAIN, .depth = depth,
                                 .depth_mode = mode},
        [SHOWER_RUN_QUADS] = {are_segments ? NULL : "shower_quads", RAIN, .depth = depth,
                              .depth_mode = mode},
    };
    s->first_stage = rg_open_stages(&s->base, stages, SHOWER_STAGES, s, NULL);
    return s->first_stage >= 0;
}

static void tell(struct shower *s)
{
    const struct shower_settings *set = &s->settings;
    rg_tell(&s->base, "particle_bytes",
            (double)bytes_of(set, s->params.slots) / (double)s->params.slots);
    rg_tell(&s->base, "d_max_m", (double)s->params.far_m);
    if (s->scene)
        rg_tell_text(&s->base, "scene_hash", "%016" PRIx64, scenery_city(s->scene)->hash);
}

bool shower_open(struct rg_instance *instance)
{
    struct shower *s = (struct shower *)instance;
    if (!shower_look(s, 0) || !fits(&s->settings) || !create_scene(s))
        return false;
    set_params(s);
    if (s->scene)
        rg_add_image(instance, "depth", RG_D32F, instance->target->desc.width,
                     instance->target->desc.height);
    if (!shower_add_heights(s) || !add_particles(s) || !add_texture(s) ||
        !rg_layer_open(&s->layer, instance) || !open_stages(s))
        return false;
    tell(s);
    return true;
}
