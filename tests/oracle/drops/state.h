// The model of raindrops between steps. x is to the right and y up, from the pane's lower left
// corner; row 0 of the maps is at the top.
#ifndef RG_TESTS_ORACLE_DROPS_STATE_H
#define RG_TESTS_ORACLE_DROPS_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "tests/oracle/drops/random.h"

#define ORACLE_DROPS_GRAVITY_MM_S2  9800.0
#define ORACLE_DROPS_DENSITY_MG_MM3 1.0

struct oracle_drops_settings {
    int columns, rows;
    double cell_mm;
    int max_drops;
    double drops_a_step; // the expected number; see drops.h
    double critical_mass_mg, max_mass_mg;
    double tilt_deg; // 90: the pane is vertical
    double step_s;
    int substeps;
    double meander_rad;
    double residual_beta, residual_tau_max_s;
    double residual_share_low, residual_share_high; // of the parent's mass
    double erode_threshold_mm, id_threshold_mm;
    bool erode, smooth, residual, merge;
    bool trail; // hemispheres between a drop's old place and its new one
    uint64_t seed;
};

struct oracle_drop {
    uint32_t id, parent_id; // parent_id: of the drop that left this one, or 0
    double x_mm, y_mm;
    double vx_mm_s, vy_mm_s;
    double mass_mg;
    double tau_s;   // since it last left a residual drop
    bool is_static; // too light to run
    bool gone;      // over the edge or merged; the step then removes it
};

// Sums since the start. generated = on the pane + drained + deleted.
struct oracle_drops_ledger {
    double generated_mg, drained_mg, deleted_mg;
    int generated_drops, drained_drops, merges, residuals;
    double trail_mm;
};

struct oracle_drops {
    struct oracle_drops_settings settings;
    struct oracle_drop *drops; // by rising ID
    int count;
    double *height_mm; // rows x columns
    uint32_t *id;      // rows x columns; 0: no owner
    double *affinity;  // rows x columns, 0 to 1
    struct oracle_drops_ledger ledger;

    // Only the model needs the rest.
    int room;   // the number of drops that fit
    int *place; // an ID's index in `drops`, -1: it has ended
    uint32_t next_id, id_room;
    struct {
        int row0, row1, column0, column1;
    } wet;           // outside it the pane is dry; row1 and column1 are exclusive
    double *sums[3]; // a row each
    int *stack;      // rows x columns
    struct oracle_random random;
};

#endif
