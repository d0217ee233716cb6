#include "core/scene/atlas/sample.h"

#include <stdlib.h>
#include <xxhash.h>

#include "core/base/alloc.h"
#include "core/scene/atlas/splash.h"
#include "core/scene/atlas/streak.h"

enum { OSCILLATION = 6, VIEW = 1, LEVEL = 3, MATERIAL = 1, FRAME = 0 };

static bool add_streaks(XXH3_state_t *state, enum rg_atlas_size size)
{
    const struct rg_streak_detail detail = rg_atlas_kinds[size].detail;
    const struct rg_streak_detail coarse = {detail.swings, .moments = 4, .column = 4, .along = 16};
    struct rg_lobes *lobes = rg_alloc(1, sizeof(*lobes), "streak atlas");
    struct rg_streaks streaks = {0};
    if (lobes)
        rg_lobes_of_atlas(lobes);
    const bool made = lobes && rg_streaks_trace(OSCILLATION, VIEW, LEVEL, &coarse, lobes, &streaks);
    if (made) {
        const size_t pixels = (size_t)streaks.width * (size_t)streaks.height;
        const float balance = rg_streaks_balance(&streaks);
        XXH3_64bits_update(state, &balance, sizeof(balance));
        XXH3_64bits_update(state, &detail, sizeof(detail));
        XXH3_64bits_update(state, streaks.point, pixels * RG_LOBE_COUNT * sizeof(float));
        XXH3_64bits_update(state, streaks.env, pixels * sizeof(float));
    }
    rg_streaks_free(&streaks);
    free(lobes);
    return made;
}

// Adds the water of all frames, and the light of one that has balls, a sheet and a wave, and few of
// them: rays take most of the time.
static bool add_splashes(XXH3_state_t *state, enum rg_swings set)
{
    float texels[RG_SPLASH_WIDTH_PX * RG_SPLASH_HEIGHT_PX];
    float parts[RG_ATLAS_LIGHTS][RG_ATLAS_PHIS];
    struct rg_splash_light light = {0};
    struct rg_water water;
    for (int material = 0; material < RG_ATLAS_MATERIALS; material++) {
        for (int frame = 0; frame < RG_ATLAS_FRAMES; frame++) {
            const double shown = rg_splash_frame(set, material, frame, &water);
            XXH3_64bits_update(state, &shown, sizeof(shown));
            XXH3_64bits_update(state, &water, sizeof(water));
        }
    }
    if (!rg_splash_draw(set, MATERIAL, FRAME, texels, &light))
        return false;
    rg_splash_parts(&light, parts);
    XXH3_64bits_update(state, texels, sizeof(texels));
    XXH3_64bits_update(state, parts, sizeof(parts));
    return true;
}

uint64_t rg_atlas_sample(enum rg_atlas_size size)
{
    XXH3_state_t *state = XXH3_createState();
    if (!state)
        return 0;
    XXH3_64bits_reset(state);
    const bool made = (rg_atlas_kinds[size].is_packed || add_streaks(state, size)) &&
                      add_splashes(state, rg_atlas_kinds[size].detail.swings);
    const uint64_t hash = made ? XXH3_64bits_digest(state) : 0;
    XXH3_freeState(state);
    return hash;
}
