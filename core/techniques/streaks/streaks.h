// streaks: the settings and parameters of rain as particles (C. Creus, "Real-time realistic
// rain rendering", 2010). docs/streaks.md explains them.
#ifndef RG_CORE_TECHNIQUES_STREAKS_STREAKS_H
#define RG_CORE_TECHNIQUES_STREAKS_STREAKS_H

#include <stdint.h>

#include "core/techniques/params.h"

enum streaks_camera { STREAKS_FIRST, STREAKS_SECOND, STREAKS_FREE };
enum streaks_overlay { STREAKS_OVERLAY_OFF, STREAKS_OVERLAY_ALL, STREAKS_OVERLAY_LIGHTS };

struct streaks_settings {
    int seed;
    // the rain space
    double rain_width_m, rain_depth_m, rain_height_m, slant_deg, slant_azimuth_deg;
    char density_map[RG_PATH_SIZE];
    double drops_m2_s, fall_speed_m_s;
    // drops of different sizes
    int spectrum, normalised, terminal_speed, kept;
    double rain_mm_h, least_diameter_mm, kept_share;
    // the simulated part of the rain space
    double local_height_m, culling_radius_m;
    int limits; // 0: rain everywhere
    int fit;    // whether height and radius are searched for
    double fit_error;
    int scheme, packet_size, select, exact, all_blocks, sparse, by_id;
    int memory_mb;
    // the surfaces that drops hit
    int dynamic_map, map_px, map_period;
    // the scene
    char scene[RG_PATH_SIZE];
    int city, city_seed, geometry, time;
    int camera;
    double eye_x_m, eye_y_m, eye_z_m, target_x_m, target_y_m, target_z_m, view_angle_deg;
    double walk_m_s, step_s;
    // light
    int lights, environment_light, shadows, shadow_map_px;
    char lights_file[RG_PATH_SIZE];
    // the look of particles
    int atlas, swings, taps, absolute_views, last_mip, points;
    int look, drops, splashes, splash_materials, splashes_upright, splash_matt;
    double drop_radius_mm, exposure_s, splash_s, splash_width_mm;
    double streak_gain, streak_opacity, splash_gain, splash_opacity, splash_fade;
    int far_layers, overlay, keeps_state;
    // the view from outside
    int outside, outside_map;
    double outside_turn_deg, outside_rise_deg;
};

// The largest culling radius that can be set.
double streaks_widest_m(const struct streaks_settings *settings);

extern const struct rg_param_table streaks_param_table;
extern const struct rg_proof streaks_proof;

#endif
