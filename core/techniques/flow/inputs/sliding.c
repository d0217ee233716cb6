// The host's part of sliding drops: the runs of a frame, the kernels' parameters, and the distances
// that water slides.
#include "core/techniques/flow/inputs/sliding.h"

#include <math.h>

// The least width of a lattice's cell, unless a texel is wider.
#define CELL_MM 1.1
// The variance that one run of flow_smooth adds along an axis. The pull is smoothed twice, the
// amount of water around a place four times.
#define SMOOTHED_MM2 0.69
#define AROUND_RUNS  4
#define REACH_MM     3.7  // how far a drop's middle carries water along
#define ASIDE_MM     2.0  // from a drop's axis to its flanks
#define LONGEST_MM   1.4  // the farthest that water slides in a run, so that drops keep their speed
#define LEVELLED     0.22 // the most that levels in a run; at a quarter it oscillates
#define BENT_MM      0.8
#define LEAST_MM     0.4
#define MOST_MM      1.0
#define FAR_MM       1.2  // the farthest texels that level with one another
#define NEAR_MM      1.45 // how far away wet glass counts
#define TENSION_MM   0.3  // the pull of glass that is all wet, as a height of water
#define JOINED_MM    0.03 // height above which water of cells or texels forms one drop
#define FILM_MM      0.06 // height of water from which on glass counts as wet
// A dry texel gets wet by any water where this share of the glass around is wet, and by water as
// steep as contact_slope where it is less by 1 / STEEPER.
#define FILL     0.5
#define STEEPER  5.0
#define HOLDS_MM 40.0 // a texel; water above it drips off
// Surface tension over the weight of a volume, of water at 20 degrees: 0.0728 N/m, 998 kg/m3.
#define CAPILLARY_MM2 7.44

static int texels_a_cell(const struct flow_settings *s)
{
    return (int)fmax(ceil(CELL_MM / flow_texel_mm(s) - 1e-9), 1);
}

// In units of water, which a float counts to the droplet.
double flow_least_relief_mm(void)
{
    return HOLDS_MM / (double)FLOW_EDGE_HOLDS;
}

int flow_lattice_cells(const struct flow_settings *s)
{
    const int k = texels_a_cell(s);
    return (s->resolution_px + k - 1) / k;
}

int flow_slide_runs(const struct flow_settings *s)
{
    const double way_mm = s->slide_most_mm_s * s->step_s;
    const double longest_mm = fmin(LONGEST_MM, FLOW_MARGIN * flow_texel_mm(s));
    // A texel is the shortest distance that water can slide.
    return (int)fmax(ceil(way_mm / fmax(longest_mm, flow_texel_mm(s)) - 1e-9), 1);
}

static double run_s(const struct flow_settings *s)
{
    return s->step_s / flow_slide_runs(s);
}

// The share of a height difference that levels between two texels in a run of the whole time.
static double levelled(const struct flow_settings *s)
{
    return s->levelling_mm_s * run_s(s) * MOST_MM / (flow_texel_mm(s) * flow_texel_mm(s));
}

// Texels between those that tell how wet the glass is around a place, so that a step of four
// reaches NEAR_MM; how many steps that is; and the sum of their weights.
static int apart(const struct flow_settings *s)
{
    return (int)fmax(ceil(NEAR_MM / (5 * flow_texel_mm(s)) - 1e-9), 1);
}

static double near_steps(const struct flow_settings *s)
{
    return fmax(NEAR_MM / (apart(s) * flow_texel_mm(s)), 1);
}

static double near_scale(const struct flow_settings *s)
{
    double sum = near_steps(s);
    for (int away = 1; away <= 4; away++)
        sum += 2 * fmax(near_steps(s) - away, 0);
    return 1 / (sum * sum);
}

// One round of levelling: texels far apart twice, then at half the distance, and so on down to
// neighbours. It ends with the row that the texels' width allows.
static const int reaches[] = {4, 4, 2, 2, 1};
enum { REACHES = sizeof(reaches) / sizeof(reaches[0]) };

static int first_reach(const struct flow_settings *s)
{
    int first = 0;
    while (reaches[first] > 1 && reaches[first] * flow_texel_mm(s) > FAR_MM)
        first++;
    return first;
}

// Runs between neighbours that would level as far as a round.
static int neighbours_a_round(const struct flow_settings *s)
{
    int sum = 0;
    for (int i = first_reach(s); i < REACHES; i++)
        sum += reaches[i] * reaches[i];
    return sum;
}

static int relax_rounds(const struct flow_settings *s)
{
    return (int)ceil(levelled(s) / neighbours_a_round(s) / LEVELLED);
}

int flow_relax_runs(const struct flow_settings *s)
{
    return relax_rounds(s) * (REACHES - first_reach(s));
}

int flow_relax_reach(const struct flow_settings *s, int run)
{
    return reaches[first_reach(s) + run % (REACHES - first_reach(s))];
}

static double slowest_mm_s(const struct flow_settings *s)
{
    return s->slide_most_mm_s * pow(FLOW_PACE_RATIO, 2 - FLOW_PACES);
}

// The water around the middle of a cap, in the middle of a cell: its water under the Gaussian of
// AROUND_RUNS runs, which the mean over a cell widens.
static double around_mm3(const struct flow_settings *s, double radius_mm)
{
    enum { STEPS = 100 };
    const double cell_mm = texels_a_cell(s) * flow_texel_mm(s), step_mm = radius_mm / STEPS;
    const double smoothed_mm2 = AROUND_RUNS * SMOOTHED_MM2;
    const double all_mm2 = smoothed_mm2 + cell_mm * cell_mm / 12;
    const double sphere_mm = radius_mm / sin(s->contact_deg * M_PI / 180);
    const double depth_mm = sphere_mm * cos(s->contact_deg * M_PI / 180);
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double r = (i + 0.5) * step_mm;
        sum += 2 * M_PI * r * step_mm * (sqrt(sphere_mm * sphere_mm - r * r) - depth_mm) *
               exp(-r * r / (2 * all_mm2));
    }
    return sum * smoothed_mm2 / all_mm2;
}

// The radius of the contact. Water slides that would at the slowest pace.
static double held_radius_mm(const struct flow_settings *s)
{
    const double most_mm3 = s->slide_gain_mm_s > 0
                                ? s->slide_above_mm3 * (1 + slowest_mm_s(s) / s->slide_gain_mm_s)
                                : INFINITY;
    double least = 0, most = s->pane_mm;
    for (int i = 0; i < 40; i++) {
        const double middle = (least + most) / 2;
        *(around_mm3(s, middle) < most_mm3 ? &least : &most) = middle;
    }
    return least;
}

struct flow_held flow_held_of(const struct flow_settings *s)
{
    const double r = held_radius_mm(s), height = r * tan(s->contact_deg * M_PI / 360);
    const double mm3 = M_PI / 6 * height * (3 * r * r + height * height);
    const double cosine = cos(s->contact_deg * M_PI / 180) + mm3 / (2 * r * CAPILLARY_MM2);
    return (struct flow_held){
        .mm3 = (double)(float)mm3,
        .receding_deg = cosine < 1 ? (double)(float)(acos(cosine) * 180 / M_PI) : 0,
    };
}

flow_slide_params flow_slide_params_at(const struct flow_settings *s, int64_t run)
{
    const int k = texels_a_cell(s);
    const double cell_mm = k * flow_texel_mm(s), cell_mm2 = cell_mm * cell_mm;
    // The area of a Gaussian after this many runs; at least a cell.
    const double around_mm2 = fmax(2 * M_PI * AROUND_RUNS * SMOOTHED_MM2, cell_mm2);
    const double to_height = 1 / s->relief;
    return (flow_slide_params){
        .size = s->resolution_px,
        .cells = flow_lattice_cells(s),
        .texels_a_cell = k,
        .side_weight = (float)(SMOOTHED_MM2 / (2 * cell_mm2)),
        .slides_above = (float)(s->slide_above_mm3 / around_mm2 * to_height),
        .gain_mm_s = (float)s->slide_gain_mm_s,
        .slowest_mm_s = (float)slowest_mm_s(s),
        .reach2 = (float)(REACH_MM * REACH_MM / cell_mm2),
        .aside = (float)fmin(ASIDE_MM / cell_mm, FLOW_MARGIN - 2),
        .levelling = (float)(levelled(s) / MOST_MM * s->relief /
                             fmax(relax_rounds(s) * neighbours_a_round(s), 1)),
        .bent = (float)(BENT_MM * to_height),
        .least_layer = (float)(LEAST_MM * to_height),
        .most_layer = (float)(MOST_MM * to_height),
        .advance = (float)(s->contact_slope * flow_texel_mm(s) * to_height),
        .cohesion = (float)s->cohesion,
        .dried2 = (float)(2 * s->drying_mm2_s * run_s(s) * to_height * to_height),
        .part = (float)flow_even(run), // so that runs, rounded, add up to the whole
        .holds = (float)(HOLDS_MM * to_height),
        .joined = (float)(JOINED_MM * to_height),
        .wet_per_height = (float)(s->relief / FILM_MM),
        .fill = (float)FILL,
        .tension = (float)(TENSION_MM * to_height),
        .steeper = (float)STEEPER,
        .apart = apart(s),
        .near = (float)near_steps(s),
        .near_scale = (float)near_scale(s),
    };
}

// Rounds to whole texels, so that the distances of all runs add up to the exact one.
static int32_t whole(double texels, int64_t run)
{
    return fabs(texels) < 1e-9 ? 0 : (int32_t)floor(texels + flow_even(run));
}

void flow_ways_at(const struct flow_settings *s, int64_t frame, int64_t run, int32_t *ways)
{
    for (int pane = 0; pane < flow_pane_count(s); pane++) {
        double axes[3][3];
        flow_pane_frame(s, pane, frame, axes);
        const double gx = -axes[0][1], gy = -axes[1][1]; // of (0, -1, 0) in the world
        const double along = fmax(sqrt(gx * gx + gy * gy), 1e-6);
        for (int pace = 0; pace < FLOW_PACES; pace++) {
            const double speed_mm_s =
                pace ? s->slide_most_mm_s * pow(FLOW_PACE_RATIO, pace + 1 - FLOW_PACES) : 0;
            const double texels = speed_mm_s * run_s(s) / flow_texel_mm(s);
            int32_t *way = &ways[2 * (pane * FLOW_PACES + pace)];
            way[0] = whole(texels * gx / along, run);
            way[1] = whole(texels * gy / along, run);
        }
    }
}
