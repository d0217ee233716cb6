// Makes the particles of streaks: scattered over the rain space, grouped in packets, on the device.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <xxhash.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/device/shared.h"
#include "core/techniques/streaks/instance.h"

// Drops a cubic metre at the camera's place.
static double drops_at_camera(const struct streaks *s, const struct rg_density *density)
{
    double rain[3];
    rg_rain_eye(&s->space, &s->camera, rain);
    const double column = (rain[0] / s->space.half_x_m + 1) / 2 * density->width;
    const double row = (rain[1] / s->space.half_y_m + 1) / 2 * density->height;
    if (!(column >= 0 && column < density->width && row >= 0 && row < density->height))
        return 0;
    return rg_density_at(density, (int)column, (int)row) * s->sizes.drops_m3;
}

struct rg_density *streaks_density(const struct streaks *s)
{
    const char *map = s->settings.density_map;
    return map[0] ? rg_density_read(map) : rg_density_gradient();
}

// --- the rain, which instances share ---

// The inputs from which rain is made.
struct making {
    const struct rg_rain_space *space;
    const struct rg_density *density;
    struct streaks_packets_settings settings;
};

static void destroy(void *thing)
{
    struct streaks_rain *rain = thing;
    for (int i = 0; i < rain->buffer_count; i++)
        rg_buf_destroy(rain->particles[i]);
    streaks_packets_destroy(rain->packets);
    free(rain);
}

static bool upload(struct streaks_rain *rain, struct rg_device *device)
{
    const int count = streaks_packets_buffers(rain->packets);
    if (count > STREAKS_MAX_BUFFERS)
        return rg_error("particles: %d buffers of 128 MiB are too many; raise packet_size or take "
                        "packets=grid",
                        count);
    for (int i = 0; i < count; i++) {
        int64_t bytes;
        const float *particles = streaks_packets_buffer(rain->packets, i, &bytes);
        rain->particles[i] = rg_buf_create_with(device, particles, bytes, "particles");
        rain->buffer_count = i + 1;
        if (!rain->particles[i])
            return false;
    }
    streaks_packets_forget(rain->packets);
    return true;
}

static void *make(struct rg_device *device, const void *arg)
{
    const struct making *of = arg;
    struct streaks_rain *rain = rg_alloc(1, sizeof(*rain), "rain");
    if (!rain)
        return NULL;
    rain->packets = streaks_packets_create(of->space, of->density, &of->settings);
    if (rain->packets && upload(rain, device))
        return rain;
    destroy(rain);
    return NULL;
}

static uint64_t hash_of(const struct rg_density *density)
{
    const size_t corners = (size_t)(density->width + 1) * (size_t)(density->height + 1);
    return XXH3_64bits(density->sums, corners * sizeof(*density->sums));
}

// The key must hold everything that decides the particles and their packets.
static const struct streaks_rain *get(struct rg_device *device, const struct making *of)
{
    static const struct rg_shared_kind kind = {"rain", make, destroy};
    const struct streaks_packets_settings *p = &of->settings;
    char key[400];
    snprintf(key, sizeof(key), "%a %a %a %u %a %a %a %d %d %d %lld %d %d %a %016" PRIx64,
             of->space->half_x_m, of->space->half_y_m, of->space->height_m, p->seed, p->drops_m2_s,
             p->fall_speed_m_s, p->local_height_m, p->packet_size, (int)p->scheme, p->by_id,
             (long long)p->memory_bytes, of->density->width, of->density->height, of->density->unit,
             hash_of(of->density));
    return rg_shared_get(device, key, &kind, of);
}

// --- of an instance ---

void streaks_free_particles(struct streaks *s)
{
    rg_shared_put(s->base.device, (void *)(uintptr_t)s->rain);
    s->rain = NULL;
}

static const struct streaks_rain *get_rain(const struct streaks *s,
                                           const struct rg_density *density)
{
    const struct streaks_settings *set = &s->settings;
    const bool differ = streaks_sizes_differ(s);
    const struct making making = {
        .space = &s->space,
        .density = density,
        .settings = {.seed = (uint32_t)set->seed,
                     .drops_m2_s =
                         differ ? s->sizes.drops_m3 * set->fall_speed_m_s : set->drops_m2_s,
                     .fall_speed_m_s = set->fall_speed_m_s,
                     .local_height_m = set->local_height_m,
                     .packet_size = set->packet_size,
                     .scheme = (enum streaks_scheme)set->scheme,
                     .by_id = set->by_id,
                     .memory_bytes = (int64_t)set->memory_mb * 1000000,
                     .amount = differ ? "kept_share" : "drops_m2_s"}};
    return get(s->base.device, &making);
}

bool streaks_make_particles(struct streaks *s)
{
    streaks_free_particles(s);
    struct rg_density *density = streaks_sizes_make(s) ? streaks_density(s) : NULL;
    if (density && streaks_sizes_fit(s, density)) {
        s->mean_density = rg_density_mean(density);
        s->drops_m3 = drops_at_camera(s, density);
        s->rain = get_rain(s, density);
    }
    rg_density_destroy(density);
    return s->rain;
}
