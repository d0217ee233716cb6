// Opens streaks on a device: its particles, scene, textures, lights and images.
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/techniques/streaks/fit.h"
#include "core/techniques/streaks/instance.h"

static const char *const counter_names[STREAKS_COUNTERS] = {"particles_selected",
                                                            "packets_selected", "items_drawn"};

static void destroy_particles(struct streaks *s)
{
    for (int i = 0; i < s->buffer_count; i++)
        rg_buf_destroy(s->particles[i]);
    s->buffer_count = 0;
    streaks_packets_destroy(s->packets);
    s->packets = NULL;
}

void streaks_close(struct rg_instance *instance)
{
    struct streaks *s = (struct streaks *)instance;
    struct rg_device *device = instance->device;
    rg_pass_destroy(s->rain);
    rg_pass_destroy(s->state);
    rg_pass_destroy(s->far);
    destroy_particles(s);
    rg_buf_destroy(s->blocks);
    rg_buf_destroy(s->places);
    streaks_map_close(s);
    rg_image_destroy(s->depth);
    rg_image_destroy(s->base.target);
    scenery_overlay_close(s->overlay);
    scenery_lights_close(s->lights);
    if (s->scene)
        scenery_put(s->scene);
    if (s->textures)
        streaks_textures_put(device, s->textures);
    streaks_selection_release(&s->selection);
    free(s);
}

// --- the rain space and its particles ---

double streaks_widest_m(const struct streaks_settings *set)
{
    return hypot(set->rain_width_m, set->rain_depth_m);
}

static bool create_space(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    struct streaks_rain_space_settings space = {
        .width_m = set->rain_width_m, .depth_m = set->rain_depth_m, .height_m = set->rain_height_m};
    streaks_rain_fall(set->slant_deg, set->slant_azimuth_deg, space.fall);
    if (!streaks_rain_space_make(&space, &s->space))
        return false;
    if (set->limits && set->culling_radius_m > streaks_widest_m(set))
        return rg_error("culling_radius_m: %.4g m is wider than the rain space of %.4g m x %.4g m; "
                        "take limits=off for rain everywhere",
                        set->culling_radius_m, set->rain_width_m, set->rain_depth_m);
    if (set->local_height_m > set->rain_height_m)
        return rg_error("local_height_m: %.4g m is higher than the rain space, rain_height_m=%.4g",
                        set->local_height_m, set->rain_height_m);
    return true;
}

// Drops a cubic metre where the camera stands.
static double drops_at_camera(const struct streaks *s, const struct rg_density *density)
{
    double rain[3];
    streaks_rain_eye(&s->space, &s->camera, rain);
    const double column = (rain[0] / s->space.half_x_m + 1) / 2 * density->width;
    const double row = (rain[1] / s->space.half_y_m + 1) / 2 * density->height;
    if (!(column >= 0 && column < density->width && row >= 0 && row < density->height))
        return 0;
    return rg_density_at(density, (int)column, (int)row) * s->settings.drops_m2_s /
           s->settings.fall_speed_m_s;
}

static bool create_packets(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    const struct streaks_packets_settings settings = {
        .seed = (uint32_t)set->seed,
        .drops_m2_s = set->drops_m2_s,
        .fall_speed_m_s = set->fall_speed_m_s,
        .local_height_m = set->local_height_m,
        .packet_size = set->packet_size,
        .scheme = (enum streaks_scheme)set->scheme,
        .by_id = set->by_id,
        .memory_bytes = (int64_t)set->memory_mb * 1000000,
    };
    struct rg_density *density =
        set->density_map[0] ? rg_density_read(set->density_map) : rg_density_gradient();
    s->packets = density ? streaks_packets_create(&s->space, density, &settings) : NULL;
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
        s->particles[i] = rg_buf_create(s->base.device, bytes, "particles");
        s->buffer_count = i + 1;
        if (!s->particles[i] || !rg_buf_write(s->particles[i], 0, particles, bytes))
            return false;
    }
    streaks_packets_forget(s->packets);
    return true;
}

bool streaks_make_particles(struct streaks *s)
{
    destroy_particles(s);
    return create_packets(s) && upload_particles(s);
}

// --- the scene, its lights and what they need ---

static bool create_scene(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    struct scenery_settings settings = {
        .city = {.seed = set->city_seed, .size = (enum city_size)set->city}};
    if (strcmp(set->scene, "city") != 0)
        memcpy(settings.model, set->scene, sizeof(settings.model));
    s->scene = scenery_get(s->base.device, &settings);
    return s->scene;
}

static void choose_camera(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    s->camera = set->camera == STREAKS_SECOND ? city_second_camera : city_first_camera;
    s->camera.angle_deg = (float)set->view_angle_deg;
    if (set->camera != STREAKS_FREE)
        return;
    const double eye[3] = {set->eye_x_m, set->eye_y_m, set->eye_z_m};
    const double target[3] = {set->target_x_m, set->target_y_m, set->target_z_m};
    for (int i = 0; i < 3; i++) {
        s->camera.position[i] = (float)eye[i];
        s->camera.target[i] = (float)target[i];
    }
}

// Draws what casts shadows.
static bool draw_shadow(void *user, const float to_clip[16], const struct rg_draw *onto)
{
    struct streaks *s = user;
    m4 matrix;
    memcpy(&matrix, to_clip, sizeof(matrix));
    return scenery_depth(s->scene, &s->base, matrix, onto);
}

// Lamps ahead of the camera light what it sees: a place so far ahead on level ground.
static void look_ahead(const struct rg_camera *camera, float place_m[3])
{
    const double ahead_m = 20, x = (double)camera->target[0] - (double)camera->position[0];
    const double z = (double)camera->target[2] - (double)camera->position[2];
    const double level = fmax(hypot(x, z), 1e-9);
    memcpy(place_m, camera->position, 3 * sizeof(*place_m));
    place_m[0] += (float)(x / level * ahead_m);
    place_m[2] += (float)(z / level * ahead_m);
}

static bool create_lights(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    const struct city_faces *faces = &scenery_city(s->scene)->faces;
    struct scenery_lights_settings settings = {.file = set->lights_file,
                                               .count = set->lights,
                                               .time = (enum scenery_time)set->time,
                                               .shadows = set->shadows,
                                               .shadow_map_px = set->shadow_map_px};
    const struct city_lamp *lamps;
    settings.lamp_count = scenery_lamps(s->scene, &lamps);
    settings.lamps = lamps;
    look_ahead(&s->camera, settings.about_m);
    memcpy(settings.low_m, faces->low, sizeof(settings.low_m));
    memcpy(settings.high_m, faces->high, sizeof(settings.high_m));
    streaks_rain_matrices(&s->space, settings.world_to_frame, NULL);
    s->lights = scenery_lights_open(s->base.device, &settings);
    return s->lights && scenery_lights_shade(s->lights, draw_shadow, s);
}

// --- passes and images ---

static struct rg_image *create_image(struct streaks *s, enum rg_format format, int width,
                                     int height, const char *name)
{
    return rg_image_create(s->base.device, &(struct rg_image_desc){format, width, height, 1, 1},
                           name);
}

static bool create_images(struct streaks *s, int width, int height)
{
    return (s->base.target = create_image(s, RG_RGBA16F, width, height, "target")) &&
           (s->depth = create_image(s, RG_D32F, width, height, "depth"));
}

static bool create_passes(struct streaks *s)
{
    static const char *const programs[] = {"streaks_rain_2", "streaks_rain_4", "streaks_rain_8"};
    s->rain = rg_pass_create(s->base.device, programs[s->settings.taps]);
    return s->rain &&
           (!s->settings.keeps_state ||
            (s->state = rg_pass_create(s->base.device, "streaks_state"))) &&
           (!s->settings.far_layers || (s->far = rg_pass_create(s->base.device, "streaks_far"))) &&
           (!s->settings.overlay || (s->overlay = scenery_overlay_open(s->base.device)));
}

// --- what is told of it ---

static struct rg_fact *tell(struct streaks *s, enum streaks_fact which, const char *name)
{
    struct rg_fact *fact = &s->base.facts[which];
    fact->name = name;
    return fact;
}

static void tell_textures(struct streaks *s)
{
    const struct streaks_textures *t = s->textures;
    s->base.texture_count = 3;
    s->base.textures[0] = (struct rg_texture){"environment", t->skies, t->first_level};
    s->base.textures[1] = (struct rg_texture){"point", t->points, t->first_level};
    s->base.textures[2] = (struct rg_texture){"splash", t->crowns, 0};
}

static void tell_facts(struct streaks *s)
{
    const struct streaks_packets_info *info = streaks_packets_info(s->packets);
    const struct streaks_settings *set = &s->settings;
    s->base.fact_count = set->fit ? STREAKS_FACTS : STREAKS_FACT_RADIUS;
    tell(s, STREAKS_FACT_TOTAL, "total_particles")->number = (double)info->total_particles;
    snprintf(tell(s, STREAKS_FACT_SCHEME, "packets")->text, RG_FACT_SIZE, "%s",
             streaks_scheme_name(info->scheme));
    tell(s, STREAKS_FACT_PACKETS, "packet_count")->number = (double)info->packets;
    tell(s, STREAKS_FACT_MEMORY, "particle_bytes")->number = (double)info->particle_bytes;
    snprintf(tell(s, STREAKS_FACT_ATLAS, "atlas_hash")->text, RG_FACT_SIZE, "%016" PRIx64,
             s->textures->hash);
    snprintf(tell(s, STREAKS_FACT_SCENE, "scene_hash")->text, RG_FACT_SIZE, "%016" PRIx64,
             scenery_city(s->scene)->hash);
    tell(s, STREAKS_FACT_PARTICLES, "particles");
    tell(s, STREAKS_FACT_RADIUS, "culling_radius_m")->number = set->culling_radius_m;
    tell(s, STREAKS_FACT_HEIGHT, "local_height_m")->number = set->local_height_m;
    tell(s, STREAKS_FACT_ERROR, "flip_mask_mean");
    s->base.counter_count = STREAKS_COUNTERS;
    for (int i = 0; i < STREAKS_COUNTERS; i++)
        s->base.counters[i].name = counter_names[i];
}

struct rg_instance *streaks_open(struct rg_device *device, const void *settings, int width,
                                 int height)
{
    struct streaks *s = rg_alloc(1, sizeof(*s), "streaks");
    if (!s)
        return NULL;
    s->base.technique = rg_technique_find("streaks");
    s->base.device = device;
    s->settings = *(const struct streaks_settings *)settings;
    choose_camera(s);
    const bool fit = s->settings.fit;
    const bool ok =
        (!fit || streaks_fit_begin(&s->settings)) && create_space(s) &&
        (fit || streaks_make_particles(s)) && create_scene(s) && create_lights(s) &&
        streaks_map_open(s) && create_images(s, width, height) && create_passes(s) &&
        (s->textures = streaks_textures_get(device, (enum rg_atlas_size)s->settings.atlas)) &&
        (!fit || streaks_fit(s));
    if (ok) {
        tell_textures(s);
        tell_facts(s);
    }
    if (ok && streaks_look(s))
        return &s->base;
    streaks_close(&s->base);
    return NULL;
}
