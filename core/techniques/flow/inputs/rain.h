// Rain that reaches panes: how much of it, and, for move=sliding, of which sizes, and the caps that
// its drops form.
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

// What settings make of rain, computed once. Results of the C library's functions are rounded to
// float, so that panes are the same with every library (core/scene/camera.c).
struct flow_rain {
    const struct flow_settings *settings; // the caller's, which must outlive this
    double mm_h;                          // at which water reaches a pane, in the mean
    double drops_s, drops_a_frame;        // that fall on a pane
    // Of move=sliding: how fast the number of drops falls with their diameter, in 1/mm; and the
    // share of those above the least that are larger than the largest, and left out.
    double slope, too_large;
    double first[FLOW_MAX_PANES]; // the share of drops that are smaller than a pane's first
    // A cap with a contact of radius 1 mm: its sphere's radius, how deep the sphere's middle lies
    // below the glass, and its volume.
    double sphere_mm, depth_mm, cap_mm3;
};

struct flow_rain flow_rain_of(const struct flow_settings *settings);
// False, with one logged line, if more drops fall than FLOW_MOST_DROPS_S, or if water of
// move=sliding stands higher than a texel can count.
bool flow_rain_fits(const struct flow_rain *rain);

// The number of drops that have fallen on a pane before a frame: constant on average, not random.
int64_t flow_fallen_before(const struct flow_rain *rain, int64_t frame);
// The number of those that fall in a frame.
int flow_drops_at(const struct flow_rain *rain, int64_t frame);

// The most that the radius of a drop's contact can be.
double flow_largest_radius_mm(const struct flow_rain *rain);
// A drop of move=sliding by its number on a pane: one of the initial ones, or of those that fall.
struct flow_drop flow_initial_drop(const struct flow_rain *rain, int pane, int number);
struct flow_drop flow_falling_drop(const struct flow_rain *rain, int pane, int64_t number);
// The height of a drop where the square of the distance from its middle is so much; 0 beside it.
double flow_cap_height_mm(const struct flow_rain *rain, double radius_mm, double distance2_mm2);

#endif
