// Parameters and buffers of all kernels of drops, shared with the host: Chin, "Animating Raindrops
// on a Surface". Lengths are in mm, masses in mg, times in s, as in the paper.
#ifndef RG_KERNELS_DROPS_PARAMS_H
#define RG_KERNELS_DROPS_PARAMS_H

#include "kernels/dialect/lang.h"

#define DROPS_MARGIN 10 // cells around the pane, always dry

// Kernels work on maps by tiles of cells; a tile sleeps while nothing in it changes.
#define DROPS_TILE_COLUMNS 32
#define DROPS_TILE_ROWS    8

#define DROPS_ROWS_A_DROP                                                                          \
    8 // items for each drop, in a stage over its cells: each takes every eighth row

#define DROPS_HEIGHTS_A_MM 4096.0f // smoothed heights are multiples of 1 / this

// Masses are whole quanta, so that they are conserved exactly.
#define DROPS_QUANTA_MG 1024.0f

// Words of the buffer `tally`.
#define DROPS_COUNT    0  // drops on the pane
#define DROPS_NEXT_ID  1  // IDs rise with time; 0 is nobody's
#define DROPS_SOURCED  2  // quanta that landed, modulo 2^32
#define DROPS_DRAINED  3  // quanta that left over an edge, modulo 2^32
#define DROPS_LANDED   4  // drops that landed
#define DROPS_LEFT     5  // drops that left
#define DROPS_BORN     6  // residual drops
#define DROPS_MERGED   7  // drops that became part of another
#define DROPS_REMOVED  8  // quanta of drops that were removed, modulo 2^32
#define DROPS_MERGINGS 9  // drops that came about by merging
#define DROPS_MEETS    10 // 1: waters of two owners have met in this step
#define DROPS_TILES    11 // tiles that were awake, in all steps, modulo 2^32
#define DROPS_TALLY    12

// A drop that is new in this step: one that others left or became, or one that landed, which is on
// the pane's maps from the next step on.
#define DROPS_BORN_NOW   1u
#define DROPS_LANDED_NOW 2u

// Streams of random numbers, one a purpose.
#define DROPS_LAND_PLACE  1u
#define DROPS_LAND_MASS   2u
#define DROPS_AFFINITY    3u
#define DROPS_MEANDER     4u
#define DROPS_RESIDUAL    5u
#define DROPS_LAND_CHANCE 6u
#define DROPS_BEADS       7u

// Beads of trails: the squares that have one each, the radius and height of the largest, the size
// of the smallest by it, and the height of water that runs off the glass between them.
#define DROPS_BEAD_SQUARE_MM 4.0f
#define DROPS_BEAD_RADIUS_MM 1.8f
#define DROPS_BEAD_MM        0.48f
#define DROPS_BEAD_LEAST     0.35f
#define DROPS_BEAD_GAP_MM    1.3f

// Bits of the buffer `tiles`, one word for each tile.
#define DROPS_AWAKE   1u // worked on in this step
#define DROPS_STIRRED 2u // worked on in the next one
#define DROPS_SPOILED 4u // drops at rest in it have come or gone in this step

#define DROPS_NOBODY 0xffffffffu
#define DROPS_RISEN  0x80000000u // on the ID map, while a step lasts: the water rose here

RG_STRUCT(drops_drop)
{
    uint id;
    uint parent; // the ID of the drop that left it behind, or 0
    uint mass;   // quanta; 0: it is no more
    float x;     // mm, to the right of the pane's left edge
    float y;     // mm, below the pane's upper edge
    float vx;    // mm/s
    float vy;
    float since_s; // since it left a residual drop
    uint is_new;   // DROPS_BORN_NOW, DROPS_LANDED_NOW or 0
    uint runs;     // 1: it has run in this step
    uint rests;    // 1: its water is on the map of drops at rest
};
RG_STRUCT_SIZE(drops_drop, 11)

// The sums over drops that merge: words of the buffer `sums`, at the drop that leads them.
#define DROPS_SUM_MASS    0 // quanta
#define DROPS_SUM_X       1 // momentum in steps of 1/4 mg mm/s, modulo 2^32
#define DROPS_SUM_Y       2
#define DROPS_SUM_MEMBERS 3
#define DROPS_SUM_DEEPEST 4 // bits of the lowest one's drops_depth
#define DROPS_SUM_LOWEST  5 // its index
#define DROPS_SUM         6

RG_STRUCT(drops_params)
{
    int columns; // cells of the pane
    int rows;
    int stride;       // cells from a row of a map to the next, margins included
    int tile_columns; // tiles across the pane
    int tile_rows;
    float cell_mm;
    uint seed;
    uint step;
    float step_s;
    float substep_s;
    int substep;
    int substeps;
    int count;    // drops
    int most;     // most drops that there may be
    int arrivals; // in this step
    float least_mg;
    float most_mg;
    // Forces (eq. 2): gravity along the pane, and the force that holds a drop, whatever its mass.
    float down_x; // unit vector
    float down_y;
    float gravity_mm_s2;
    float held_mg_mm_s2;
    uint critical; // quanta: heavier drops run
    float meander_rad;
    // Residual drops (eq. 6).
    int residual; // 0: none
    float residual_beta;
    float residual_max_s;
    float residual_low; // shares of the parent's mass
    float residual_high;
    // The regions ahead that a drop chooses among (section 4.1).
    float ahead_mm;
    float beside_mm;
    float patch_mm;  // side of the squares that have one affinity
    int reach_cells; // cells of a region to each side of its middle one
    // Trails.
    int lines; // 1: swept along the way, 0: hemispheres so far apart
    float spacing_mm;
    // The passes over height and ID maps, one or more in a step.
    int apart; // cells between those that it is flattened and thinned with; 1 by the paper's rules
    float dry_mm;   // above 0; lower water is removed
    float owned_mm; // above 0; lower water has no owner
    int down_cell;  // from a cell to the one below it, in cells of a map, as drops run
    int right_cell;
    int is_upright; // 1: water runs down the grid's columns, 0: along its rows
    int does_smooth;
    int does_spread;
    int does_erode;
    int does_sleep; // 0: no tile does
    int slots;      // slots of drops: old ones, their children, and merged ones
    int has_joined; // 1: some have merged in this step
    int is_removal; // 1: all drops go in this step
};
RG_STRUCT_SIZE(drops_params, 47)

// The cell of a map at a column and row of the pane.
RG_FN int drops_cell(drops_params p, int column, int row)
{
    return (row + DROPS_MARGIN) * p.stride + column + DROPS_MARGIN;
}

RG_FN bool drops_on_pane(drops_params p, int column, int row)
{
    return column >= 0 && column < p.columns && row >= 0 && row < p.rows;
}

// The owner of a cell, without the mark that its water rose in this step.
RG_FN uint drops_owner(uint id)
{
    return id & ~DROPS_RISEN;
}

// Whether a place in mm is on the pane.
RG_FN bool drops_holds(drops_params p, float x, float y)
{
    return x >= 0.0f && x < rg_to_float(p.columns) * p.cell_mm && y >= 0.0f &&
           y < rg_to_float(p.rows) * p.cell_mm;
}

// The distance in cells over which a change acts in one pass.
RG_FN int drops_reach(drops_params p)
{
    return 2 * p.apart;
}

RG_FN float drops_mg(uint mass)
{
    return rg_to_float(mass) * (1.0f / DROPS_QUANTA_MG);
}

#endif
