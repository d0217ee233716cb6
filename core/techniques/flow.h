// flow: the settings, parameters and host-side inputs of Stuppacher & Supan's water on a pane.
#ifndef RG_CORE_TECHNIQUES_FLOW_H
#define RG_CORE_TECHNIQUES_FLOW_H

#include <stdint.h>

#include "core/params.h"
#include "kernels/flow.h"
#include "kernels/flow_light_params.h"
#include "kernels/flow_splat_params.h"

enum flow_direction { FLOW_NEAREST, FLOW_SPLIT };

struct flow_settings {
    int resolution_px, seed;
    // movement
    double move_threshold, fast_threshold, far_share, capacity;
    int direction;
    double pitch_deg, yaw_deg, roll_deg;
    // maps
    char remainder_map[RG_PATH_SIZE], noise_map[RG_PATH_SIZE];
    double remainder_low, remainder_low_height, remainder_max_height;
    double noise_low, noise_window, noise_scroll_x, noise_scroll_y;
    // sources
    int drops;
    double rain_drops_s, step_s, pane_mm, drop_radius_min_mm, drop_radius_max_mm, height_per_mm;
    // lighting
    double relief, wet_height, view_angle_deg;
    double fresnel_bias, fresnel_scale, refraction_strength, reflectivity;
    char environment[RG_PATH_SIZE];
    int environment_px, reflection_px, fresnel_power;
};

extern const struct rg_param_table flow_param_table;
extern const struct rg_proof flow_proof;

// What an instance's state holds, in this order.
enum flow_state { FLOW_STATE_WATER, FLOW_STATE_LEDGER, FLOW_STATE_COUNT };

// A pane's frame in the world: tangent (right), binormal (down) and normal (towards the viewer),
// each of unit length, for its three angles. Row-major: the matrix of the paper's equation 1.
void flow_pane_frame(const struct flow_settings *settings, double frame[3][3]);

// The parameters of the movement's kernels at a frame.
flow_params flow_params_at(const struct flow_settings *settings, int noise_size, int64_t frame);

// The parameters of the lighting's kernels for a target of width x height pixels.
flow_light_params flow_light_params_of(const struct flow_settings *settings, int width, int height);

// The level of the environment that drops reflect, by the settings' sizes.
int flow_reflection_level(const struct flow_settings *settings);

// The drop of this number: of the seeded ones (`frame` is -1), or of those that fall in a frame.
flow_splat_params flow_drop(const struct flow_settings *settings, int64_t frame, int number);
// How many drops fall in a frame: constant in the mean, without randomness.
int flow_drops_at(const struct flow_settings *settings, int64_t frame);

// The remainder map (FLOW_REMAINDER_ENTRIES floats, 0 to 1) and the noise map (size x size floats),
// generated or read from the user's image. The caller frees them. NULL, and one logged line, on
// failure.
float *flow_remainder_map(const struct flow_settings *settings);
float *flow_noise_map(const struct flow_settings *settings, int *size);

#endif
