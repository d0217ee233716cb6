// An independent model of raindrops on a pane: Chin's "Animating Raindrops on a Surface" (2016) in
// double precision, one drop after the other as in the paper. It shares nothing with kernels/ or
// core/.
//
// A step: drops are generated; each drop that runs may leave a residual drop, then moves in
// substeps and wets the pane; neighbours on the ID map merge; drops at rest wet the pane; heights
// and IDs are smoothed; water erodes.
//
// If the paper is silent or contradicts itself, the model does the following.
//
// Generation: each step adds a drop with the probability drops_a_step (above 1: its whole part, and
// a chance for the rest) while there are fewer than max_drops. The drop is equally probable
// everywhere, and rests. Its mass is N(least + (max - least) / 5, 1.5 mg), clamped to least and
// max; least is 2 cell^3 rho, as in table 1.
//
// Affinity: N(0.5, 1.5), clamped to 0 to 1, drawn once a cell.
//
// Tilt: gravity along the pane is g sin(tilt), and the force that holds a drop stays m_c g. So a
// drop runs if m sin(tilt) > m_c, with a = g sin(tilt) - m_c g / m. At 90 degrees that is the
// paper's equation 2.
//
// Stopping: a drop that no longer runs when its turn comes stands still at once.
//
// Residue: the chance is drawn once a step with the whole timestep, before the drop moves. Its time
// begins at 0. It starts anew with a merge, and after each successful draw, even if max_drops
// forbids a birth.
//
// Equation 5: p grows by v dt; speed comes first, place after.
//
// Regions: a region counts the mean of its cells on the pane; if its centre is off the pane, it
// counts 0.
//
// Direction: south, unless one of the others is greater; south-west if both are greater and equal.
// Meandering turns each way south, in every substep, even one that follows water.
//
// Trails: hemispheres at 1.5 cells, 3 cells and so on from the old place, and one at the new place.
//
// Leaving: a drop whose cell (equation 1) is off the pane is gone after its hemisphere is placed,
// moves no more in that step, and merges with none. The whole path of its last substep counts as
// trail.
//
// Hemispheres: the ID is written where the height rises, so that an equal height keeps its owner.
//
// Merging: one pass over the cells, row by row, which compares each cell with the one on its right
// and then the one below. Two living IDs: their connected cells get a new ID, then the new drop's
// hemisphere is placed. One: the dead ID's connected cells take the living ID. None: both take the
// smaller ID. Equally low drops: the older one's place counts. Only a living parent and its living
// child do not merge; the new drop is the parent of both drops' children, and the child of nobody.
//
// Smoothing: a mean of 3 x 3 cells with the pane's edges repeated, then 0 below erode_threshold_mm.
// The paper's high-pass filter is a floor.
//
// IDs are part of smoothing. A cell without an ID takes that of the cell below, else right (not in
// the last row and column); then of the cell above, else left (not in the first ones); each spreads
// by one cell. Then cells below id_threshold_mm, and dry ones, have none.
//
// Erosion: every run of wet cells in a row loses the cell at each end that has a dry neighbour.
#ifndef RG_TESTS_ORACLE_DROPS_DROPS_H
#define RG_TESTS_ORACLE_DROPS_DROPS_H

#include "tests/oracle/drops/state.h"

// The settings of the paper's tables 1 and 3, a pane 1,000 cells wide, and a step of 1/60 s.
struct oracle_drops_settings oracle_drops_defaults(void);

// Opens a dry pane without drops. The caller calls oracle_drops_close. Settings may change between
// steps, except the pane's size and the seed.
void oracle_drops_open(struct oracle_drops *drops, const struct oracle_drops_settings *settings);
void oracle_drops_close(struct oracle_drops *drops);

void oracle_drops_step(struct oracle_drops *drops);

// Adds a drop at rest, whatever max_drops says; it counts as generated. The place is from the
// pane's lower left corner. Returns its ID.
uint32_t oracle_drops_add(struct oracle_drops *drops, double x_mm, double y_mm, double mass_mg);
// Ends all drops; their water stays on the pane, and nothing holds it there.
void oracle_drops_delete(struct oracle_drops *drops);

struct oracle_drops_measures {
    int drops;
    double mass_mg, drained_mg; // on the pane, and over its edges since the start
    int wet_cells;
    double trail_mm; // the way of all drops since the start
};

struct oracle_drops_measures oracle_drops_measure(const struct oracle_drops *drops);

#endif
