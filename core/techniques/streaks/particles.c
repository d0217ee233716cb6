// The particles of streaks: thrown over the rain space, in packets, on the device.
#include "core/base/log.h"
#include "core/techniques/streaks/instance.h"

void streaks_free_particles(struct streaks *s)
{
    for (int i = 0; i < s->buffer_count; i++)
        rg_buf_destroy(s->particles[i]);
    s->buffer_count = 0;
    streaks_packets_destroy(s->packets);
    s->packets = NULL;
}

// Drops a cubic metre where the camera stands.
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

static bool create_packets(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    const struct streaks_packets_settings settings = {
        .seed = (uint32_t)set->seed,
        .drops_m2_s =
            streaks_sizes_differ(s) ? s->sizes.drops_m3 * set->fall_speed_m_s : set->drops_m2_s,
        .fall_speed_m_s = set->fall_speed_m_s,
        .local_height_m = set->local_height_m,
        .packet_size = set->packet_size,
        .scheme = (enum streaks_scheme)set->scheme,
        .by_id = set->by_id,
        .memory_bytes = (int64_t)set->memory_mb * 1000000,
        .amount = streaks_sizes_differ(s) ? "kept_share" : "drops_m2_s",
    };
    struct rg_density *density = streaks_density(s);
    s->mean_density = density ? rg_density_mean(density) : 0;
    s->packets = density && streaks_sizes_fit(s, density)
                     ? streaks_packets_create(&s->space, density, &settings)
                     : NULL;
    s->drops_m3 = density ? drops_at_camera(s, density) : 0;
    rg_density_destroy(density);
    return s->packets;
}

static bool upload_particles(struct streaks *s)
{
    const int count = streaks_packets_buffers(s->packets);
    if (count > STREAKS_MAX_BUFFERS)
        return rg_error("particles: %d buffers of 128 MiB are too many; raise packet_size or take "
                        "packets=grid",
                        count);
    for (int i = 0; i < count; i++) {
        int64_t bytes;
        const float *particles = streaks_packets_buffer(s->packets, i, &bytes);
        s->particles[i] = rg_buf_create_with(s->base.device, particles, bytes, "particles");
        s->buffer_count = i + 1;
        if (!s->particles[i])
            return false;
    }
    streaks_packets_forget(s->packets);
    return true;
}

bool streaks_make_particles(struct streaks *s)
{
    streaks_free_particles(s);
    return streaks_sizes_make(s) && create_packets(s) && upload_particles(s);
}
