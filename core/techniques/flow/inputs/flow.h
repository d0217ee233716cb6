// flow: the settings, parameters and host-side inputs of Stuppacher & Supan's water on panes.
#ifndef RG_CORE_TECHNIQUES_FLOW_INPUTS_FLOW_H
#define RG_CORE_TECHNIQUES_FLOW_INPUTS_FLOW_H

#include <stdint.h>

#include "core/techniques/params.h"
#include "kernels/flow/panes/normals_params.h"
#include "kernels/flow/panes/view_params.h"
#include "kernels/flow/water/splat_params.h"
#include "kernels/flow/water/water.h"

#define FLOW_MOST_DROPS_S 60000 // that fall on a pane

enum flow_direction { FLOW_NEAREST, FLOW_SPLIT, FLOW_EACH_TEXEL };
enum flow_scene { FLOW_BOX, FLOW_ONE_PANE };
enum flow_move { FLOW_MOVE_SLIDING, FLOW_MOVE_PAPER };
enum flow_sides { FLOW_FRONT_SIDES, FLOW_BOTH_SIDES };
enum flow_material { FLOW_GLASS, FLOW_MIRROR };
enum flow_stage { FLOW_STAGE_HEIGHT, FLOW_STAGE_BLURRED, FLOW_STAGE_NORMALS, FLOW_STAGE_FINAL };

struct flow_settings {
    // scene
    int view, panes, stage;
    char model[RG_PATH_SIZE];
    int model_faces, model_sides;
    double model_size, model_grey;
    double distance_mm, camera_mm_s, camera_azimuth_deg, camera_elevation_deg, view_angle_deg;
    double pitch_deg, yaw_deg, roll_deg;
    double spin_pitch_deg_s, spin_yaw_deg_s, spin_roll_deg_s;
    double pane_mm, frame_mm;
    // movement
    int move;
    int resolution_px, seed;
    double texels_a_pixel;
    double move_threshold, fast_threshold, far_share, capacity;
    double sweep;
    int reach_texels, direction, run_on;
    // sliding drops
    double slide_above_mm3, slide_gain_mm_s, slide_most_mm_s;
    double levelling_mm_s, cohesion, contact_slope;
    double bead_mm, bead_spacing_mm, drying_mm2_s;
    // maps
    char remainder_map[RG_PATH_SIZE], noise_map[RG_PATH_SIZE];
    double remainder_low, remainder_low_height, remainder_max_height;
    double noise_low, noise_window, noise_scroll_x, noise_scroll_y;
    // sources
    int drops;
    double pane_rain_mm_h, contact_deg;
    double rain_drops_s, step_s, drop_radius_min_mm, drop_radius_max_mm, height_per_mm;
    int survey;
    // lighting
    int blur;
    double relief, wet_height;
    double fresnel_bias, fresnel_scale, refraction_strength, reflectivity;
    char environment[RG_PATH_SIZE];
    int environment_px, reflection_px, fresnel_power;
    double light, light_azimuth_deg, light_elevation_deg, drop_shadow;
    double glow, glow_threshold;
};

extern const struct rg_param_table flow_param_table;

// The items of an instance's state, in order.
enum flow_state { FLOW_STATE_WATER, FLOW_STATE_LEDGER };

// The number of panes in the scene: 6, or 1. Their order is front, back, right, left, top, bottom.
int flow_pane_count(const struct flow_settings *settings);

// A pane's frame in the world at a frame of the simulation: tangent (right), binormal (down) and
// normal (outwards), each of unit length. Row-major: the matrix of the paper's equation 1.
void flow_pane_frame(const struct flow_settings *settings, int pane, int64_t frame,
                     double axes[3][3]);

// Fills in the properties by which panes differ at a frame, for FLOW_MAX_PANES or fewer.
void flow_panes_at(const struct flow_settings *settings, int noise_size, int64_t frame,
                   flow_pane *panes);

// The camera's distance from the middle of the box at a frame. It stays half a pane's side away
// from the box's corners, unless it starts nearer.
double flow_distance_mm(const struct flow_settings *settings, int64_t frame);
double flow_texel_mm(const struct flow_settings *settings);
// Texels along a side of a pane: resolution_px, or as many as the camera's distance asks for.
int flow_texels(const struct flow_settings *settings, int64_t frame, int height_px);

// The parameters of the movement's and the normal map's kernels at a frame.
flow_params flow_params_at(const struct flow_settings *settings, int noise_size, int64_t frame);
flow_normals_params flow_normals_params_of(const struct flow_settings *settings);

// The parameters of the drawing passes for panes and sky, at a frame and a target of width x height
// pixels. False, with one logged line, when the camera sees nothing.
bool flow_view_params_at(const struct flow_settings *settings, int64_t frame, int width, int height,
                         flow_view_params *params);
// Changes the panes' parameters to those of a model with these bounds.
void flow_view_model(const struct flow_settings *settings, int64_t frame, const float low[3],
                     const float high[3], flow_view_params *params);

// The number of levels of the environment, down to the one used as ambient light; and the level
// that drops reflect.
int flow_environment_levels(const struct flow_settings *settings);
int flow_reflection_level(const struct flow_settings *settings);

// Streams of random numbers: each of these on each pane.
enum {
    FLOW_STREAM_SEEDED = 1,
    FLOW_STREAM_RAIN = 2,
    FLOW_STREAM_SIZES = 4,
    FLOW_STREAMS_A_PANE = 16
};

// The whole part of a number that is clamped.
int flow_clamp(double value, int low, int high);
// The part of a number above the next lower whole one.
double flow_fraction(double x);
// The n-th number of a sequence that fills 0 to 1 evenly, however far it is taken: multiples of the
// golden ratio.
double flow_even(int64_t n);

// A drop of move=paper by its number on a pane: one of the initial ones if `frame` is -1, else of
// those that fall in that frame. inputs/rain.h has those of move=sliding.
flow_splat_params flow_drop(const struct flow_settings *settings, int pane, int64_t frame,
                            int number);

// The remainder map (FLOW_REMAINDER_ENTRIES floats, 0 to 1) and the noise map (size x size floats),
// generated or read from the user's image. The caller frees them. NULL, and one logged line, on
// failure.
float *flow_remainder_map(const struct flow_settings *settings);
float *flow_noise_map(const struct flow_settings *settings, int *size);
// The water that clings to each texel of a pane with sliding drops, in units of height: size x size
// floats that tile horizontally. Ownership and errors as above.
float *flow_bead_map(const struct flow_settings *settings);

#endif
