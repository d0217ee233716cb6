// The rain's assets and stages.
#include <math.h>
#include <string.h>

#include "core/base/log.h"
#include "core/techniques/cartoon/rain/rain.h"

#define PARAMS .params = offsetof(struct cartoon_rain, params)

// The tessellation of a query's sphere (kernels/cartoon/rain/hit/spheres.h).
enum { SLICES = 6, STACKS = 4, FACETS = SLICES * STACKS };
enum { ITEMS_A_QUERY = 32 }; // at least FACETS, and a number that struct rg_draw allows

#define OVER_SCENE                                                                                 \
    .colour = RG_LAYER, .depth = "depth_map", .depth_mode = RG_DEPTH_TEST, .blend = RG_BLEND_OVER

static const struct rg_stage stages[CARTOON_RAIN_STAGES] = {
    [CARTOON_RAIN_FREE] = {"cartoon_free", PARAMS},
    [CARTOON_RAIN_LIST] = {"cartoon_list", PARAMS},
    [CARTOON_RAIN_RELEASE] = {"cartoon_release", PARAMS},
    [CARTOON_RAIN_MOVE] = {"cartoon_move", PARAMS},
    [CARTOON_RAIN_AGE] = {"cartoon_age", PARAMS},
    [CARTOON_RAIN_COUNT] = {"cartoon_count", PARAMS},
    [CARTOON_RAIN_SPHERES] = {"cartoon_spheres", PARAMS, .depth = "depth_map",
                              .depth_mode = RG_DEPTH_TEST, .cull = RG_CULL_BACK,
                              .samples = "facet_samples"},
    [CARTOON_RAIN_SUM] = {"cartoon_sum", PARAMS},
    [CARTOON_RAIN_KEEP] = {"cartoon_keep", PARAMS},
    [CARTOON_RAIN_COLLIDE] = {"cartoon_collide", PARAMS},
    [CARTOON_RAIN_SPLASH] = {"cartoon_splash", PARAMS},
    [CARTOON_RAIN_DROPS] = {"cartoon_drops", PARAMS, OVER_SCENE},
    [CARTOON_RAIN_SPLASHES] = {"cartoon_splashes", PARAMS, OVER_SCENE},
};

// Adds a unit sphere: rings from the lower pole to the upper one; the first and the last ring are
// single points.
static void add_sphere(struct cartoon_rain *r)
{
    float corners[(STACKS + 1) * SLICES][3];
    for (int i = 0; i < (STACKS + 1) * SLICES; i++) {
        const double rise = M_PI * (i / SLICES) / STACKS - M_PI / 2;
        const double turn = 2 * M_PI * (i % SLICES) / SLICES;
        corners[i][0] = (float)(cos(rise) * sin(turn));
        corners[i][1] = (float)sin(rise);
        corners[i][2] = (float)(cos(rise) * cos(turn));
    }
    rg_add_buf(r->instance, "sphere", 3 * (STACKS + 1) * SLICES, corners);
}

static void add_particles(struct cartoon_rain *r)
{
    struct rg_instance *i = r->instance;
    const int64_t drops = r->params.drop_slots, sprays = r->params.spray_slots;
    const int drop_words = sizeof(cartoon_raindrop) / 4, spray_words = sizeof(cartoon_spray) / 4;
    r->raindrops = rg_add_buf(i, "raindrops", drops * drop_words, NULL);
    r->sprays = rg_add_buf(i, "sprays", sprays * spray_words, NULL);
    r->tally = rg_add_buf(i, "tally", CARTOON_TALLY, NULL);
    r->flags = rg_add_buf(i, "flags", drops + sprays, NULL);
    r->before = rg_add_buf(i, "before", drops + sprays + 1, NULL);
    rg_add_buf(i, "unused", drops + sprays, NULL);
    rg_add_buf(i, "living", drops + sprays, NULL);
    r->counts = rg_add_buf(i, "counts", drops, NULL);
    r->hits = rg_add_buf(i, "hits", drops, NULL);
    r->hits_before = rg_add_buf(i, "hits_before", drops + 1, NULL);
    rg_add_buf(i, "surfaces", drops * (int64_t)(sizeof(cartoon_surface) / 4), NULL);
    rg_add_state(i, r->raindrops, "raindrops", drop_words, 0);
    rg_add_state(i, r->sprays, "sprays", spray_words, 0);
    rg_add_state(i, r->tally, "tally", 0, 0);
}

static bool allow_queries(const struct rg_device *device)
{
    return device->info.limits.has_queries ||
           rg_unsupported("query=api: %s has no occlusion queries of its own; set query=spheres, "
                          "which counts the same samples, or take gl or vulkan",
                          device->info.name);
}

// Adds the stage that counts the samples of each drop's sphere, by fragments or by the API's
// queries.
static void ask_with_spheres(struct cartoon_rain *r, struct rg_stage *rows)
{
    rows[CARTOON_RAIN_COUNT].kernel = NULL;
    add_sphere(r);
    r->params.facets = FACETS;
    if (r->settings->query == CARTOON_QUERY_SPHERES) {
        rg_add_buf(r->instance, "facet_samples", (int64_t)r->params.drop_slots * FACETS, NULL);
        return;
    }
    r->params.facets = ITEMS_A_QUERY;
    rows[CARTOON_RAIN_SPHERES].samples = "counts";
    rows[CARTOON_RAIN_SPHERES].items_a_query = ITEMS_A_QUERY;
    rows[CARTOON_RAIN_SUM].kernel = NULL;
}

// Adds late answers to the state, since they outlive a step.
static void keep_answers(struct cartoon_rain *r, struct rg_stage *rows)
{
    if (!r->params.late) {
        rows[CARTOON_RAIN_KEEP].kernel = NULL;
        rg_lend_buf(r->instance, "answers", r->counts->buf);
        return;
    }
    struct rg_asset *answers = rg_add_buf(r->instance, "answers", r->params.drop_slots, NULL);
    rg_add_state(r->instance, answers, "answers", 0, 0);
}

// Counts use discs or spheres, or are not taken.
static bool open_stages(struct cartoon_rain *r)
{
    struct rg_stage rows[CARTOON_RAIN_STAGES];
    const struct cartoon_rain_settings *s = r->settings;
    const bool asks = s->collide != CARTOON_COLLIDE_CORRECT;
    memcpy(rows, stages, sizeof(rows));
    if (asks && s->query == CARTOON_QUERY_API && !allow_queries(r->instance->device))
        return false;
    if (asks && s->query != CARTOON_QUERY_DISCS)
        ask_with_spheres(r, rows);
    else
        rows[CARTOON_RAIN_SPHERES].kernel = rows[CARTOON_RAIN_SUM].kernel = NULL;
    if (!asks)
        rows[CARTOON_RAIN_COUNT].kernel = NULL;
    r->params.late = asks && s->answers == CARTOON_ANSWERS_LATE;
    keep_answers(r, rows);
    r->first_stage = rg_open_stages(r->instance, rows, CARTOON_RAIN_STAGES, r, NULL);
    return r->first_stage >= 0;
}

bool cartoon_rain_open(struct cartoon_rain *r, struct rg_instance *instance,
                       const struct cartoon_rain_settings *settings, int seed,
                       const struct cartoon_rain_scene *scene)
{
    static const char *const counter_names[] = {"drops_asked"};
    r->instance = instance;
    r->settings = settings;
    r->scene = *scene;
    if (!cartoon_rain_fill(r, seed))
        return false;
    rg_add_counters(instance, counter_names, CARTOON_RAIN_COUNTERS);
    add_particles(r);
    r->params.textures = cartoon_add_textures(instance);
    cartoon_rain_refill(r);
    if (!open_stages(r))
        return false;
    r->scan = rg_scan_create(instance->device, r->params.drop_slots + r->params.spray_slots);
    return r->scan;
}

void cartoon_rain_close(struct cartoon_rain *r)
{
    rg_scan_destroy(r->scan);
}
