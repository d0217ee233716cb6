#include "core/techniques/shower/shower.h"

#define AT(field) offsetof(struct shower_settings, field)

// clang-format off
static const struct rg_param rows[] = {
    {"seed", RG_PARAM_INT, AT(seed), 1, 0, 2147483647, "1", "seed of all random numbers", NULL},
    {"particles", RG_PARAM_INT, AT(particles), 50000, 0, 100000000, "1", "expected number of particles (ExpectedNum); 0: no rain", NULL},
    {"variation", RG_PARAM_FLOAT, AT(variation), 0.05, 0, 1, "1", "share by which the number of particles varies at random where they are born and die (C0)", NULL},
    {"system", RG_PARAM_CHOICE, AT(system), SHOWER_IMPROVED, 0, 1, "1", "particle system of the paper's section II or III; each of the six switches below changes a part of it", "traditional improved"},
    {"state", RG_PARAM_CHOICE, AT(state), SHOWER_AUTO, 0, 2, "1", "what is stored of a particle: all attributes, or place and rate of decline (III.A); auto, here and below: the system's way", "auto full compact"},
    {"shape", RG_PARAM_CHOICE, AT(shape), SHOWER_AUTO, 0, 2, "1", "how drops are drawn: as quads with a texture, or as line segments (III.A)", "auto quads segments"},
    {"crop", RG_PARAM_CHOICE, AT(crop), SHOWER_AUTO, 0, 2, "1", "what of a drop is tested against the view's six planes: its corners, or its point (III.B)", "auto corners point"},
    {"motion", RG_PARAM_CHOICE, AT(motion), SHOWER_AUTO, 0, 2, "1", "how drops move: accelerated and integrated, or each at its own speed (III.C)", "auto euler uniform"},
    {"renewal", RG_PARAM_CHOICE, AT(renewal), SHOWER_AUTO, 0, 3, "1", "how particles that end are replaced: births take their slots, or they are promoted to the top (III.D); heap: one thread of the host allocates and frees each", "auto birth promotion heap"},
    {"layers", RG_PARAM_CHOICE, AT(layers), SHOWER_AUTO, 0, 2, "1", "whether drops become smaller and slower from layer to layer, in three layers (III.E)", "auto off on"},
    {"memory_mb", RG_PARAM_INT, AT(memory_mb), 4096, 1, 1000000, "MB", "most memory that particles may take", NULL},
    {"birth", RG_PARAM_CHOICE, AT(birth), SHOWER_PAPER, 0, 2, "1", "where particles are born: in the upper half of the view, by eq. 7; in the whole view; or there, evenly in each cubic metre", "paper whole volume"},
    {"near_m", RG_PARAM_FLOAT, AT(near_m), 1, 0.2, 1000, "m", "distance of the nearest particles (d_near)", NULL},
    {"drop_height_m", RG_PARAM_FLOAT, AT(drop_height_m), 0.1, 0.001, 10, "m", "height of a drop as drawn (h_p); the farthest drops are a pixel high", NULL},
    {"drop_width_m", RG_PARAM_FLOAT, AT(drop_width_m), 0.003, 0.0001, 1, "m", "width of a drop as drawn", NULL},
    {"wind_m_s", RG_PARAM_FLOAT, AT(wind_m_s), 1, 0, 340, "m/s", "speed of the wind (v_w), below that of sound", NULL},
    {"wind_deg", RG_PARAM_FLOAT, AT(wind_deg), 0, -360, 360, "deg", "direction that the wind blows to (eta): 0 along x, 90 along z", NULL},
    {"gust", RG_PARAM_FLOAT, AT(gust), 0, 0, 1, "1", "share of the wind's speed by which it rises and falls", NULL},
    {"gust_s", RG_PARAM_FLOAT, AT(gust_s), 4, 0.1, 1000, "s", "time from one gust to the next", NULL},
    {"fall_m_s", RG_PARAM_FLOAT, AT(fall_m_s), 10, 0.1, 1000, "m/s", "speed at which a new particle falls", NULL},
    {"gravity_m_s2", RG_PARAM_FLOAT, AT(gravity_m_s2), 9.8, 0, 1000, "m/s2", "acceleration of particles, where they are accelerated", NULL},
    {"step_s", RG_PARAM_FLOAT, AT(step_s), 1.0 / 60, 1e-4, 1, "s", "simulated time per frame", NULL},
    {"landing", RG_PARAM_CHOICE, AT(lands_on_mesh), 1, 0, 1, "1", "where particles end: on the ground plane alone, or on the highest surface of the scene", "plane mesh"},
    {"map_px", RG_PARAM_INT, AT(map_px), 2048, 16, 16384, "px", "side of the map of the scene seen from above", NULL},
    {"scene", RG_PARAM_FILE, AT(scene), 0, 0, 0, "file", "place where it rains: 'city', a model by name, or a mesh file", "city"},
    {"city", RG_PARAM_CHOICE, AT(city), 0, 0, 1, "1", "version of the city: the one of 779,287 triangles, or a simpler one", "full small"},
    {"city_seed", RG_PARAM_INT, AT(city_seed), 1, 0, 2147483647, "1", "seed of the city", NULL},
    {"geometry", RG_PARAM_CHOICE, AT(geometry), 1, 0, 1, "1", "whether there is a scene; off: rain before a uniform sky, down to the ground plane", "off on"},
    {"shadows", RG_PARAM_CHOICE, AT(shadows), 1, 0, 1, "1", "whether the scene casts shadows on itself", "off on"},
    {"shadow_map_px", RG_PARAM_INT, AT(shadow_map_px), 2048, 16, 8192, "px", "side of the sun's shadow map", NULL},
    {"eye_x_m", RG_PARAM_FLOAT, AT(eye_x_m), -4.9, -1e6, 1e6, "m", "x of the viewer's place", NULL},
    {"eye_y_m", RG_PARAM_FLOAT, AT(eye_y_m), 2.5, -1e6, 1e6, "m", "height of the viewer above the ground", NULL},
    {"eye_z_m", RG_PARAM_FLOAT, AT(eye_z_m), 93, -1e6, 1e6, "m", "z of the viewer's place", NULL},
    {"heading_deg", RG_PARAM_FLOAT, AT(heading_deg), -5.1, -360, 360, "deg", "turn of the viewer about the upright axis (p): 0 looks along -z; the view is level, as in the paper", NULL},
    {"view_angle_deg", RG_PARAM_FLOAT, AT(view_angle_deg), 60, 1, 150, "deg", "vertical angle of view (beta)", NULL},
    {"walk_m_s", RG_PARAM_FLOAT, AT(walk_m_s), 0, -1000, 1000, "m/s", "speed at which the viewer walks ahead", NULL},
    {"light", RG_PARAM_FLOAT, AT(light), 1.5, 0, 1000, "1", "light of drops, as a multiple of that of the sky overhead", NULL},
    {"opacity", RG_PARAM_FLOAT, AT(opacity), 0.6, 0, 1, "1", "how much of what is behind it a drop hides; 1: all", NULL},
};
// clang-format on

const struct rg_param_table shower_param_table = {
    .technique = "shower",
    .rows = rows,
    .count = sizeof(rows) / sizeof(rows[0]),
    .settings_size = sizeof(struct shower_settings),
};

bool shower_is_new(const struct shower_settings *s, int choice)
{
    return choice == SHOWER_NEW || (choice == SHOWER_AUTO && s->system == SHOWER_IMPROVED);
}
