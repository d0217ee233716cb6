#include "core/techniques/streaks_packets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/alloc.h"
#include "core/log.h"
#include "core/techniques/streaks_packets_inner.h"

enum { PARTICLE_BYTES = 12, ID_BYTES = 4 };

// What a scheme would take.
struct plan {
    enum streaks_scheme scheme;
    int64_t packets, slots, peak_bytes;
};

static const char *const names[] = {"auto", "world", "kd", "quad", "grid"};

const char *streaks_scheme_name(enum streaks_scheme scheme)
{
    return names[scheme];
}

// --- the amount (section 4.3.2) ---

static double densest_m3(const struct streaks_packets_settings *settings)
{
    return settings->drops_m2_s / settings->fall_speed_m_s;
}

static double amount(const struct streaks_rain_space *space, const struct rg_density *density,
                     const struct streaks_packets_settings *settings)
{
    const double volume = 4 * space->half_x_m * space->half_y_m * settings->local_height_m;
    return rint(densest_m3(settings) * rg_density_mean(density) * volume);
}

static bool above_zero(double value)
{
    return isfinite(value) && value > 0;
}

int64_t streaks_packets_total(const struct streaks_rain_space *space,
                              const struct rg_density *density,
                              const struct streaks_packets_settings *settings)
{
    if (!above_zero(settings->drops_m2_s) || !above_zero(settings->fall_speed_m_s) ||
        !above_zero(settings->local_height_m))
        return 0;
    const double total = amount(space, density, settings);
    return total <= INT32_MAX ? (int64_t)total : 0;
}

static bool check(const struct streaks_rain_space *space, const struct rg_density *density,
                  const struct streaks_packets_settings *settings)
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
        return rg_error("rain: less than one particle in %g m x %g m x %g m; raise drops_m2_s, now "
                        "%g, or local_height_m",
                        2 * space->half_x_m, 2 * space->half_y_m, settings->local_height_m,
                        settings->drops_m2_s);
    if (total > INT32_MAX)
        return rg_error(
            "rain: %.6g particles in the local space, at most %d can be told apart; lower "
            "drops_m2_s, now %g, or local_height_m, now %g",
            total, INT32_MAX, settings->drops_m2_s, settings->local_height_m);
    return true;
}

// --- plans: packets and memory of each scheme, before memory is taken ---

static int64_t tree_bytes(int64_t nodes, int64_t packets)
{
    return nodes * (int64_t)sizeof(struct streaks_node) +
           packets * (int64_t)sizeof(struct streaks_packet);
}

static struct plan plan_world(int64_t total)
{
    const int64_t slots = streaks_padded(total);
    return (struct plan){STREAKS_WORLD, 1, slots, slots * PARTICLE_BYTES};
}

// A packet's last block is half empty on average; at most 31 of its particles are padding.
static int64_t slots_of(int64_t total, int64_t packets, bool by_id)
{
    return by_id ? streaks_padded(total) : total + packets * (STREAKS_BLOCK - 1);
}

static struct plan plan_kd(const struct streaks_packets_settings *settings, int64_t total)
{
    const int64_t packets = streaks_kd_leaves(total, settings->packet_size);
    const int64_t slots = slots_of(total, packets, settings->by_id);
    const int64_t halving = total * (PARTICLE_BYTES + 2 * ID_BYTES);
    const int64_t gathering = total * (PARTICLE_BYTES + ID_BYTES) + slots * PARTICLE_BYTES;
    return (struct plan){STREAKS_KD, packets, slots,
                         tree_bytes(2 * packets, packets) +
                             (settings->by_id || halving > gathering ? halving : gathering)};
}

// Counts the leaves without keeping particles.
static struct plan plan_quad(const struct streaks_packets_settings *settings,
                             const struct streaks_scatter *scatter, int64_t total)
{
    const int64_t packets = streaks_scatter_quads(scatter, total, settings->packet_size);
    const int64_t slots = slots_of(total, packets, settings->by_id);
    return (struct plan){STREAKS_QUAD, packets, slots,
                         tree_bytes(4 * packets, 2 * packets) + slots * PARTICLE_BYTES};
}

static struct plan plan_grid(const struct streaks_grid *grid)
{
    const int64_t slots = streaks_grid_slots(grid);
    return (struct plan){STREAKS_GRID, streaks_grid_buckets(grid), slots,
                         slots * PARTICLE_BYTES + (int64_t)grid->across * grid->down};
}

static bool fits(const struct streaks_packets_settings *settings, const struct plan *plan)
{
    return plan->peak_bytes <= settings->memory_bytes &&
           plan->slots <= (int64_t)STREAKS_MAX_BUFFERS * STREAKS_BUFFER_PARTICLES;
}

static bool refuse(const struct streaks_packets_settings *settings, const struct plan *plan,
                   int64_t total)
{
    return rg_error(
        "rain: %lld particles in %lld packets (%s) take %.1f MiB, more than the %.1f MiB "
        "allowed; lower drops_m2_s or local_height_m, choose other packets, or allow more",
        (long long)total, (long long)plan->packets, names[plan->scheme],
        (double)plan->peak_bytes / (1 << 20), (double)settings->memory_bytes / (1 << 20));
}

static bool refuse_cells(const struct streaks_packets_settings *settings)
{
    return rg_error("rain: packets of %d particles need a grid of more than %d cells; use larger "
                    "ones, or a tree",
                    settings->packet_size, STREAKS_MAX_CELLS);
}

// The better plan: of those that fit the one with fewer packets.
static struct plan better(const struct streaks_packets_settings *settings, struct plan a,
                          struct plan b)
{
    const bool fits_a = fits(settings, &a), fits_b = fits(settings, &b);
    if (fits_a != fits_b)
        return fits_a ? a : b;
    if (!fits_a)
        return a.peak_bytes <= b.peak_bytes ? a : b;
    return a.packets <= b.packets ? a : b;
}

static bool choose_automatically(struct streaks_packets *p, const struct rg_density *density,
                                 const struct streaks_scatter *scatter, struct plan *plan)
{
    const struct streaks_packets_settings *settings = &p->settings;
    const int64_t total = p->info.total_particles, size = settings->packet_size;
    if (total <= size) {
        *plan = plan_world(total);
        return true;
    }
    *plan = plan_kd(settings, total);
    if (streaks_grid_plan(p, density, densest_m3(settings), &p->grid))
        *plan = better(settings, *plan, plan_grid(&p->grid));
    else if (p->grid.across)
        return false;
    // Counting a quad-tree's leaves takes long; it is spared where full packets were too many yet.
    if (!fits(settings, plan) || (total + size - 1) / size < plan->packets)
        *plan = better(settings, *plan, plan_quad(settings, scatter, total));
    return true;
}

static bool choose(struct streaks_packets *p, const struct rg_density *density,
                   const struct streaks_scatter *scatter, struct plan *plan)
{
    const struct streaks_packets_settings *settings = &p->settings;
    switch (settings->scheme) {
    case STREAKS_AUTO:
        return choose_automatically(p, density, scatter, plan);
    case STREAKS_WORLD:
        *plan = plan_world(p->info.total_particles);
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

// --- making them ---

// Moves packets that lie one after the other apart, so that each begins a block. From the last on:
// none is written over before it has moved.
static bool spread(struct streaks_packets *p)
{
    int64_t slots = 0;
    for (int64_t i = 0; i < p->info.packets; i++)
        slots += streaks_padded(p->packets[i].count);
    float *particles = realloc(p->particles, (size_t)slots * PARTICLE_BYTES);
    if (!particles)
        return rg_error("rain: no memory for %lld particles; ask for less, or close other programs",
                        (long long)slots);
    p->particles = particles;
    p->slots = slots;
    for (int64_t i = p->info.packets - 1; i >= 0; i--) {
        struct streaks_packet *packet = &p->packets[i];
        const int64_t padding = streaks_padded(packet->count) - packet->count;
        slots -= packet->count + padding;
        memmove(particles + 3 * slots, particles + 3 * packet->first,
                (size_t)packet->count * PARTICLE_BYTES);
        memset(particles + 3 * (slots + packet->count), 0, (size_t)padding * PARTICLE_BYTES);
        packet->first = slots;
    }
    return true;
}

// Copies the particles of kd packets together.
static bool gather(struct streaks_packets *p)
{
    for (int64_t i = 0; i < p->info.packets; i++)
        p->slots += streaks_padded(p->packets[i].count);
    float *particles = rg_alloc((size_t)p->slots, PARTICLE_BYTES, "rain: particles");
    if (!particles)
        return false;
    int64_t slot = 0;
    for (int64_t i = 0; i < p->info.packets; i++) {
        struct streaks_packet *packet = &p->packets[i];
        const uint32_t *ids = p->ids + packet->first;
        for (int32_t k = 0; k < packet->count; k++)
            memcpy(particles + 3 * (slot + k), p->particles + 3 * (int64_t)ids[k], PARTICLE_BYTES);
        packet->first = slot;
        slot += streaks_padded(packet->count);
    }
    free(p->particles);
    free(p->ids);
    p->particles = particles;
    p->ids = NULL;
    return true;
}

static bool build_world(struct streaks_packets *p, int64_t total)
{
    p->nodes = rg_alloc(1, sizeof(*p->nodes), "rain: packets");
    p->packets = rg_alloc(1, sizeof(*p->packets), "rain: packets");
    if (!p->nodes || !p->packets)
        return false;
    p->nodes[0] =
        (struct streaks_node){0, 0, 1u << STREAKS_LATTICE_BITS, 1u << STREAKS_LATTICE_BITS, -1, 0};
    p->packets[0] = (struct streaks_packet){.count = (int32_t)total};
    p->node_count = p->info.packets = 1;
    p->slots = streaks_padded(total);
    return true;
}

static bool build_tree(struct streaks_packets *p, const struct streaks_scatter *scatter)
{
    const int64_t total = p->info.total_particles;
    p->particles = rg_alloc((size_t)streaks_padded(total), PARTICLE_BYTES, "rain: particles");
    if (!p->particles)
        return false;
    streaks_scatter(scatter, total, p->particles);
    p->info.stored_particles = total;
    const bool by_id = p->settings.by_id;
    if (p->info.scheme == STREAKS_WORLD)
        return build_world(p, total);
    if (by_id)
        p->slots = streaks_padded(total);
    if (p->info.scheme == STREAKS_KD)
        return streaks_kd_build(p, total) && (by_id || gather(p));
    return streaks_quad_build(p, total) && (by_id || spread(p));
}

static bool build(struct streaks_packets *p, const struct streaks_scatter *scatter,
                  const struct plan *plan)
{
    p->info.scheme = plan->scheme;
    p->info.peak_bytes = plan->peak_bytes;
    if (plan->scheme == STREAKS_GRID) {
        p->info.total_particles = streaks_grid_total(&p->grid);
        p->info.packets = plan->packets;
        p->info.grid_x = p->grid.across;
        p->info.grid_y = p->grid.down;
        p->info.places = (int64_t)p->grid.across * p->grid.down;
        p->info.host_bytes = p->info.places;
        return streaks_grid_build(p);
    }
    free(p->grid.levels);
    p->grid.levels = NULL;
    if (!build_tree(p, scatter))
        return false;
    p->info.places = p->info.packets;
    p->info.host_bytes = tree_bytes(p->node_count, p->info.packets) +
                         (p->ids ? p->info.total_particles * ID_BYTES : 0);
    return true;
}

struct streaks_packets *streaks_packets_create(const struct streaks_rain_space *space,
                                               const struct rg_density *density,
                                               const struct streaks_packets_settings *settings)
{
    if (!check(space, density, settings))
        return NULL;
    struct streaks_packets *p = rg_alloc(1, sizeof(*p), "rain: packets");
    if (!p)
        return NULL;
    p->half_x_m = space->half_x_m;
    p->half_y_m = space->half_y_m;
    p->settings = *settings;
    p->info.total_particles = (int64_t)amount(space, density, settings);
    const struct streaks_scatter scatter = {
        .density = density, .seed = settings->seed, .size_x = 2, .size_y = 2};
    struct plan plan = {0};
    if (choose(p, density, &scatter, &plan) &&
        (fits(settings, &plan) || refuse(settings, &plan, p->info.total_particles)) &&
        build(p, &scatter, &plan)) {
        p->info.particle_bytes = p->slots * PARTICLE_BYTES;
        return p;
    }
    streaks_packets_destroy(p);
    return NULL;
}

void streaks_packets_destroy(struct streaks_packets *packets)
{
    if (!packets)
        return;
    streaks_packets_forget(packets);
    free(packets->nodes);
    free(packets->packets);
    free(packets->ids);
    free(packets->grid.levels);
    free(packets);
}

const struct streaks_packets_info *streaks_packets_info(const struct streaks_packets *packets)
{
    return &packets->info;
}

int streaks_packets_buffers(const struct streaks_packets *packets)
{
    return (int)((packets->slots + STREAKS_BUFFER_PARTICLES - 1) / STREAKS_BUFFER_PARTICLES);
}

const float *streaks_packets_buffer(const struct streaks_packets *packets, int index,
                                    int64_t *bytes)
{
    const int64_t first = (int64_t)index * STREAKS_BUFFER_PARTICLES, left = packets->slots - first;
    *bytes = PARTICLE_BYTES *
             (left < STREAKS_BUFFER_PARTICLES ? left : (int64_t)STREAKS_BUFFER_PARTICLES);
    return packets->particles ? packets->particles + 3 * first : NULL;
}

void streaks_packets_forget(struct streaks_packets *packets)
{
    free(packets->particles);
    packets->particles = NULL;
}
