// The rain that reaches panes.
//
// Wind drives that of sliding drops: Lacy, 1965, has 0.222 R^0.88 mm/h on an upright wall for each
// metre a second of wind, R the rate on level ground (ISO 15927-3). At 10 m/s 20 mm/h become 31.
// The wind carries all drops at its own speed, so their sizes are those of the air: Marshall and
// Palmer's for R.
#include "core/techniques/flow/inputs/rain.h"

#include <math.h>

#include "core/base/log.h"
#include "core/scene/spectrum.h"
#include "core/techniques/flow/inputs/sliding.h"
#include "kernels/dialect/rng.h"

#define WIND_M_S 10.0
#define LEAST_MM 0.5 // the least diameter; smaller drops are many and have little water

// What a function of the C library gives.
static double rounded(double value)
{
    return (double)(float)value;
}

// --- sizes ---

static double slope_of(const struct flow_settings *s)
{
    return rg_marshall_palmer_slope(pow(s->pane_rain_mm_h / (0.222 * WIND_M_S), 1 / 0.88));
}

// The mean of D^3 of all drops larger than d.
static double cubes_beyond(double slope, double d)
{
    return d * d * d + 3 * d * d / slope + 6 * d / (slope * slope) + 6 / (slope * slope * slope);
}

static double mean_volume_mm3(const struct flow_rain *rain)
{
    const double cubes = cubes_beyond(rain->slope, LEAST_MM) -
                         rain->too_large * cubes_beyond(rain->slope, RG_LARGEST_DROP_MM);
    return M_PI / 6 * cubes / (1 - rain->too_large);
}

// The diameter below which this share of drops is.
static double diameter_of(const struct flow_rain *rain, double share)
{
    return rounded(LEAST_MM - log(1 - share * (1 - rain->too_large)) / rain->slope);
}

// --- rates ---

// The mean of a power of the radii of move=paper, which flow_drop spreads as the square t^2 of a
// uniform number: the integral of (least + (most - least) t^2)^power by parts.
static double mean_power(const struct flow_settings *s, int power)
{
    double most = 1, mean = 1;
    for (int n = 1; n <= power; n++) {
        most *= s->drop_radius_max_mm;
        mean = (most + 2 * n * s->drop_radius_min_mm * mean) / (2 * n + 1);
    }
    return mean;
}

// What lands of a drop of move=paper, in the mean; water beyond an edge is lost. Water that is (x,
// y) off its drop's middle is on the pane with a chance of (1 - |x| / side) (1 - |y| / side). Under
// a half ellipse of radius r the mean of |x| is 3/8 r, and that of |x y| is 2 / (5 pi) r^2. No drop
// is wider than the pane.
static double mean_of_paper_mm3(const struct flow_settings *s)
{
    const double side = s->pane_mm;
    const double cubes = mean_power(s, 3) - 0.75 * mean_power(s, 4) / side +
                         2 / (5 * M_PI) * mean_power(s, 5) / (side * side);
    return 2 * M_PI / 3 * cubes * s->height_per_mm * s->relief;
}

static void set_rates(struct flow_rain *rain)
{
    const struct flow_settings *s = rain->settings;
    const double mm3_s = s->pane_mm * s->pane_mm / 3600; // of 1 mm/h
    if (s->move == FLOW_MOVE_PAPER) {
        rain->drops_s = s->rain_drops_s;
        rain->mm_h = s->rain_drops_s * mean_of_paper_mm3(s) / mm3_s;
    } else {
        rain->drops_s =
            s->pane_rain_mm_h > 0 ? s->pane_rain_mm_h * mm3_s / mean_volume_mm3(rain) : 0;
        rain->mm_h = s->pane_rain_mm_h;
    }
    rain->drops_a_frame = rain->drops_s * s->step_s;
}

struct flow_rain flow_rain_of(const struct flow_settings *s)
{
    const double sphere = rounded(1 / sin(s->contact_deg * M_PI / 180));
    const double depth = sqrt(sphere * sphere - 1), height = sphere - depth;
    struct flow_rain rain = {.settings = s,
                             .slope = rounded(slope_of(s)),
                             .sphere_mm = sphere,
                             .depth_mm = depth,
                             .cap_mm3 = M_PI / 6 * height * (3 + height * height)};
    rain.too_large = rounded(exp(-rain.slope * (RG_LARGEST_DROP_MM - LEAST_MM)));
    for (uint pane = 0; pane < FLOW_MAX_PANES; pane++)
        rain.first[pane] = (double)rg_uniform(
            rg_random((uint)s->seed, 0, 0, FLOW_STREAM_SIZES + FLOW_STREAMS_A_PANE * pane).x);
    set_rates(&rain);
    return rain;
}

// Of relief, for the largest drop in a corner, where a pane has a quarter of its contact: floats
// count to the droplet what it brings and, below, what texels hold.
static double relief_of_largest_mm(const struct flow_rain *rain)
{
    const double r = flow_largest_radius_mm(rain), side = fmin(r, rain->settings->pane_mm);
    const double highest_mm = 2.6 * rain->cap_mm3 * r * r * r / (side * side);
    return highest_mm / (2 * (double)FLOW_EDGE_HOLDS);
}

bool flow_rain_fits(const struct flow_rain *rain)
{
    const struct flow_settings *s = rain->settings;
    const double held_mm = flow_least_relief_mm(), largest_mm = relief_of_largest_mm(rain);
    if (s->move == FLOW_MOVE_SLIDING && s->relief < fmax(held_mm, largest_mm))
        return rg_error("relief: %g mm a unit of water is too little to count the highest water of "
                        "move=sliding; take %.9g or more%s",
                        s->relief, ceil(1000 * fmax(held_mm, largest_mm)) / 1000,
                        largest_mm > held_mm ? ", lower drop_radius_max_mm or raise pane_mm" : "");
    if (rain->drops_s > FLOW_MOST_DROPS_S)
        return rg_error("pane_rain_mm_h: %g mm/h on a pane of pane_mm=%g are %.0f drops a second, "
                        "more than %d; lower either",
                        s->pane_rain_mm_h, s->pane_mm, rain->drops_s, FLOW_MOST_DROPS_S);
    return true;
}

// The epsilon lets a number that is whole except for rounding count as whole, whatever step_s is.
int64_t flow_fallen_before(const struct flow_rain *rain, int64_t frame)
{
    const double spare = rain->settings->move == FLOW_MOVE_SLIDING ? 1e-6 : 0;
    return (int64_t)floor((double)frame * rain->drops_a_frame + spare);
}

int flow_drops_at(const struct flow_rain *rain, int64_t frame)
{
    return (int)(flow_fallen_before(rain, frame + 1) - flow_fallen_before(rain, frame));
}

// --- drops ---

static struct flow_drop drop_at(const struct flow_settings *s, int pane, rg_uint4 w)
{
    return (struct flow_drop){.pane = pane,
                              .x_mm = (double)rg_uniform(w.x) * s->pane_mm,
                              .y_mm = (double)rg_uniform(w.y) * s->pane_mm};
}

// The product of two uniform numbers spreads the radii: more drops are small than of move=paper
// (flow_drop), since large ones slide off at once.
struct flow_drop flow_initial_drop(const struct flow_rain *rain, int pane, int number)
{
    const struct flow_settings *s = rain->settings;
    const uint stream = FLOW_STREAM_SEEDED + FLOW_STREAMS_A_PANE * (uint)pane;
    const rg_uint4 w = rg_random((uint)s->seed, (uint)number, 0, stream);
    struct flow_drop drop = drop_at(s, pane, w);
    const double t = (double)rg_uniform(w.z) * (double)rg_uniform(w.w);
    const double r = s->drop_radius_min_mm + (s->drop_radius_max_mm - s->drop_radius_min_mm) * t;
    drop.radius_mm = r;
    drop.volume_mm3 = rain->cap_mm3 * r * r * r;
    return drop;
}

static double radius_of(const struct flow_rain *rain, double volume_mm3)
{
    return rounded(cbrt(volume_mm3 / rain->cap_mm3));
}

// Sizes follow one another by the golden ratio, so that a second of rain has all of them in their
// shares, and its rate.
struct flow_drop flow_falling_drop(const struct flow_rain *rain, int pane, int64_t number)
{
    const struct flow_settings *s = rain->settings;
    const uint stream = FLOW_STREAM_RAIN + FLOW_STREAMS_A_PANE * (uint)pane;
    struct flow_drop drop = drop_at(s, pane, rg_random((uint)s->seed, (uint)number, 0, stream));
    const double share = flow_fraction(rain->first[pane] + flow_even(number));
    drop.volume_mm3 = rg_drop_volume_mm3(diameter_of(rain, share));
    drop.radius_mm = radius_of(rain, drop.volume_mm3);
    return drop;
}

double flow_largest_radius_mm(const struct flow_rain *rain)
{
    const struct flow_settings *s = rain->settings;
    return fmax(fmax(s->drop_radius_min_mm, s->drop_radius_max_mm),
                radius_of(rain, rg_drop_volume_mm3(RG_LARGEST_DROP_MM)));
}

double flow_cap_height_mm(const struct flow_rain *rain, double radius_mm, double distance2_mm2)
{
    const double sphere_mm = rain->sphere_mm * radius_mm;
    if (distance2_mm2 >= radius_mm * radius_mm)
        return 0;
    return fmax(sqrt(sphere_mm * sphere_mm - distance2_mm2) - rain->depth_mm * radius_mm, 0);
}
