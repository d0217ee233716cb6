// The proof of cartoon: scenes, and mutants.
#include "core/techniques/cartoon/instance.h"
#include "core/techniques/proof.h"

static const struct rg_pose poses[] = {
    {"", 100, 50},
    {"scene=park2 style=gooch_outlines spin_deg=7 rise_deg=30", 100, 50},
    {"scene=house1 style=hatching spin_deg=5", 100, 50},
    {"scene=table style=outlines spin_deg=5 zoom=2", 100, 45},
    {"scene=mesh style=cartoon zoom=1.5", 60, 45},
    // Poses of the rain: each kind of counting, falling and wind; a storm of 600 steps in full
    // runs.
    {"preset=storm drops_s=2000 collide=faithful query=spheres", 600, 60},
    {"preset=table drops_s=3000 collide=any answers=late drag=quadratic", 600, 90},
    {"scene=house2 drops_s=3000 spin_deg=3 steps_s=30", 600, 60},
    {"scene=ground drops_s=6000 water=on spin_deg=1", 600, 90},
    {NULL, 0, 0},
};

static bool cartoon_rain_balances(const struct rg_instance *instance, char *detail, size_t size)
{
    return cartoon_rain_holds(&((const struct cartoon *)instance)->rain, detail, size);
}

static bool cartoon_water_balances(const struct rg_instance *instance, char *detail, size_t size)
{
    return cartoon_water_holds(&((const struct cartoon *)instance)->water, detail, size);
}

static const struct rg_law laws[] = {
    {"every drop is somewhere", cartoon_rain_balances},
    {"no water is lost", cartoon_water_balances},
    {NULL, NULL},
};

static const struct rg_mutant mutants[] = {
    {"the camera 1 % nearer", "zoom", 1.01, 0},
    {"the camera 1 degree higher", "rise_deg", 1, 1},
    {"the light 1 degree aside", "light_turn_deg", 1, 1},
    {"lines 2 % thicker", "outline_px", 1.02, 0},
    {"creases 2 % thicker", "inner_px", 1.02, 0},
    {"creases from 50 degrees on", "crease_deg", 1, 10},
    {"shadows 5 % lighter", "shadow_tone", 1.05, 0},
    {"full light 5 % later", "lit_from", 1.05, 0},
    {"1 % more drops", "drops_s", 1.01, 0},
    {"drops 1 % faster", "speed_m_s", 1.01, 0},
    {"drops 1 % larger", "drop_m", 0, 0.32},
    {"another seed", "seed", 1, 1},
    {NULL, NULL, 0, 0},
};

static const struct rg_contrast contrasts[] = {
    {"less blue", "style=gooch", "gooch_blue=0.38"},
    {"less yellow", "style=gooch", "gooch_yellow=0.39"},
    {"strokes 2 % larger", "style=hatching", "hatch_px=204"},
    {"less wash", "style=hatching", "hatch_wash=0.33"},
    {"no outlines", "style=gooch_outlines", "style=gooch"},
    {"a light wind", "wind_m_s=0", "wind_m_s=0.1"},
    {"hidden drops hit", "scene=house2", "scene=house2 collide=faithful"},
    {"puddles 5 % later", "water=on", "water=on water_from_m=0.000105"},
    {"splashes 5 % longer", "splash_s=0.3", "splash_s=0.32"},
    {NULL, NULL, NULL},
};

const struct rg_proof cartoon_proof = {
    .poses = poses,
    .dry = "drops_s=0",
    .laws = laws,
    .mutants = mutants,
    .contrasts = contrasts,
};
