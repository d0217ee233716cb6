// Opens streaks on a device: its scene, textures, lights and images.
#include <inttypes.h>

#include "core/base/log.h"
#include "core/techniques/streaks/fit.h"
#include "core/techniques/streaks/instance.h"

static const char *const counter_names[STREAKS_COUNTERS] = {"particles_selected",
                                                            "packets_selected", "items_drawn"};

void streaks_close(struct rg_instance *instance)
{
    struct streaks *s = (struct streaks *)instance;
    streaks_free_particles(s);
    streaks_map_close(s);
    streaks_outside_close(s);
    scenery_overlay_close(s->overlay);
    scenery_lights_close(s->lights);
    scenery_close(s->scene);
    if (s->textures)
        streaks_textures_put(instance->device, s->textures);
    streaks_selection_release(&s->selection);
}

// --- the rain space ---

static bool create_space(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    struct rg_rain_space_settings space = {
        .width_m = set->rain_width_m, .depth_m = set->rain_depth_m, .height_m = set->rain_height_m};
    rg_rain_fall(set->slant_deg, set->slant_azimuth_deg, space.fall);
    if (!rg_rain_space_make(&space, &s->space))
        return false;
    if (set->limits && set->culling_radius_m > streaks_widest_m(set))
        return rg_error("culling_radius_m: %.4g m is wider than the rain space of %.4g m x %.4g m; "
                        "take limits=off for rain everywhere",
                        set->culling_radius_m, set->rain_width_m, set->rain_depth_m);
    if (streaks_narrowing(s) > 0 && (set->limits || set->keeps_state))
        return rg_error("outside=frustum: limits and states are those of a box; take "
                        "limits=off and state=off");
    if (set->local_height_m > set->rain_height_m)
        return rg_error("local_height_m: %.4g m is higher than the rain space, rain_height_m=%.4g",
                        set->local_height_m, set->rain_height_m);
    return true;
}

// --- the scene, its lights and what they need ---

static bool create_scene(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    struct scenery_settings settings =
        scenery_named(set->scene, (enum city_size)set->city, set->city_seed);
    settings.bare = !set->geometry;
    s->scene = scenery_open(&s->base, &settings);
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

static bool create_lights(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    struct scenery_lights_settings settings = {.file = set->lights_file,
                                               .count = set->lights,
                                               .time = (enum scenery_time)set->time,
                                               .shadows = set->shadows,
                                               .shadow_map_px = set->shadow_map_px};
    rg_rain_matrices(&s->space, settings.world_to_frame, NULL);
    s->lights = scenery_lit(s->scene, s->base.device, &settings, &s->camera);
    return s->lights;
}

// --- assets and stages ---

static void add_assets(struct streaks *s)
{
    struct rg_instance *i = &s->base;
    const struct rg_image_desc *target = &i->target->desc;
    rg_add_image(i, "depth", RG_D32F, target->width, target->height);
    s->particles_now = rg_lend_buf(i, "particles", NULL);
    s->blocks = rg_lend_buf(i, "blocks", NULL);
    s->places = rg_lend_buf(i, "places", NULL);
    rg_lend_image(i, "depths", s->map->depths);
    rg_lend_image(i, "numbers", s->map->numbers);
    rg_lend_image(i, "points", s->textures->points);
    rg_lend_image(i, "skies", s->textures->skies);
    rg_lend_image(i, "crowns", s->textures->crowns);
    rg_lend_buf(i, "factors", s->textures->factors);
    rg_lend_buf(i, "means", s->textures->means);
    if (s->density)
        rg_lend_image(i, "density", s->density);
    rg_lend_buf(i, "lights", s->lights->in_frame);
    rg_lend_image(i, "shadows", s->lights->shadows);
    rg_add_state(i, s->places, "places", STREAKS_STATE_WORDS, 0);
    i->state_count = 0; // until a step has kept it
    rg_add_counters(i, counter_names, STREAKS_COUNTERS);
}

#define AT(field) offsetof(struct streaks, field)

static bool open_stages(struct streaks *s)
{
    static const char *const programs[] = {"streaks_rain_2", "streaks_rain_4", "streaks_rain_8"};
    const struct streaks_settings *set = &s->settings;
    const struct rg_stage stages[STREAKS_PASS_COUNT] = {
        [STREAKS_RAIN] = {programs[set->taps], .params = AT(of_rain), .colour = RG_LAYER,
                          .depth = "depth", .blend = RG_BLEND_OVER, .depth_mode = RG_DEPTH_TEST,
                          .named = {{"surfaces", "scene.surfaces"}}},
        [STREAKS_MARKS] = {set->outside ? "streaks_marks" : NULL, .params = AT(of_rain),
                           .colour = RG_LAYER, .depth = "depth", .blend = RG_BLEND_OVER,
                           .depth_mode = RG_DEPTH_TEST},
        [STREAKS_STATES] = {set->keeps_state ? "streaks_state" : NULL, .params = AT(of_rain),
                            .named = {{"surfaces", "scene.surfaces"}}},
        [STREAKS_FAR] = {set->far_layers ? "streaks_far" : NULL, .params = AT(of_far),
                         .colour = RG_LAYER, .depth = "depth", .blend = RG_BLEND_OVER,
                         .depth_mode = RG_DEPTH_TEST},
    };
    s->first_stage = rg_open_stages(&s->base, stages, STREAKS_PASS_COUNT, s, NULL);
    return s->first_stage >= 0 &&
           ((!set->overlay && !set->outside) || (s->overlay = scenery_overlay_open(&s->base)));
}

// --- facts and textures ---

static void tell_facts(struct streaks *s)
{
    struct rg_instance *i = &s->base;
    const struct streaks_packets_info *info = streaks_packets_info(s->rain->packets);
    const struct streaks_settings *set = &s->settings;
    s->particles_told = rg_tell(i, "particles", 0);
    rg_tell(i, "total_particles", (double)info->total_particles);
    rg_tell_text(i, "packets", "%s", streaks_scheme_name(info->scheme));
    rg_tell(i, "packet_count", (double)info->packets);
    rg_tell(i, "particle_bytes", (double)info->particle_bytes);
    streaks_sizes_tell(s);
    rg_tell_text(i, "atlas_hash", "%016" PRIx64, s->textures->hash);
    rg_tell_text(i, "scene_hash", "%016" PRIx64, scenery_city(s->scene)->hash);
    if (!set->fit)
        return;
    rg_tell(i, "culling_radius_m", set->culling_radius_m);
    rg_tell(i, "local_height_m", set->local_height_m);
    rg_tell(i, "flip_mask_mean", s->fit_error);
}

static void tell_textures(struct streaks *s)
{
    const struct streaks_textures *t = s->textures;
    rg_tell_texture(&s->base, "environment", t->skies, t->first_level);
    rg_tell_texture(&s->base, "point", t->points, t->first_level);
    rg_tell_texture(&s->base, "splash", t->crowns, 0);
}

// --- opening ---

static bool create_textures(struct streaks *s)
{
    enum rg_atlas_size size = (enum rg_atlas_size)s->settings.atlas;
    if (s->settings.swings == RG_SWINGS_MEASURED)
        size = rg_atlas_kinds[size].measured;
    s->textures = streaks_textures_get(s->base.device, size);
    return s->textures;
}

// The scene is opened first, because its stages draw maps and the rain's stages read them.
bool streaks_open(struct rg_instance *instance)
{
    struct streaks *s = (struct streaks *)instance;
    choose_camera(s);
    const bool fit = s->settings.fit;
    if ((fit && !streaks_fit_begin(&s->settings)) || !create_space(s) ||
        (!fit && !streaks_make_particles(s)) || !create_scene(s) || !create_lights(s) ||
        !streaks_map_open(s) || !streaks_outside_open(s) || !create_textures(s))
        return false;
    add_assets(s);
    if (!rg_layer_open(&s->layer, instance) || !open_stages(s) || (fit && !streaks_fit(s)))
        return false;
    tell_textures(s);
    tell_facts(s);
    return streaks_look(s);
}
