// The pane's maps: hemispheres on them, smoothing, erosion.
#ifndef RG_TESTS_ORACLE_DROPS_MAP_H
#define RG_TESTS_ORACLE_DROPS_MAP_H

#include "tests/oracle/drops/state.h"

// Equation 1, also for places off the pane.
struct oracle_drops_cell {
    int row, column;
};
struct oracle_drops_cell oracle_drops_cell_at(const struct oracle_drops *drops, double x_mm,
                                              double y_mm);
bool oracle_drops_on_pane(const struct oracle_drops *drops, struct oracle_drops_cell cell);

// Equations 7 to 9: places the hemisphere of a mass, wherever it is higher than the water.
void oracle_drops_place(struct oracle_drops *drops, uint32_t id, double x_mm, double y_mm,
                        double mass_mg);
void oracle_drops_smooth(struct oracle_drops *drops);
void oracle_drops_erode(struct oracle_drops *drops);

// Finds the wet part of the pane, after a caller has written heights.
void oracle_drops_find_wet(struct oracle_drops *drops);

#endif
