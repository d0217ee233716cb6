// The proof of drops: panes, conservation in whole quanta, and mutants.
#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/techniques/drops/instance.h"
#include "core/techniques/proof.h"

// The data that laws check.
struct reading {
    uint32_t tally[DROPS_TALLY];
    drops_drop *drops;
};

static bool read_drops(const struct drops *d, struct reading *r)
{
    const int64_t bytes = d->settings.max_drops * (int64_t)sizeof(*r->drops);
    r->drops = rg_alloc((size_t)d->settings.max_drops, sizeof(*r->drops), "drops");
    const bool ok = r->drops && rg_buf_read(d->tally->buf, 0, r->tally, sizeof(r->tally)) &&
                    rg_buf_read(d->drops->buf, 0, r->drops, bytes);
    return ok;
}

// Water that has landed is on the pane, has left it or was removed.
static bool mass_is_conserved(const struct rg_instance *instance, char *detail, size_t size)
{
    struct reading r;
    bool holds = read_drops((const struct drops *)instance, &r);
    uint32_t mass = 0;
    for (uint32_t i = 0; holds && i < r.tally[DROPS_COUNT]; i++)
        mass += r.drops[i].mass;
    if (holds && mass != r.tally[DROPS_SOURCED] - r.tally[DROPS_DRAINED] - r.tally[DROPS_REMOVED]) {
        snprintf(detail, size,
                 "the pane holds %u quanta, but %u came, %u left and %u were removed (modulo 2^32)",
                 mass, r.tally[DROPS_SOURCED], r.tally[DROPS_DRAINED], r.tally[DROPS_REMOVED]);
        holds = false;
    }
    free(r.drops);
    return holds;
}

// Drops are in the order of their IDs, lie on the pane, and move if they are too heavy to rest.
static const char *fault_of(const struct drops *d, const drops_drop *drop, uint32_t before)
{
    const drops_params *p = &d->params;
    const float right = (float)p->columns * p->cell_mm, bottom = (float)p->rows * p->cell_mm;
    if (drop->id <= before)
        return "is out of order";
    if (!drop->mass)
        return "weighs nothing";
    if (!(drop->x >= 0 && drop->x < right && drop->y >= 0 && drop->y < bottom))
        return "is off the pane";
    if (drop->mass > p->critical && !drop->is_new && drop->vx == 0 && drop->vy == 0)
        return "is heavy and rests";
    return NULL;
}

static bool drops_are_sound(const struct rg_instance *instance, char *detail, size_t size)
{
    const struct drops *d = (const struct drops *)instance;
    struct reading r;
    bool holds = read_drops(d, &r);
    for (uint32_t i = 0; holds && i < r.tally[DROPS_COUNT]; i++) {
        const char *fault = fault_of(d, &r.drops[i], i ? r.drops[i - 1].id : 0);
        if (fault)
            snprintf(detail, size, "drop %u %s", r.drops[i].id, fault);
        holds = !fault;
    }
    free(r.drops);
    return holds;
}

#define SMALL "columns=250 rows=150 drops_s=20 max_drops=300 "
#define WET   "columns=250 rows=150 drops_s=120 max_drops=300 "
// Trails that break into beads leave nothing for erosion to do.
#define PAPER "trail=hemispheres "

// Full runs switch off each operation alone, quick runs several together; quick runs get more rain,
// so that something happens in them.
static const struct rg_pose poses[] = {
    {SMALL, 2000, 30},
    {SMALL "erode=off", 300, RG_POSE_LEFT_OUT},
    {SMALL "merge=off", 300, RG_POSE_LEFT_OUT},
    {SMALL "residual=off", 300, RG_POSE_LEFT_OUT},
    {SMALL "smooth=off", 300, RG_POSE_LEFT_OUT},
    {SMALL "trail=lines", 300, RG_POSE_LEFT_OUT},
    {SMALL "remove_s=0.8", 300, RG_POSE_LEFT_OUT}, // after 48 steps, before the usual run ends
    {SMALL "tilt_deg=50", 300, RG_POSE_LEFT_OUT},
    {SMALL "turn_deg=-110", 300, RG_POSE_LEFT_OUT},
    {WET "turn_deg=180 trail=lines substeps=2 residual=off", 300, 20},
    {WET "tilt_deg=50 turn_deg=70 merge=off cell_mm=0.4", 300, 20},
    {WET "smooth=off erode=off remove_s=0.2 view=ids", 300, 20},
    {PAPER WET "turn_deg=-30", 300, 20},
    {PAPER "drops_s=60", 500, RG_POSE_LEFT_OUT}, // the paper's pane
    {NULL, 0, 0},
};

static const struct rg_law laws[] = {
    {"conservation", mass_is_conserved},
    {"sound drops", drops_are_sound},
    {NULL, NULL},
};

static const struct rg_mutant mutants[] = {
    {"another seed", "seed", 1, 1},
    {"1 % less rain", "drops_s", 0.99, 0},
    {"critical mass 1 % higher", "critical_mass_mg", 1.01, 0},
    {"drops 1 % heavier", "max_mass_mg", 1.01, 0},
    {"steps 1 % longer", "step_s", 1.01, 0},
    {"meander 1 % wider", "meander_rad", 1.01, 0},
    {"3 % more residual drops", "residual_beta", 1.03, 0},
    {"residual drops 3 % later", "residual_max_s", 1.03, 0},
    {"residual drops 1 % heavier", "residual_high", 1.01, 0},
    {"light residual drops 5 % heavier", "residual_low", 1.05, 0},
    {"erosion's threshold 10 % higher", "erode_mm", 1.1, 0},
    {"a substep more", "substeps", 1, 1},
    {"the pane tilted by 10 degrees", "tilt_deg", 1, -10},
    {NULL, NULL, 0, 0},
};

static const struct rg_contrast contrasts[] = {
    {"water that does not thin", WET "view=height", "erode=off"},
    {"waters that do not merge", WET "view=ids", "merge=off"},
    {"no residual drops", WET "view=height", "residual=off"},
    {"water that does not flatten", WET "view=height", "smooth=off"},
    {"trails of lines", WET "view=height", "trail=lines"},
    {"trails of beads", WET "view=height", "trail=beads"},
    {"drops that are not removed", WET "view=height remove_s=1", "remove_s=-1"},
    {"a turned pane", WET "view=height", "turn_deg=5"},
    {"water owned from 20 % higher on", WET "view=ids", "owned_mm=0.6"},
    {NULL, NULL, NULL},
};

const struct rg_proof drops_proof = {
    .poses = poses,
    .dry = "drops_s=0",
    .mutant_scene = PAPER WET "view=height",
    .laws = laws,
    .mutants = mutants,
    .contrasts = contrasts,
};
