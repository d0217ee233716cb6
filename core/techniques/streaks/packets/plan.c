// Decides the number of particles and their scheme.
#include <math.h>

#include "core/base/log.h"
#include "core/techniques/streaks/packets/inner.h"

const char *streaks_scheme_name(enum streaks_scheme scheme)
{
    static const char *const names[] = {"auto", "world", "kd", "quad", "grid"};
    return names[scheme];
}

// --- the amount (section 4.3.2) ---

static double densest_m3(const struct streaks_packets_settings *settings)
{
    return settings->drops_m2_s / settings->fall_speed_m_s;
}

static double amount(const struct rg_rain_space *space, const struct rg_density *density,
                     const struct streaks_packets_settings *settings)
{
    const double volume = 4 * space->half_x_m * space->half_y_m * settings->local_height_m;
    return rint(densest_m3(settings) * rg_density_mean(density) * volume);
}

static bool above_zero(double value)
{
    return isfinite(value) && value > 0;
}

int64_t streaks_packets_total(const struct rg_rain_space *space, const struct rg_density *density,
                              const struct streaks_packets_settings *settings)
{
    if (!above_zero(settings->drops_m2_s) || !above_zero(settings->fall_speed_m_s) ||
        !above_zero(settings->local_height_m))
        return 0;
    const double total = amount(space, density, settings);
    return total <= INT32_MAX ? (int64_t)total : 0;
}

bool streaks_plan_amount(const struct rg_rain_space *space, const struct rg_density *density,
                         const struct streaks_packets_settings *settings, int64_t *whole)
{
    if (!above_zero(settings->drops_m2_s))
        return rg_error("rain: %g drops a square metre and second; give a number above 0",
                        settings->drops_m2_s);
    if (!above_zero(settings->fall_speed_m_s))
        return rg_error("rain: drops fall at %g m/s; give a speed above 0",
                        settings->fall_speed_m_s);
    if (!above_zero(settings->local_height_m))
        return rg_error("rain: a local space of %g m; give a height above 0",
                        settings->local_height_m);
    if (settings->packet_size < 1)
        return rg_error("rain: packets of %d particles; give at least 1", settings->packet_size);
    if (settings->scheme < STREAKS_AUTO || settings->scheme > STREAKS_GRID)
        return rg_error("rain: unknown packets %d; give auto, world, kd, quad or grid",
                        (int)settings->scheme);
    const double total = amount(space, density, settings);
    if (!(total >= 1))
        return rg_error("rain: less than one particle in %g m x %g m x %g m; raise %s or "
                        "local_height_m",
                        2 * space->half_x_m, 2 * space->half_y_m, settings->local_height_m,
                        settings->amount);
    if (total > INT32_MAX)
        return rg_error(
            "rain: %.6g particles in the local space, at most %d can be told apart; lower "
            "%s, or local_height_m, now %g",
            total, INT32_MAX, settings->amount, settings->local_height_m);
    *whole = (int64_t)total;
    return true;
}

// --- plans: packets and memory of each scheme, before memory is taken ---

int64_t streaks_tree_bytes(int64_t nodes, int64_t packets)
{
    return nodes * (int64_t)sizeof(struct streaks_node) +
           packets * (int64_t)sizeof(struct streaks_packet);
}

// The bytes of particles and of their blocks' boxes.
static int64_t bytes_of(int64_t slots, bool by_id)
{
    return slots * STREAKS_PARTICLE_BYTES +
           (by_id ? 0 : slots / STREAKS_BLOCK * STREAKS_BOUNDS_BYTES);
}

static struct streaks_plan plan_world(const struct streaks_packets_settings *settings,
                                      int64_t total)
{
    const int64_t slots = streaks_padded(total);
    return (struct streaks_plan){STREAKS_WORLD, 1, slots, bytes_of(slots, settings->by_id)};
}

// A packet's last block is half empty on average; at most 31 of its particles are padding.
static int64_t slots_of(int64_t total, int64_t packets, bool by_id)
{
    return by_id ? streaks_padded(total) : total + packets * (STREAKS_BLOCK - 1);
}

static int64_t most3(int64_t a, int64_t b, int64_t c)
{
    const int64_t most = a > b ? a : b;
    return most > c ? most : c;
}

static struct streaks_plan plan_kd(const struct streaks_packets_settings *settings, int64_t total)
{
    const int64_t packets = streaks_kd_leaves(total, settings->packet_size);
    const int64_t slots = slots_of(total, packets, settings->by_id);
    const int64_t halving = total * (STREAKS_PARTICLE_BYTES + 2 * STREAKS_ID_BYTES);
    const int64_t gathering =
        total * (STREAKS_PARTICLE_BYTES + STREAKS_ID_BYTES) + slots * STREAKS_PARTICLE_BYTES;
    return (struct streaks_plan){
        STREAKS_KD, packets, slots,
        streaks_tree_bytes(2 * packets, packets) +
            most3(settings->by_id ? 0 : gathering, halving, bytes_of(slots, settings->by_id))};
}

// Counts leaves without storing particles.
static struct streaks_plan plan_quad(const struct streaks_packets_settings *settings,
                                     const struct streaks_scatter *scatter, int64_t total)
{
    const int64_t packets = streaks_scatter_quads(scatter, total, settings->packet_size);
    const int64_t slots = slots_of(total, packets, settings->by_id);
    return (struct streaks_plan){STREAKS_QUAD, packets, slots,
                                 streaks_tree_bytes(4 * packets, 2 * packets) +
                                     bytes_of(slots, settings->by_id)};
}

static struct streaks_plan plan_grid(const struct streaks_grid *grid)
{
    const int64_t slots = streaks_grid_slots(grid);
    return (struct streaks_plan){STREAKS_GRID, streaks_grid_buckets(grid), slots,
                                 bytes_of(slots, false) + (int64_t)grid->across * grid->down};
}

// The memory that may be taken, limited by the range of packet and buffer indices.
static int64_t allowed(const struct streaks_packets_settings *settings)
{
    const int64_t most =
        (int64_t)STREAKS_BUFFER_LIMIT * STREAKS_BUFFER_PARTICLES * STREAKS_PARTICLE_BYTES;
    return settings->memory_bytes < most ? settings->memory_bytes : most;
}

static bool fits(const struct streaks_packets_settings *settings, const struct streaks_plan *plan)
{
    return plan->peak_bytes <= allowed(settings);
}

static bool refuse(const struct streaks_packets_settings *settings, const struct streaks_plan *plan,
                   int64_t total)
{
    return rg_unsupported(
        "rain: %lld particles in %lld packets (%s) take %.1f MiB, more than the %.1f "
        "MiB allowed; lower %s or local_height_m, choose other packets, or raise memory_mb",
        (long long)total, (long long)plan->packets, streaks_scheme_name(plan->scheme),
        (double)plan->peak_bytes / (1 << 20), (double)allowed(settings) / (1 << 20),
        settings->amount);
}

static bool refuse_cells(const struct streaks_packets_settings *settings)
{
    return rg_error("rain: packets of %d particles need a grid of more than %d cells; use larger "
                    "ones, or a tree",
                    settings->packet_size, STREAKS_MAX_CELLS);
}

// The plan that fits. If both fit, the one with fewer packets; if neither fits, the one that takes
// less memory.
static struct streaks_plan better(const struct streaks_packets_settings *settings,
                                  struct streaks_plan a, struct streaks_plan b)
{
    const bool fits_a = fits(settings, &a), fits_b = fits(settings, &b);
    if (fits_a != fits_b)
        return fits_a ? a : b;
    if (!fits_a)
        return a.peak_bytes <= b.peak_bytes ? a : b;
    return a.packets <= b.packets ? a : b;
}

static bool choose_automatically(struct streaks_packets *p, const struct rg_density *density,
                                 const struct streaks_scatter *scatter, struct streaks_plan *plan)
{
    const struct streaks_packets_settings *settings = &p->settings;
    const int64_t total = p->info.total_particles, size = settings->packet_size;
    if (total <= size) {
        *plan = plan_world(settings, total);
        return true;
    }
    *plan = plan_kd(settings, total);
    if (streaks_grid_plan(p, density, densest_m3(settings), &p->grid))
        *plan = better(settings, *plan, plan_grid(&p->grid));
    else if (p->grid.across)
        return false;
    // Counting a quad-tree's leaves is slow, so it is skipped if even full packets would not be
    // fewer.
    if (!fits(settings, plan) || (total + size - 1) / size < plan->packets)
        *plan = better(settings, *plan, plan_quad(settings, scatter, total));
    return true;
}

static bool choose(struct streaks_packets *p, const struct rg_density *density,
                   const struct streaks_scatter *scatter, struct streaks_plan *plan)
{
    const struct streaks_packets_settings *settings = &p->settings;
    switch (settings->scheme) {
    case STREAKS_AUTO:
        return choose_automatically(p, density, scatter, plan);
    case STREAKS_WORLD:
        *plan = plan_world(settings, p->info.total_particles);
        return true;
    case STREAKS_KD:
        *plan = plan_kd(settings, p->info.total_particles);
        return true;
    case STREAKS_QUAD:
        *plan = plan_quad(settings, scatter, p->info.total_particles);
        return true;
    default:
        if (!streaks_grid_plan(p, density, densest_m3(settings), &p->grid))
            return p->grid.across ? false : refuse_cells(settings);
        *plan = plan_grid(&p->grid);
        return true;
    }
}

bool streaks_plan(struct streaks_packets *packets, const struct rg_density *density,
                  const struct streaks_scatter *scatter, struct streaks_plan *plan)
{
    return choose(packets, density, scatter, plan) &&
           (fits(&packets->settings, plan) ||
            refuse(&packets->settings, plan, packets->info.total_particles));
}
