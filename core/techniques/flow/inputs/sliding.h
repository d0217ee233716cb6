// Drops that slide (`move=sliding`): rules in seconds and millimetres. docs/flow.md explains them.
#ifndef RG_CORE_TECHNIQUES_FLOW_INPUTS_SLIDING_H
#define RG_CORE_TECHNIQUES_FLOW_INPUTS_SLIDING_H

#include "core/techniques/flow/inputs/flow.h"
#include "kernels/flow/sliding/params.h"

// The least relief with which the highest water that a texel holds is at most FLOW_EDGE_HOLDS.
double flow_least_relief_mm(void);
// The number of cells along a side of the lattice over a pane.
int flow_lattice_cells(const struct flow_settings *settings);
// The number of runs that divide a frame, each of which dries, levels and slides; and how often
// each run levels.
int flow_slide_runs(const struct flow_settings *settings);
int flow_relax_runs(const struct flow_settings *settings);
// The distance in texels between those that level with one another: 1, 2 or 4.
int flow_relax_reach(const struct flow_settings *settings, int run);

// The largest cap of contact_deg that an upright pane holds, and the receding angle by which its
// contact line would carry it (Furmidge): surface tension times width times the difference of both
// angles' cosines is the weight. 0: no angle does.
struct flow_held {
    double mm3, receding_deg;
};
struct flow_held flow_held_of(const struct flow_settings *settings);

// The parameters of a run's kernels; runs are numbered through all frames.
flow_slide_params flow_slide_params_at(const struct flow_settings *settings, int64_t run);
// The distance that water slides in a run, in whole texels: right and down, for each pane and pace.
void flow_ways_at(const struct flow_settings *settings, int64_t frame, int64_t run, int32_t *ways);

#endif
