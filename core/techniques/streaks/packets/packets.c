#include "core/techniques/streaks/packets/packets.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/techniques/streaks/packets/inner.h"

// Moves contiguous packets apart, so that each begins a block. Goes backwards, so that none is
// overwritten before it has moved.
static bool spread(struct streaks_packets *p)
{
    int64_t slots = 0;
    for (int64_t i = 0; i < p->info.packets; i++)
        slots += streaks_padded(p->packets[i].count);
    float *particles = realloc(p->particles, (size_t)slots * STREAKS_PARTICLE_BYTES);
    if (!particles)
        return rg_harness_error(
            "rain: no memory for %lld particles; ask for less, or close other programs",
            (long long)slots);
    p->particles = particles;
    p->slots = slots;
    for (int64_t i = p->info.packets - 1; i >= 0; i--) {
        struct streaks_packet *packet = &p->packets[i];
        const int64_t padding = streaks_padded(packet->count) - packet->count;
        slots -= packet->count + padding;
        memmove(particles + 3 * slots, particles + 3 * packet->first,
                (size_t)packet->count * STREAKS_PARTICLE_BYTES);
        memset(particles + 3 * (slots + packet->count), 0,
               (size_t)padding * STREAKS_PARTICLE_BYTES);
        packet->first = slots;
    }
    return true;
}

// Copies the particles of each kd packet together.
static bool gather(struct streaks_packets *p)
{
    for (int64_t i = 0; i < p->info.packets; i++)
        p->slots += streaks_padded(p->packets[i].count);
    float *particles = rg_alloc((size_t)p->slots, STREAKS_PARTICLE_BYTES, "rain: particles");
    if (!particles)
        return false;
    int64_t slot = 0;
    for (int64_t i = 0; i < p->info.packets; i++) {
        struct streaks_packet *packet = &p->packets[i];
        const uint32_t *ids = p->ids + packet->first;
        for (int32_t k = 0; k < packet->count; k++)
            memcpy(particles + 3 * (slot + k), p->particles + 3 * (int64_t)ids[k],
                   STREAKS_PARTICLE_BYTES);
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
    p->nodes[0] = streaks_everywhere;
    p->nodes[0].packet = 0;
    p->packets[0] = (struct streaks_packet){.count = (int32_t)total};
    p->node_count = p->info.packets = 1;
    p->slots = streaks_padded(total);
    return true;
}

static bool build_tree(struct streaks_packets *p, const struct streaks_scatter *scatter)
{
    const int64_t total = p->info.total_particles;
    p->particles =
        rg_alloc((size_t)streaks_padded(total), STREAKS_PARTICLE_BYTES, "rain: particles");
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
                  const struct streaks_plan *plan)
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
    p->info.host_bytes = streaks_tree_bytes(p->node_count, p->info.packets) +
                         (p->ids ? p->info.total_particles * STREAKS_ID_BYTES : 0);
    return true;
}

// Must be the condition by which streaks_select lists blocks.
bool streaks_by_id(const struct streaks_packets *p)
{
    return p->settings.by_id && p->info.scheme != STREAKS_GRID;
}

struct streaks_packets *streaks_packets_create(const struct rg_rain_space *space,
                                               const struct rg_density *density,
                                               const struct streaks_packets_settings *settings)
{
    int64_t total;
    if (!streaks_plan_amount(space, density, settings, &total))
        return NULL;
    struct streaks_packets *p = rg_alloc(1, sizeof(*p), "rain: packets");
    if (!p)
        return NULL;
    p->half_x_m = space->half_x_m;
    p->half_y_m = space->half_y_m;
    p->settings = *settings;
    p->info.total_particles = total;
    const struct streaks_scatter scatter = {
        .density = density, .seed = settings->seed, .size_x = 2, .size_y = 2};
    struct streaks_plan plan = {0};
    if (streaks_plan(p, density, &scatter, &plan) && build(p, &scatter, &plan) &&
        (streaks_by_id(p) || streaks_bounds_make(p))) {
        p->info.particle_bytes = p->slots * STREAKS_PARTICLE_BYTES;
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
    free(packets->bounds.memory);
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
    *bytes = STREAKS_PARTICLE_BYTES *
             (left < STREAKS_BUFFER_PARTICLES ? left : (int64_t)STREAKS_BUFFER_PARTICLES);
    return packets->particles ? packets->particles + 3 * first : NULL;
}

void streaks_packets_forget(struct streaks_packets *packets)
{
    free(packets->particles); // NOLINT: there is a particle, so that realloc frees nothing
    packets->particles = NULL;
}

// --- visiting them ---

static void visit_slots(int64_t first, int64_t count, int64_t times,
                        void (*visit)(void *user, uint32_t number, int64_t times), void *user)
{
    for (int64_t slot = first; slot < first + count; slot++)
        visit(user, (uint32_t)(slot % STREAKS_BUFFER_PARTICLES), times);
}

void streaks_packets_each(const struct streaks_packets *p,
                          void (*visit)(void *user, uint32_t number, int64_t times), void *user)
{
    if (p->info.scheme == STREAKS_GRID) {
        for (int level = 1; level < STREAKS_LEVELS; level++)
            visit_slots(p->grid.buckets[level].first, p->grid.buckets[level].count,
                        p->grid.cells_of[level], visit, user);
        return;
    }
    if (streaks_by_id(p)) {
        visit_slots(0, p->info.total_particles, 1, visit, user);
        return;
    }
    for (int64_t i = 0; i < p->info.packets; i++)
        visit_slots(p->packets[i].first, p->packets[i].count, 1, visit, user);
}
