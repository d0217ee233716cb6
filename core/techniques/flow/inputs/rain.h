// Rain that reaches panes of sliding drops: how much, of which sizes, and the caps that its drops
// form.
#ifndef RG_CORE_TECHNIQUES_FLOW_INPUTS_RAIN_H
#define RG_CORE_TECHNIQUES_FLOW_INPUTS_RAIN_H

#include "core/techniques/flow/inputs/flow.h"

// A drop that lands: a cap on a pane.
struct flow_drop {
    int pane;
    double x_mm, y_mm; // its middle, from the pane's upper left corner
    double volume_mm3;
    double radius_mm; // of its contact with the glass
};

// The rate at which water reaches a pane, in the mean, by either movement.
double flow_pane_rain_mm_h(const struct flow_settings *settings);
// Drops that fall on a pane a second, by either movement.
double flow_rain_drops_s(const struct flow_settings *settings);
// The most that the radius of a drop's contact can be.
double flow_largest_radius_mm(const struct flow_settings *settings);
// A drop of move=sliding by its number on a pane: one of the initial ones, or of those that fall.
struct flow_drop flow_initial_drop(const struct flow_settings *settings, int pane, int number);
struct flow_drop flow_falling_drop(const struct flow_settings *settings, int pane, int64_t number);
// The height of a drop at a distance from its middle, in millimetres; 0 beside it.
double flow_drop_height_mm(const struct flow_settings *settings, double radius_mm,
                           double distance_mm);

#endif
