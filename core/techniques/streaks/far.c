// Rain beyond the culling radius as layers that scroll (kernels/streaks/far.h).
#include <math.h>

#include "core/techniques/streaks/instance.h"

// A layer hides as much as all its drops do: each hides its cross-section all through the exposure.
static double opacity_of(const struct streaks *s)
{
    const double radius_m = s->settings.drop_radius_mm / 1000;
    return s->drops_m3 * s->settings.culling_radius_m * M_PI * radius_m * radius_m *
           s->settings.streak_opacity;
}

static streaks_far_params params_of(const struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    const double seconds = set->step_s * (double)s->base.frame;
    const float light = (float)(set->streak_gain / fmax(set->streak_opacity, 1e-6));
    streaks_far_params p = {
        .to_clip = s->params.to_clip,
        .rays = s->params.rays,
        .eye_x = s->params.eye_x,
        .eye_y = s->params.eye_y,
        .eye_s = s->params.eye_s,
        .nearest = (float)set->culling_radius_m,
        .thickness = (float)set->culling_radius_m,
        .cell_length = (float)(2 * set->fall_speed_m_s * set->exposure_s),
        .columns = 4096,
        .opacity = (float)opacity_of(s),
        .contrast = 0.5f,
        .r = s->params.sky_r * light,
        .g = s->params.sky_g * light,
        .b = s->params.sky_b * light,
        .seed = set->seed,
    };
    p.fallen = (float)fmod(set->fall_speed_m_s * seconds, STREAKS_FAR_ROWS * (double)p.cell_length);
    return p;
}

bool streaks_draw_far(struct streaks *s)
{
    if (!rg_stage_runs(&s->base, s->first_stage + STREAKS_FAR))
        return true;
    const struct rg_extent first = {0, 0, 0}, layers = {s->settings.far_layers, 1, 1};
    s->of_far = params_of(s);
    return rg_stage_over(&s->base, s->first_stage + STREAKS_FAR, first, layers);
}
