// What proves cartoon: scenes, and mutants.
#include "core/techniques/cartoon/instance.h"
#include "core/techniques/proof.h"

static const struct rg_pose poses[] = {
    {.set = ""},
    {.set = "spin_deg=7 rise_deg=30"},
    {.set = NULL},
};

static const struct rg_law laws[] = {
    {NULL, NULL},
};

static const struct rg_mutant mutants[] = {
    {"the camera 1 % nearer", "zoom", 1.01, 0},
    {"the camera 1 degree higher", "rise_deg", 1, 1},
    {"the light 1 degree aside", "light_turn_deg", 1, 1},
    {"less blue", "gooch_blue", 0.95, 0},
    {NULL, NULL, 0, 0},
};

const struct rg_proof cartoon_proof = {
    .poses = poses,
    .dry = "gooch_blue=0",
    .laws = laws,
    .mutants = mutants,
};
