#include "core/techniques/flow.h"

#define AT(field) offsetof(struct flow_settings, field)

// clang-format off
static const struct rg_param rows[] = {
    {"resolution_px", RG_PARAM_INT, AT(resolution_px), 512, 16, 8192, "px", "texels along a side of the water's height map", NULL},
    {"seed", RG_PARAM_INT, AT(seed), 1, 0, 2147483647, "1", "of the drops and of the generated noise map", NULL},
    {"move_threshold", RG_PARAM_FLOAT, AT(move_threshold), 0.15, 0, 16, "height", "L: a texel with more water than this starts to give it away", NULL},
    {"fast_threshold", RG_PARAM_FLOAT, AT(fast_threshold), 0.6, 0, 16, "height", "M: a texel with more water than this also reaches the texel two below", NULL},
    {"far_share", RG_PARAM_FLOAT, AT(far_share), 0.5, 0, 1, "1", "r: the share of the given water that goes two texels below", NULL},
    {"capacity", RG_PARAM_FLOAT, AT(capacity), 8, 1, 64, "height", "water above which a texel takes no more drops, and keeps none", NULL},
    {"direction", RG_PARAM_CHOICE, AT(direction), FLOW_NEAREST, 0, 1, "1", "of the flow: to the nearest of eight neighbours, or split between the two nearest", "nearest split"},
    {"pane_pitch_deg", RG_PARAM_FLOAT, AT(pitch_deg), 0, -180, 180, "deg", "turns the pane about its horizontal axis; 90 lays it flat, face up", NULL},
    {"pane_yaw_deg", RG_PARAM_FLOAT, AT(yaw_deg), 0, -180, 180, "deg", "turns the pane about the vertical", NULL},
    {"pane_roll_deg", RG_PARAM_FLOAT, AT(roll_deg), 0, -180, 180, "deg", "turns the pane about its normal, clockwise as the viewer sees it", NULL},
    {"remainder_map", RG_PARAM_FILE, AT(remainder_map), 0, 0, 0, "file", "an image whose first row says what share of its water a texel keeps; none: generated", ""},
    {"remainder_low", RG_PARAM_FLOAT, AT(remainder_low), 0.3, 0, 1, "1", "the share that the generated remainder map lets much water keep", NULL},
    {"remainder_low_height", RG_PARAM_FLOAT, AT(remainder_low_height), 1, 0, 64, "height", "water from which on the generated remainder map is at its low", NULL},
    {"remainder_max_height", RG_PARAM_FLOAT, AT(remainder_max_height), 2, 0.01, 64, "height", "water at the remainder map's right edge", NULL},
    {"noise_map", RG_PARAM_FILE, AT(noise_map), 0, 0, 0, "file", "an image that varies the remainder over the pane; none: generated", ""},
    {"noise_low", RG_PARAM_FLOAT, AT(noise_low), 0.7, 0, 1, "1", "darkest value of the generated noise map; the brightest is 1", NULL},
    {"noise_window", RG_PARAM_FLOAT, AT(noise_window), 0.5, 0.01, 1, "1", "the part of the noise map that lies over the pane, along a side", NULL},
    {"noise_scroll_x", RG_PARAM_FLOAT, AT(noise_scroll_x), 0.013, -1, 1, "map/frame", "how far the window moves across the noise map", NULL},
    {"noise_scroll_y", RG_PARAM_FLOAT, AT(noise_scroll_y), 0.007, -1, 1, "map/frame", "how far the window moves down the noise map", NULL},
    {"drops", RG_PARAM_INT, AT(drops), 160, 0, 100000, "1", "seeded drops on the pane at the start", NULL},
    {"rain_drops_s", RG_PARAM_FLOAT, AT(rain_drops_s), 60, 0, 60000, "1/s", "drops that fall on the pane", NULL},
    {"step_s", RG_PARAM_FLOAT, AT(step_s), 1.0 / 60, 1e-4, 1, "s", "time that a frame stands for", NULL},
    {"pane_mm", RG_PARAM_FLOAT, AT(pane_mm), 150, 1, 10000, "mm", "a side of the pane", NULL},
    {"drop_radius_min_mm", RG_PARAM_FLOAT, AT(drop_radius_min_mm), 1, 0.01, 100, "mm", "of the smallest drop", NULL},
    {"drop_radius_max_mm", RG_PARAM_FLOAT, AT(drop_radius_max_mm), 4, 0.01, 100, "mm", "of the largest drop", NULL},
    {"drop_height_per_mm", RG_PARAM_FLOAT, AT(height_per_mm), 0.4, 0, 16, "height/mm", "height of a drop's middle by its radius", NULL},
    {"relief", RG_PARAM_FLOAT, AT(relief), 2.5, 0, 100, "mm/height", "how high a unit of water stands, for the normal map", NULL},
    {"wet_height", RG_PARAM_FLOAT, AT(wet_height), 0.04, 0.001, 16, "height", "water from which on a texel looks fully wet", NULL},
    {"view_angle_deg", RG_PARAM_FLOAT, AT(view_angle_deg), 45, 1, 150, "deg", "vertical angle of view", NULL},
    {"fresnel_bias", RG_PARAM_FLOAT, AT(fresnel_bias), 0.02, 0, 1, "1", "reflectance of water seen head-on", NULL},
    {"fresnel_scale", RG_PARAM_FLOAT, AT(fresnel_scale), 0.98, 0, 1, "1", "what a grazing view adds to the bias", NULL},
    {"fresnel_power", RG_PARAM_INT, AT(fresnel_power), 5, 1, 15, "1", "exponent of the Fresnel model", NULL},
    {"refraction_strength", RG_PARAM_FLOAT, AT(refraction_strength), 0.6, -4, 4, "1", "how far a drop bends the view of what lies behind it", NULL},
    {"reflectivity", RG_PARAM_FLOAT, AT(reflectivity), 0.85, 0, 1, "1", "of the mirror behind the water", NULL},
    {"environment", RG_PARAM_FILE, AT(environment), 0, 0, 0, "file", "a map of open3d-gui-data by name, 'sky', a KTX cube map, or a lat-long image", "crossroads"},
    {"environment_px", RG_PARAM_INT, AT(environment_px), 512, 16, 4096, "px", "texels along a face that the environment is resampled to", NULL},
    {"reflection_px", RG_PARAM_INT, AT(reflection_px), 64, 1, 4096, "px", "texels along a face of what drops reflect, at least: they show the environment small", NULL},
};
// clang-format on

const struct rg_param_table flow_param_table = {
    .technique = "flow",
    .rows = rows,
    .count = sizeof(rows) / sizeof(rows[0]),
    .settings_size = sizeof(struct flow_settings),
};
