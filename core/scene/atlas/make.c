// Makes the atlas: traces, normalises and packs every streak, and draws the splashes.
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/doing.h"
#include "core/scene/atlas/levels.h"
#include "core/scene/atlas/splash.h"
#include "core/scene/atlas/streak.h"

enum { STREAK_SETS = RG_ATLAS_OSCILLATIONS * RG_ATLAS_VIEWS };

// Divides a picture by its largest value, and returns that value; a dark picture stays unchanged.
static float normalise(float *texels, int count)
{
    float largest = 0;
    for (int i = 0; i < count; i++)
        largest = texels[i] > largest ? texels[i] : largest;
    for (int i = 0; largest > 0 && i < count; i++)
        texels[i] /= largest;
    return largest;
}

static bool put_streaks(struct rg_atlas *atlas, int oscillation, int view, struct rg_streaks *s)
{
    const int pixels = s->width * s->height, level = atlas->first_level;
    const float balance = rg_streaks_balance(s);
    for (int lobe = 0; lobe < RG_LOBE_COUNT; lobe++) {
        float *texels = s->point + (size_t)lobe * (size_t)pixels;
        const float factor = normalise(texels, pixels) * balance;
        for (int cell = 0; cell < RG_ATLAS_CELLS; cell++) {
            const int light = cell / RG_ATLAS_PHIS, phi = cell % RG_ATLAS_PHIS;
            if (rg_lobe_of_cell(light, phi) != lobe)
                continue;
            atlas->point_factor[oscillation][view][light][phi] = factor;
            if (!rg_atlas_put_cell_levels(atlas, RG_ATLAS_POINT, oscillation, view, cell, level,
                                          texels))
                return false;
        }
    }
    atlas->env_factor[oscillation][view] = normalise(s->env, pixels);
    return rg_atlas_put_cell_levels(atlas, RG_ATLAS_ENV, oscillation, view, 0, level, s->env);
}

// Fills the streaks of one oscillation and view, from the front to the steepest view: the tallest
// come first, so that threads finish together.
static bool make_streaks(struct rg_atlas *atlas, int set, const struct rg_lobes *lobes)
{
    const int oscillation = set % RG_ATLAS_OSCILLATIONS, view = set / RG_ATLAS_OSCILLATIONS;
    struct rg_streaks streaks;
    const bool made = rg_streaks_trace(oscillation, view, atlas->first_level,
                                       &rg_atlas_kinds[atlas->size].detail, lobes, &streaks) &&
                      put_streaks(atlas, oscillation, view, &streaks);
    rg_streaks_free(&streaks);
    return made;
}

static bool make_splashes(struct rg_atlas *atlas)
{
    struct rg_atlas_image *image = &atlas->images[RG_ATLAS_SPLASH];
    struct rg_splash_light lights[RG_ATLAS_MATERIALS] = {0};
    for (int layer = 0; layer < image->layers; layer++) {
        float texels[RG_SPLASH_WIDTH_PX * RG_SPLASH_HEIGHT_PX];
        const int material = layer / RG_ATLAS_FRAMES;
        if (!rg_splash_draw(rg_atlas_kinds[atlas->size].detail.swings, material,
                            layer % RG_ATLAS_FRAMES, texels, &lights[material]))
            return false;
        uint16_t *to =
            image->texels + (rg_atlas_texels(atlas, RG_ATLAS_SPLASH, layer, 0) - image->texels);
        for (int i = 0; i < RG_SPLASH_WIDTH_PX * RG_SPLASH_HEIGHT_PX; i++)
            to[i] = rg_half_of(texels[i]);
        if (!rg_atlas_shrink_layer(image, layer, 1))
            return false;
    }
    for (int material = 0; material < RG_ATLAS_MATERIALS; material++)
        rg_splash_parts(&lights[material], atlas->splash_part[material]);
    return true;
}

static bool shrink_streaks(struct rg_atlas *atlas)
{
    const int level = RG_ATLAS_CELL_LEVELS - atlas->first_level;
    for (int part = 0; part < RG_ATLAS_SPLASH; part++)
        for (int layer = 0; layer < RG_ATLAS_OSCILLATIONS; layer++)
            if (!rg_atlas_shrink_layer(&atlas->images[part], layer, level))
                return false;
    return true;
}

bool rg_atlas_finish(struct rg_atlas *atlas)
{
    return shrink_streaks(atlas) && make_splashes(atlas) && rg_atlas_find_hash(atlas);
}

static bool fill(struct rg_atlas *atlas, const struct rg_lobes *lobes,
                 const struct rg_atlas_progress *progress)
{
    int failed = 0, done = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : failed)
    for (int set = 0; set < STREAK_SETS; set++) {
        failed += !make_streaks(atlas, set, lobes);
#pragma omp critical
        {
            rg_doing_begin("tracing the streak atlas", "");
            if (progress)
                progress->tell(progress->user, ++done, STREAK_SETS);
        }
    }
    return !failed && rg_atlas_finish(atlas);
}

struct rg_atlas *rg_atlas_make(enum rg_atlas_size size, const struct rg_atlas_progress *progress)
{
    struct rg_atlas *atlas = rg_atlas_allocate(size);
    struct rg_lobes *lobes = atlas ? rg_alloc(1, sizeof(*lobes), "streak atlas") : NULL;
    if (lobes)
        rg_lobes_of_atlas(lobes);
    const bool made = lobes && fill(atlas, lobes, progress);
    free(lobes);
    if (made)
        return atlas;
    rg_atlas_destroy(atlas);
    return NULL;
}
