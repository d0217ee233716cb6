// The rain that reaches panes of sliding drops.
//
// Wind drives it: Lacy, 1965, has 0.222 R^0.88 mm/h on an upright wall for each metre a second of
// wind, R the rate on level ground (ISO 15927-3). At 10 m/s 20 mm/h become 31. The wind carries all
// drops at its own speed, so their sizes are those of the air: Marshall and Palmer's for R.
#include "core/techniques/flow/inputs/rain.h"

#include <math.h>

#include "core/scene/spectrum.h"
#include "kernels/dialect/rng.h"

#define WIND_M_S 10.0
#define LEAST_MM 0.5 // the least diameter; smaller drops are many and have little water

// --- sizes ---

// How fast the number of drops falls with their diameter, in 1/mm.
static double slope_of(const struct flow_settings *s)
{
    return rg_marshall_palmer_slope(pow(s->pane_rain_mm_h / (0.222 * WIND_M_S), 1 / 0.88));
}

// The mean of D^3 of all drops larger than d.
static double cubes_beyond(double slope, double d)
{
    return d * d * d + 3 * d * d / slope + 6 * d / (slope * slope) + 6 / (slope * slope * slope);
}

// The share of drops larger than the least that are larger than the largest, and left out.
static double too_large(double slope)
{
    return exp(-slope * (RG_LARGEST_DROP_MM - LEAST_MM));
}

static double mean_volume_mm3(double slope)
{
    const double cubes =
        cubes_beyond(slope, LEAST_MM) - too_large(slope) * cubes_beyond(slope, RG_LARGEST_DROP_MM);
    return M_PI / 6 * cubes / (1 - too_large(slope));
}

// The diameter below which this share of drops is.
static double diameter_of(double slope, double share)
{
    return LEAST_MM - log(1 - share * (1 - too_large(slope))) / slope;
}

// --- rates ---

// Of drops with the profile of a half ellipse, whose radii flow_drop spreads as the product of two
// uniform numbers.
static double mean_of_paper_mm3(const struct flow_settings *s)
{
    const double r = s->drop_radius_min_mm, d = s->drop_radius_max_mm - r;
    const double cubes = r * r * r + 3 * r * r * d / 4 + 3 * r * d * d / 9 + d * d * d / 16;
    return 2 * M_PI / 3 * cubes * s->height_per_mm * s->relief;
}

static double mm3_of_rate(const struct flow_settings *s, double mm_h)
{
    return mm_h / 3600 * s->pane_mm * s->pane_mm; // a second
}

double flow_pane_rain_mm_h(const struct flow_settings *s)
{
    if (s->move == FLOW_MOVE_SLIDING)
        return s->pane_rain_mm_h;
    return s->rain_drops_s * mean_of_paper_mm3(s) / mm3_of_rate(s, 1);
}

double flow_rain_drops_s(const struct flow_settings *s)
{
    if (s->move == FLOW_MOVE_PAPER)
        return s->rain_drops_s;
    return s->pane_rain_mm_h > 0 ? mm3_of_rate(s, s->pane_rain_mm_h) / mean_volume_mm3(slope_of(s))
                                 : 0;
}

// --- drops ---

// The volume of a cap by the cube of its contact's radius.
static double volume_a_cube(const struct flow_settings *s)
{
    const double angle = s->contact_deg * M_PI / 180, c = cos(angle);
    return M_PI / 3 * (2 - 3 * c + c * c * c) / pow(sin(angle), 3);
}

static struct flow_drop drop_at(const struct flow_settings *s, int pane, rg_uint4 w)
{
    return (struct flow_drop){.pane = pane,
                              .x_mm = (double)rg_uniform(w.x) * s->pane_mm,
                              .y_mm = (double)rg_uniform(w.y) * s->pane_mm};
}

struct flow_drop flow_initial_drop(const struct flow_settings *s, int pane, int number)
{
    const uint stream = FLOW_STREAM_SEEDED + FLOW_STREAMS_A_PANE * (uint)pane;
    const rg_uint4 w = rg_random((uint)s->seed, (uint)number, 0, stream);
    struct flow_drop drop = drop_at(s, pane, w);
    const double t = (double)rg_uniform(w.z) * (double)rg_uniform(w.w);
    drop.radius_mm = s->drop_radius_min_mm + (s->drop_radius_max_mm - s->drop_radius_min_mm) * t;
    drop.volume_mm3 = volume_a_cube(s) * pow(drop.radius_mm, 3);
    return drop;
}

// Sizes follow one another by the golden ratio, so that a second of rain has all of them in their
// shares, and its rate.
struct flow_drop flow_falling_drop(const struct flow_settings *s, int pane, int64_t number)
{
    const uint streams = FLOW_STREAMS_A_PANE * (uint)pane;
    const rg_uint4 w = rg_random((uint)s->seed, (uint)number, 0, FLOW_STREAM_RAIN + streams);
    const rg_uint4 first = rg_random((uint)s->seed, 0, 0, FLOW_STREAM_SIZES + streams);
    struct flow_drop drop = drop_at(s, pane, w);
    const double share = flow_fraction((double)rg_uniform(first.x) + flow_even(number));
    drop.volume_mm3 = rg_drop_volume_mm3(diameter_of(slope_of(s), share));
    drop.radius_mm = cbrt(drop.volume_mm3 / volume_a_cube(s));
    return drop;
}

double flow_largest_radius_mm(const struct flow_settings *s)
{
    const double rain_mm = cbrt(rg_drop_volume_mm3(RG_LARGEST_DROP_MM) / volume_a_cube(s));
    return fmax(fmax(s->drop_radius_min_mm, s->drop_radius_max_mm), rain_mm);
}

double flow_drop_height_mm(const struct flow_settings *s, double radius_mm, double distance_mm)
{
    const double angle = s->contact_deg * M_PI / 180, sphere_mm = radius_mm / sin(angle);
    if (distance_mm >= radius_mm)
        return 0;
    return sqrt(sphere_mm * sphere_mm - distance_mm * distance_mm) - sphere_mm * cos(angle);
}
