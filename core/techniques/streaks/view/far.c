// Rain beyond the culling radius, drawn as slabs (kernels/streaks/far/far.h).

#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/techniques/streaks/instance.h"

// Width and height of the density map in texels; a larger map is averaged.
enum { DENSITY_PX = 512 };

// A pattern repeats after this many metres of fall: four hours.
static const double longest_fall_m = 131072;

static bool write_density(const struct streaks *s, const struct rg_density *density)
{
    float *texels = rg_alloc(DENSITY_PX * DENSITY_PX, sizeof(*texels), "density map");
    if (!texels)
        return false;
    const double wide = (double)density->width / DENSITY_PX;
    const double high = (double)density->height / DENSITY_PX;
    for (int y = 0; y < DENSITY_PX; y++)
        for (int x = 0; x < DENSITY_PX; x++)
            texels[y * DENSITY_PX + x] = (float)(rg_density_mass(density, x * wide, y * high,
                                                                 (x + 1) * wide, (y + 1) * high) /
                                                 (wide * high));
    const bool written = rg_image_write(s->density, 0, 0, texels);
    free(texels);
    return written;
}

bool streaks_density_open(struct streaks *s)
{
    const struct rg_image_desc desc = {RG_D32F, DENSITY_PX, DENSITY_PX, 1, 1};
    struct rg_density *density = streaks_density(s);
    s->density = density ? rg_image_create(s->base.device, &desc, "density map") : NULL;
    const bool good = s->density && write_density(s, density);
    rg_density_destroy(density);
    return good;
}

static streaks_far_params params_of(const struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    const struct streaks_equivalent drops = streaks_sizes_equivalent(s);
    const double seconds = set->step_s * (double)s->base.frame;
    streaks_params rain = s->params;
    rain.half_width *= (float)(drops.radius_m / (set->drop_radius_mm / 1000));
    rain.drop_radius = (float)drops.radius_m;
    rain.fall = (float)(drops.speed_m_s * set->exposure_s);
    return (streaks_far_params){
        .rain = rain,
        .lights = s->params.lights,
        .nearest = (float)set->culling_radius_m,
        .farthest = (float)(set->culling_radius_m * (1 + set->far_layers)),
        .thickness = (float)(set->culling_radius_m / STREAKS_FAR_PARTS),
        .fallen = (float)fmod(drops.speed_m_s * seconds, longest_fall_m),
        .drops_m3 = (float)drops.drops_m3,
        .seed = set->seed,
        .taps = 2 << set->taps,
    };
}

// The observer is inside a slab, so that one more slab is needed for its two parts.
bool streaks_draw_far(struct streaks *s)
{
    if (!s->settings.far_layers || !s->settings.limits ||
        !rg_stage_runs(&s->base, s->first_stage + STREAKS_FAR))
        return true;
    const struct rg_extent first = {0, 0, 0},
                           slabs = {s->settings.far_layers * STREAKS_FAR_PARTS + 1, 1, 1};
    s->of_far = params_of(s);
    return rg_stage_over(&s->base, s->first_stage + STREAKS_FAR, first, slabs);
}
