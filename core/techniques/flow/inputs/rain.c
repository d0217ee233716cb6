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
#define GOLDEN   0.6180339887498949

enum { STREAM_SEEDED = 1, STREAM_RAIN = 2, STREAM_SIZES = 4, STREAMS_A_PANE = 16 };

// --- sizes ---

// The exponent of the diameters' exponential distribution, in 1/mm.
static double slope_of(const struct flow_settings *s)
{
    const double rain_mm_h = pow(s->pane_rain_mm_h / (0.222 * WIND_M_S), 1 / 0.88);
    const struct rg_spectrum spectrum = {.kind = RG_MARSHALL_PALMER,
                                         .law = RG_GUNN_KINZER,
                                         .rain_mm_h = rain_mm_h,
                                         .least_mm = LEAST_MM,
                                         .most_mm = RG_LARGEST_DROP_MM};
    return log(rg_spectrum_density(&spectrum, 1) / rg_spectrum_density(&spectrum, 2));
}

static double sphere_mm3(double diameter_mm)
{
    return M_PI / 6 * pow(diameter_mm, 3);
}

// The integral of D^3 times the distribution, from D on.
static double cubes_beyond(double slope, double d)
{
    const double x = slope * d;
    return exp(-x) * (x * x * x + 3 * x * x + 6 * x + 6) / pow(slope, 3);
}

static double mean_volume_mm3(double slope)
{
    const double cubes = cubes_beyond(slope, LEAST_MM) - cubes_beyond(slope, RG_LARGEST_DROP_MM);
    return M_PI / 6 * cubes / (exp(-slope * LEAST_MM) - exp(-slope * RG_LARGEST_DROP_MM));
}

// The diameter below which this share of drops is.
static double diameter_of(double slope, double share)
{
    const double from = exp(-slope * LEAST_MM), to = exp(-slope * RG_LARGEST_DROP_MM);
    return -log(from + share * (to - from)) / slope;
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

static double fraction(double x)
{
    return x - floor(x);
}

static struct flow_drop drop_at(const struct flow_settings *s, int pane, rg_uint4 w)
{
    return (struct flow_drop){.pane = pane,
                              .x_mm = (double)rg_uniform(w.x) * s->pane_mm,
                              .y_mm = (double)rg_uniform(w.y) * s->pane_mm};
}

struct flow_drop flow_initial_drop(const struct flow_settings *s, int pane, int number)
{
    const uint stream = STREAM_SEEDED + STREAMS_A_PANE * (uint)pane;
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
    const uint streams = STREAMS_A_PANE * (uint)pane;
    const rg_uint4 w = rg_random((uint)s->seed, (uint)number, 0, STREAM_RAIN + streams);
    const rg_uint4 first = rg_random((uint)s->seed, 0, 0, STREAM_SIZES + streams);
    struct flow_drop drop = drop_at(s, pane, w);
    const double share = fraction((double)rg_uniform(first.x) + (double)number * GOLDEN);
    drop.volume_mm3 = sphere_mm3(diameter_of(slope_of(s), share));
    drop.radius_mm = cbrt(drop.volume_mm3 / volume_a_cube(s));
    return drop;
}

double flow_largest_radius_mm(const struct flow_settings *s)
{
    const double rain_mm = cbrt(sphere_mm3(RG_LARGEST_DROP_MM) / volume_a_cube(s));
    return fmax(fmax(s->drop_radius_min_mm, s->drop_radius_max_mm), rain_mm);
}

double flow_drop_height_mm(const struct flow_settings *s, double radius_mm, double distance_mm)
{
    const double angle = s->contact_deg * M_PI / 180, sphere_mm = radius_mm / sin(angle);
    if (distance_mm >= radius_mm)
        return 0;
    return sqrt(sphere_mm * sphere_mm - distance_mm * distance_mm) - sphere_mm * cos(angle);
}
