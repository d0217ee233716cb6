// What the rain works on, and its stages.
#include <math.h>
#include <string.h>

#include "core/techniques/cartoon/rain/rain.h"

#define PARAMS .params = offsetof(struct cartoon_rain, params)

// Of the tessellated sphere of a query (kernels/cartoon/rain/hit/spheres.h).
enum { SLICES = 6, STACKS = 4, FACETS = SLICES * STACKS };

#define OVER_SCENE                                                                                 \
    .colour = "target", .depth = "depth_map", .depth_mode = RG_DEPTH_TEST, .blend = RG_BLEND_OVER

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
    [CARTOON_RAIN_COLLIDE] = {"cartoon_collide", PARAMS},
    [CARTOON_RAIN_SPLASH] = {"cartoon_splash", PARAMS},
    [CARTOON_RAIN_DROPS] = {"cartoon_drops", PARAMS, OVER_SCENE},
    [CARTOON_RAIN_SPLASHES] = {"cartoon_splashes", PARAMS, OVER_SCENE},
};

// A sphere of radius 1: rings from the lower pole to the upper one, all corners of the first and
// the last in one place.
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
    r->params.facets = FACETS;
    rg_add_buf(r->instance, "sphere", 3 * (STACKS + 1) * SLICES, corners);
    rg_add_buf(r->instance, "facet_samples", (int64_t)r->params.drop_slots * FACETS, NULL);
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
    rg_add_buf(i, "counts", drops, NULL);
    r->hits = rg_add_buf(i, "hits", drops, NULL);
    r->hits_before = rg_add_buf(i, "hits_before", drops + 1, NULL);
    rg_add_buf(i, "surfaces", drops * (int64_t)(sizeof(cartoon_surface) / 4), NULL);
    rg_add_state(i, r->raindrops, "raindrops", false, drop_words, 0);
    rg_add_state(i, r->sprays, "sprays", false, spray_words, 0);
    rg_add_state(i, r->tally, "tally", false, 0, 0);
}

// Counts come from discs, from spheres, or are not asked for.
static bool open_stages(struct cartoon_rain *r)
{
    struct rg_stage rows[CARTOON_RAIN_STAGES];
    const bool asks = r->settings->collide != CARTOON_COLLIDE_CORRECT;
    const bool spheres = asks && r->settings->query == CARTOON_QUERY_SPHERES;
    memcpy(rows, stages, sizeof(rows));
    if (!asks || spheres)
        rows[CARTOON_RAIN_COUNT].kernel = NULL;
    if (spheres)
        add_sphere(r);
    else
        rows[CARTOON_RAIN_SPHERES].kernel = rows[CARTOON_RAIN_SUM].kernel = NULL;
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
