// The proof of streaks: its scenes, laws of its particles, and mutants.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/techniques/proof.h"
#include "core/techniques/streaks/instance.h"

#define SMALL                                                                                      \
    "atlas=small city=small depth_map_px=1024 shadow_map_px=256 far_layers=0 splash_fade=0 "       \
    "spectrum=off "
// A sixteenth of the rain space, around the city's middle, with the camera in it: opening makes
// every particle, and most of the whole space's are never near enough to be seen. Its rain is a
// fifth as dense.
#define AROUND "camera=free rain_width_m=100 rain_depth_m=100 drops_m2_s=100 "
#define NEAR   SMALL AROUND
#define SIZES  "spectrum=best least_diameter_mm=1 kept_share=0.1"
// Poses are compared by their states too. Mutants are compared by pictures only, and keeping the
// states of each step would take half of their time.
#define POSE SMALL "state=on "

// A visible particle is in the local space. A drop's streak is at least partly above the surface
// that it hits, and a splash lasts no longer than set.
static const char *fault_of(const struct streaks *s, const float *place)
{
    const streaks_params *p = &s->params;
    const int state = (int)place[5];
    const double longest_m = s->sizes.fastest_m_s * s->settings.exposure_s + s->sizes.largest_m;
    const float most = 1e-3f, end = place[2] - (float)longest_m;
    if (state == STREAKS_NOTHING)
        return NULL;
    if (state != STREAKS_DROP && state != STREAKS_SPLASH)
        return "has no state";
    if (!(place[2] >= p->top - most && place[2] <= p->top + p->local_height + most))
        return "has left the local space";
    if (!(fabsf(place[0]) <= p->half_x && fabsf(place[1]) <= p->half_y))
        return "has left the rain space";
    if (state == STREAKS_DROP && end > place[3] + most)
        return "is a drop below what it hits";
    if (state == STREAKS_SPLASH && !(place[4] >= 0 && place[4] <= p->splash_s + most))
        return "has splashed for too long";
    return NULL;
}

static bool particles_are_sound(const struct rg_instance *instance, char *detail, size_t size)
{
    const struct streaks *s = (const struct streaks *)instance;
    const int64_t count = s->selection.block_count * STREAKS_BLOCK;
    if (!instance->state_count)
        return true; // states are not stored
    float *places = rg_alloc((size_t)count, STREAKS_STATE_WORDS * sizeof(float), "places");
    const char *fault = NULL;
    bool ok = places && rg_buf_read(instance->state[0].asset->buf, 0, places,
                                    count * STREAKS_STATE_WORDS * (int64_t)sizeof(float));
    for (int64_t i = 0; ok && i < count; i++)
        if ((fault = fault_of(s, places + i * STREAKS_STATE_WORDS))) {
            snprintf(detail, size, "particle %lld %s", (long long)i, fault);
            ok = false;
        }
    free(places);
    return ok;
}

static const struct rg_pose poses[] = {
    {.set = POSE AROUND},
    {.set = POSE AROUND
     "rain_width_m=150 walk_m_s=3 time=night lights=6 packets=quad packet_size=3000 "
     "select=hull splash_materials=on spectrum=marshall-palmer least_diameter_mm=1 "
     "kept_share=0.03 far_layers=2 splash_fade=0.25"},
    {.set = POSE "geometry=off walk_m_s=8 slant_deg=25 slant_azimuth_deg=20 packets=kd "
                 "packet_size=700 drops_m2_s=20 cull=exact order=id depth_map=dynamic "
                 "depth_map_period=3 depth_map_px=512 taps=8 far_layers=3 splash_materials=on"},
    {.set = NULL},
};

static const struct rg_law laws[] = {
    {"sound particles", particles_are_sound},
    {NULL, NULL},
};

static const struct rg_mutant mutants[] = {
    {"another seed", "seed", 1, 1},
    {"1 % more rain", "drops_m2_s", 1.01, 0},
    {"1 % slower fall", "fall_speed_m_s", 0.99, 0},
    {"drops 1 % larger", "drop_radius_mm", 1.01, 0},
    {"splashes 5 % longer", "splash_s", 1.05, 0},
    {"splashes 3 % wider", "splash_width_mm", 1.03, 0},
    {"splashes 3 % brighter", "splash_gain", 1.03, 0},
    {"streaks 3 % brighter", "streak_gain", 1.03, 0},
    {"exposed 1 % longer", "exposure_s", 1.01, 0},
    {"steps 1 % longer", "step_s", 1.01, 0},
    {"the local space 1 % higher", "local_height_m", 1.01, 0},
    {"rain that leans by 1 degree", "slant_deg", 1, 1},
    {"the view 0.2 % wider", "view_angle_deg", 1.002, 0},
    {"the eye a centimetre higher", "eye_y_m", 1, 0.01},
    {"a light missing", "lights", 1, -1},
    {NULL, NULL, 0, 0},
};

static const struct rg_contrast contrasts[] = {
    {"splashes lost", NEAR, "splashes=off"},
    {"no light from the sky", NEAR, "environment_light=off"},
    {"shadows lost", NEAR "time=night lights=4", "shadows=off"},
    {"thin streaks as points", NEAR, "thin_streaks=points"},
    {"four textures a light", NEAR "time=night lights=4 streak_gain=20", "taps=4"},
    {"far rain lost", NEAR "far_layers=4", "far_layers=0"},
    {"streaks hide 3 % more", NEAR "streak_gain=0 streak_opacity=30", "streak_opacity=30.9"},
    {"splashes hide 3 % less", NEAR "splash_gain=0 splash_opacity=30 splash_width_mm=200",
     "splash_opacity=29.1"},
    {"matt splashes", NEAR "time=night lights=4 splash_gain=20", "splash_light=matt"},
    {"drops of other sizes", NEAR SIZES, "rain_mm_h=21"},
    {"slower drops of a spectrum", NEAR SIZES, "terminal_speed=atlas"},
    {"views from below as from above", NEAR "streak_gain=10", "view_below=absolute"},
    {NULL, NULL, NULL},
};

const struct rg_proof streaks_proof = {
    .poses = poses,
    .dry = "fit=off drops=off splashes=off",
    .mutant_scene = NEAR "lights=1 streak_gain=20 splash_gain=20",
    .laws = laws,
    .mutants = mutants,
    .contrasts = contrasts,
};
