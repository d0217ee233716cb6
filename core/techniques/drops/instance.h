// Shared declarations of drops' files.
#ifndef RG_CORE_TECHNIQUES_DROPS_INSTANCE_H
#define RG_CORE_TECHNIQUES_DROPS_INSTANCE_H

#include "core/device/scan.h"
#include "core/techniques/drops/drops.h"
#include "core/techniques/technique.h"
#include "kernels/drops/params.h"
#include "kernels/drops/view/pane_params.h"
#include "kernels/drops/view/params.h"

enum drops_stage {
    DROPS_RUN_AFFINITY,
    DROPS_RUN_BEADS,
    DROPS_RUN_RUN,
    DROPS_RUN_TRAIL,
    DROPS_RUN_CLAIM,
    DROPS_RUN_MEET,
    DROPS_RUN_PART,
    DROPS_RUN_LABEL,
    DROPS_RUN_LINK,
    DROPS_RUN_SIDE,
    DROPS_RUN_LEAD,
    DROPS_RUN_GATHER,
    DROPS_RUN_LOWEST,
    DROPS_RUN_MERGE,
    DROPS_RUN_SETTLE,
    DROPS_RUN_PACK,
    DROPS_RUN_RECOLOUR,
    DROPS_RUN_DISBAND,
    DROPS_RUN_COUNT,
    DROPS_RUN_CLEAR,
    DROPS_RUN_PLACE,
    DROPS_RUN_OWN,
    DROPS_RUN_FLATTEN,
    DROPS_RUN_FLATTEN_BEADS,
    DROPS_RUN_DOZE,
    // pictures
    DROPS_RUN_PANE,
    DROPS_RUN_SHOW,
    DROPS_RUN_DISCS,
    DROPS_STAGES
};

// The paper's cell and step.
#define DROPS_PAPER_CELL_MM 0.5
#define DROPS_PAPER_STEP_S  (1.0 / 60)

enum drops_counter { DROPS_STEPPED, DROPS_CELLS, DROPS_MERGING, DROPS_COUNTERS };

struct drops {
    struct rg_instance base;
    struct drops_settings settings;
    struct rg_scan *scan;
    drops_params params;
    drops_view_params show;
    drops_pane_params pane;
    struct rg_asset *drops, *packed, *flags, *before, *tally, *tiles;
    struct rg_asset *background;                            // of the lit pane
    struct rg_asset *height, *next_height, *ids, *next_ids; // swapped after each step
    uint32_t tiles_before;                                  // DROPS_TILES when the step began
};

extern const struct rg_proof drops_proof;

// The parameters that never change.
drops_params drops_params_of(const struct drops_settings *settings);

bool drops_open(struct rg_instance *instance);
void drops_close(struct rg_instance *instance);
bool drops_step(struct rg_instance *instance);
bool drops_draw(struct rg_instance *instance);

// Functions of view/.

// The placement of the whole pane, as large as fits, in the middle of a picture of width x height
// pixels.
drops_view_params drops_view_of(const struct drops *d, int width, int height);
// The parameters of the lit pane, placed as in `view`; the camera is in front of the pane's middle.
drops_pane_params drops_pane_of(const struct drops *d, const drops_view_params *view);
// Adds the images `environment` and `background`, blurred as by a lens focused on the pane. Without
// a background it is one dark texel.
void drops_add_outside(struct drops *d);

#endif
