// The proof of shower: scenes, laws of its population and its region, and mutants.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/techniques/proof.h"
#include "core/techniques/shower/instance.h"

// --- laws ---

// The number of particles is the tally's, and at most what eq. 1 can ask for; each one born is
// alive or has died.
static bool population_is_sound(const struct rg_instance *instance, char *detail, size_t size)
{
    const struct shower *s = (const struct shower *)instance;
    const shower_params *p = &s->params;
    const int64_t bytes = (int64_t)p->slots * 4;
    float *falls = rg_alloc((size_t)p->slots, sizeof(*falls), "particles");
    const bool ok = falls && rg_buf_read(s->particles->buf, SHOWER_FALL * bytes, falls, bytes);
    uint32_t alive = 0;
    for (int i = 0; ok && i < p->slots; i++)
        alive += falls[i] > 0;
    free(falls);
    if (!ok)
        return false;
    const uint32_t *t = s->tally;
    const uint32_t due = p->is_promoted ? alive : t[SHOWER_BORN] - t[SHOWER_DIED];
    const bool holds = alive == t[SHOWER_ALIVE] && alive == due && (int)alive <= p->slots;
    if (!holds)
        snprintf(detail, size, "%u particles, but the tally has %u, born %u, died %u", alive,
                 t[SHOWER_ALIVE], t[SHOWER_BORN], t[SHOWER_DIED]);
    return holds;
}

// The largest sideways distance between a drop's ends, in the layer that falls slowest.
static double lean_m(const shower_params *p)
{
    const double wind_m_s = hypot((double)p->wind_x, (double)p->wind_z);
    return (double)p->height_m * (1 + 3 * wind_m_s / (double)p->fall_m_s);
}

// A particle falls, and is in the visible body except perhaps for the drop's other end. If all are
// promoted, it is also above the ground.
static const char *fault_of(const shower_params *p, const float at[3], float fall)
{
    const double x = (double)at[0] - (double)p->eye_x, y = (double)at[1] - (double)p->eye_y;
    const double z = (double)at[2] - (double)p->eye_z, slack_m = lean_m(p) + 1e-3;
    const double ahead = x * (double)p->ahead_x + z * (double)p->ahead_z;
    const double across = (double)p->across, above = (double)p->above;
    const double corner_m = (double)p->far_m * sqrt(1 + across * across + above * above);
    if (fall == 0)
        return at[0] == 0 && at[1] == 0 && at[2] == 0 ? NULL : "has ended and has a place";
    if (!(fall > 0))
        return "rises";
    if (!(ahead >= -slack_m && sqrt(x * x + y * y + z * z) <= corner_m + slack_m))
        return "is behind the viewer or too far to be seen";
    return !p->is_promoted || at[1] >= p->ground_m ? NULL : "is below the ground";
}

static bool particles_are_sound(const struct rg_instance *instance, char *detail, size_t size)
{
    const struct shower *s = (const struct shower *)instance;
    const size_t slots = (size_t)s->params.slots;
    float *words = rg_alloc(slots, SHOWER_WORDS * sizeof(*words), "particles");
    bool holds = words && rg_buf_read(s->particles->buf, 0, words,
                                      (int64_t)slots * SHOWER_WORDS * (int64_t)sizeof(*words));
    for (size_t i = 0; holds && i < slots; i++) {
        const float at[3] = {words[i], words[slots + i], words[2 * slots + i]};
        const char *fault = fault_of(&s->params, at, words[3 * slots + i]);
        if (fault)
            snprintf(detail, size, "particle %zu %s", i, fault);
        holds = !fault;
    }
    free(words);
    return holds;
}

static const struct rg_law laws[] = {
    {"population", population_is_sound},
    {"sound particles", particles_are_sound},
    {NULL, NULL},
};

#define SMALL "city=small map_px=512 shadow_map_px=256 particles=3000 drop_height_m=0.3 "
#define ALONE "geometry=off particles=3000 drop_height_m=0.3 "

static const struct rg_pose poses[] = {
    {SMALL, 600, 60},
    {SMALL "system=traditional", 600, 60},
    {ALONE "system=traditional state=compact renewal=promotion layers=on birth=whole wind_m_s=12 "
           "wind_deg=70 gust=0.5",
     600, RG_POSE_LEFT_OUT},
    {ALONE "state=full shape=quads motion=euler renewal=birth birth=volume walk_m_s=3", 600, 60},
    {ALONE "renewal=heap variation=0.3", 600, RG_POSE_LEFT_OUT},
    {NULL, 0, 0},
};

static const struct rg_mutant mutants[] = {
    {"another seed", "seed", 1, 1},
    {"1 % fewer particles", "particles", 0.99, 0},
    {"1 % slower fall", "fall_m_s", 0.99, 0},
    {"1 % more gravity", "gravity_m_s2", 1.01, 0},
    {"1 % more wind", "wind_m_s", 1.01, 0},
    {"wind turned by 2 degrees", "wind_deg", 1, 2},
    {"drops 1 % higher", "drop_height_m", 1.01, 0},
    {"drops 3 % wider", "drop_width_m", 1.03, 0},
    {"drops 3 % brighter", "light", 1.03, 0},
    {"nearest drops 1 % farther", "near_m", 1.01, 0},
    {"steps 1 % longer", "step_s", 1.01, 0},
    {"drops hide 3 % less", "opacity", 0.97, 0},
    {"the view turned by 0.2 degrees", "heading_deg", 1, 0.2},
    {NULL, NULL, 0, 0},
};

// Settings that make rain visible: a wider space in front of a small picture, and bright drops.
#define BRIGHT      "particles=20000 drop_height_m=1 opacity=1 light=3 "
#define BARE        "geometry=off " BRIGHT
#define TRADITIONAL BARE "system=traditional "

static const struct rg_contrast contrasts[] = {
    {"no layers", BARE "system=improved", "layers=off"},
    {"particles promoted", TRADITIONAL, "renewal=promotion"},
    {"uniform motion", TRADITIONAL, "motion=uniform"},
    {"segments for quads", TRADITIONAL, "shape=segments"},
    {"births in the whole region", TRADITIONAL, "birth=whole"},
    {"births even in space", TRADITIONAL "birth=whole", "birth=volume"},
    {"a number that varies more", TRADITIONAL, "variation=0.2"},
    {"landing on the plane", SMALL BRIGHT "geometry=on system=improved", "landing=plane"},
    {NULL, NULL, NULL},
};

const struct rg_proof shower_proof = {
    .poses = poses,
    .dry = "particles=0",
    .mutant_scene = TRADITIONAL "wind_m_s=5",
    .laws = laws,
    .mutants = mutants,
    .contrasts = contrasts,
};
