// What the files of drops share.
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
    DROPS_RUN_DOZE,
    // pictures
    DROPS_RUN_PANE,
    DROPS_RUN_SHOW,
    DROPS_RUN_DISCS,
    DROPS_STAGES
};

// The paper's cells and steps.
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
    struct rg_asset *height, *next_height, *ids, *next_ids; // which take turns
    uint32_t tiles_before;                                  // DROPS_TILES at the step's beginning
};

extern const struct rg_proof drops_proof;

// The parameters that never change.
drops_params drops_params_of(const struct drops_settings *settings);

bool drops_open(struct rg_instance *instance);
void drops_close(struct rg_instance *instance);
bool drops_step(struct rg_instance *instance);
bool drops_draw(struct rg_instance *instance);

// The pictures, in view/.

// The whole pane as large as a picture of width x height pixels has room for, in its middle.
drops_view_params drops_view_of(const struct drops *d, int width, int height);
// The same of the lit pane, as `view` has it; the camera stands before the pane's middle.
drops_pane_params drops_pane_of(const struct drops *d, const drops_view_params *view);
// Adds the images `environment` and `background`, out of focus as a lens sees them that is focused
// on the pane. Without a background it is one dark texel.
void drops_add_outside(struct drops *d);

#endif
