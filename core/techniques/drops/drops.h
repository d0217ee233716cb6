// drops: drops that run down a pane, follow trails, merge and leave others on their way, after A.
// Chin, "Animating Raindrops on a Surface". docs/drops.md explains.
#ifndef RG_CORE_TECHNIQUES_DROPS_DROPS_H
#define RG_CORE_TECHNIQUES_DROPS_DROPS_H

#include "core/techniques/params.h"

enum drops_rules { DROPS_PAPER, DROPS_PHYSICAL };
enum drops_trail { DROPS_HEMISPHERES, DROPS_LINES, DROPS_TRAIL_BEADS };
enum drops_view {
    DROPS_VIEW_PANE,
    DROPS_VIEW_HEIGHT,
    DROPS_VIEW_IDS,
    DROPS_VIEW_PARTICLES,
    DROPS_VIEWS
};

struct drops_settings {
    int seed;
    // The pane.
    int columns, rows; // cells
    double cell_mm;
    double tilt_deg; // 90: upright
    double turn_deg; // rotation of the pane in its plane; 180: upside down
    // Drops.
    int max_drops;
    double drops_s; // drops that land a second
    double critical_mass_mg, max_mass_mg;
    double meander_rad;
    double residual_beta, residual_max_s, residual_low, residual_high;
    // Time.
    double step_s;
    int substeps;
    double remove_s; // time at which all drops are removed; below 0: never
    // Maps.
    int rules; // enum drops_rules
    int trail; // enum drops_trail
    double erode_mm, owned_mm;
    int erode, merge, residual, smooth; // 1: on
    int sleep;
    // The picture.
    int view;                        // enum drops_view
    double distance_mm, aperture_mm; // of the camera
    double refractive_index, contact_mm;
    int rays_px; // rays along each side of a pixel
    char environment[RG_PATH_SIZE], background[RG_PATH_SIZE];
    int environment_px;
    double background_m, background_deg;
};

extern const struct rg_param_table drops_param_table;

#endif
