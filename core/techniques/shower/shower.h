// shower: rain as a particle system, the traditional one and the improved one, after Ye Li-na,
// "Raining Simulation based on Improved Particle Systems algorithms". docs/shower.md explains.
#ifndef RG_CORE_TECHNIQUES_SHOWER_SHOWER_H
#define RG_CORE_TECHNIQUES_SHOWER_SHOWER_H

#include <stdbool.h>

#include "core/techniques/params.h"

enum shower_system { SHOWER_TRADITIONAL, SHOWER_IMPROVED };
// Each improvement has a switch: as the system's default, as the traditional system, or as the
// improved one. Renewal has two traditional ways: on the device, and with memory of the host.
enum shower_switch { SHOWER_AUTO, SHOWER_OLD, SHOWER_NEW, SHOWER_HEAP };
enum shower_birth { SHOWER_PAPER, SHOWER_WHOLE, SHOWER_VOLUME };

struct shower_settings {
    int seed;
    // Particles.
    int particles;
    double variation;                                // C0
    int system;                                      // enum shower_system
    int state, shape, crop, motion, renewal, layers; // enum shower_switch
    int memory_mb;
    // Their birth and motion.
    int birth; // enum shower_birth
    double near_m, drop_height_m, drop_width_m;
    double wind_m_s, wind_deg, gust, gust_s;
    double fall_m_s, gravity_m_s2, step_s;
    int lands_on_mesh, map_px;
    // The scene.
    char scene[RG_PATH_SIZE];
    int city, city_seed, geometry;
    int shadows, shadow_map_px;
    double eye_x_m, eye_y_m, eye_z_m, heading_deg, view_angle_deg, walk_m_s;
    // The picture.
    double light, opacity;
};

// Whether a switch selects the improved way, directly or by the system's default.
bool shower_is_new(const struct shower_settings *settings, int choice);

extern const struct rg_param_table shower_param_table;

#endif
