#include "core/techniques/shower/shower.h"

#define AT(field) offsetof(struct shower_settings, field)

// clang-format off
static const struct rg_param rows[] = {
    {"seed", RG_PARAM_INT, AT(seed), 1, 0, 2147483647, "1", "of all chance", NULL},
    {"particles", RG_PARAM_INT, AT(particles), 50000, 0, 100000000, "1", "that are expected in the system (ExpectedNum); 0: no rain", NULL},
    {"variation", RG_PARAM_FLOAT, AT(variation), 0.05, 0, 1, "1", "by which their number varies at random where they are born and die (C0)", NULL},
    {"system", RG_PARAM_CHOICE, AT(system), SHOWER_IMPROVED, 0, 1, "1", "the particle system of the paper's section II or III; the six switches below change a part of it", "traditional improved"},
    {"state", RG_PARAM_CHOICE, AT(state), SHOWER_AUTO, 0, 2, "1", "what is kept of a particle: all attributes, or place and rate of decline (III.A); auto: as the system has it, here and below", "auto full compact"},
    {"shape", RG_PARAM_CHOICE, AT(shape), SHOWER_AUTO, 0, 2, "1", "what drops are drawn as: quads with a texture, or line segments (III.A)", "auto quads segments"},
    {"crop", RG_PARAM_CHOICE, AT(crop), SHOWER_AUTO, 0, 2, "1", "what of a drop is tested against the six sides of what is seen: its corners, or its point (III.B)", "auto corners point"},
    {"motion", RG_PARAM_CHOICE, AT(motion), SHOWER_AUTO, 0, 2, "1", "accelerated and integrated, or at each drop's own speed (III.C)", "auto euler uniform"},
    {"renewal", RG_PARAM_CHOICE, AT(renewal), SHOWER_AUTO, 0, 3, "1", "particles that end give back their slot and others are born, or are promoted to the top (III.D); heap: one thread of the host allocates and frees each", "auto birth promotion heap"},
    {"layers", RG_PARAM_CHOICE, AT(layers), SHOWER_AUTO, 0, 2, "1", "whether drops of three layers are smaller and slower from layer to layer (III.E)", "auto off on"},
    {"memory_mb", RG_PARAM_INT, AT(memory_mb), 4096, 1, 1000000, "MB", "the most that particles may take", NULL},
    {"birth", RG_PARAM_CHOICE, AT(birth), SHOWER_PAPER, 0, 2, "1", "where particles are born: in the upper half of what is seen, as eq. 7 has it; in the whole; or there in each cubic metre alike", "paper whole volume"},
    {"near_m", RG_PARAM_FLOAT, AT(near_m), 1, 0.2, 1000, "m", "nearest particles (d_near)", NULL},
    {"drop_height_m", RG_PARAM_FLOAT, AT(drop_height_m), 0.1, 0.001, 10, "m", "of a drop as it is seen (h_p); the farthest are a pixel high", NULL},
    {"drop_width_m", RG_PARAM_FLOAT, AT(drop_width_m), 0.003, 0.0001, 1, "m", "of a drop as it is seen", NULL},
    {"wind_m_s", RG_PARAM_FLOAT, AT(wind_m_s), 1, 0, 340, "m/s", "speed of the wind (v_w), below that of sound", NULL},
    {"wind_deg", RG_PARAM_FLOAT, AT(wind_deg), 0, -360, 360, "deg", "where the wind blows to (eta): 0 along x, 90 along z", NULL},
    {"gust", RG_PARAM_FLOAT, AT(gust), 0, 0, 1, "1", "share of its speed by which the wind rises and falls", NULL},
    {"gust_s", RG_PARAM_FLOAT, AT(gust_s), 4, 0.1, 1000, "s", "from one gust to the next", NULL},
    {"fall_m_s", RG_PARAM_FLOAT, AT(fall_m_s), 10, 0.1, 1000, "m/s", "at which a new particle falls", NULL},
    {"gravity_m_s2", RG_PARAM_FLOAT, AT(gravity_m_s2), 9.8, 0, 1000, "m/s2", "acceleration of particles that are accelerated", NULL},
    {"step_s", RG_PARAM_FLOAT, AT(step_s), 1.0 / 60, 1e-4, 1, "s", "time that a frame stands for", NULL},
    {"landing", RG_PARAM_CHOICE, AT(lands_on_mesh), 1, 0, 1, "1", "what particles end on: the ground plane alone, or what of the scene stands highest", "plane mesh"},
    {"map_px", RG_PARAM_INT, AT(map_px), 2048, 16, 16384, "px", "a side of the map of the scene seen from above", NULL},
    {"scene", RG_PARAM_FILE, AT(scene), 0, 0, 0, "file", "where it rains: 'city', a model by name, or a mesh file", "city"},
    {"city", RG_PARAM_CHOICE, AT(city), 0, 0, 1, "1", "the city of 779,287 triangles, or a simpler one", "full small"},
    {"city_seed", RG_PARAM_INT, AT(city_seed), 1, 0, 2147483647, "1", "of the city", NULL},
    {"geometry", RG_PARAM_CHOICE, AT(geometry), 1, 0, 1, "1", "whether there is a scene; off: rain before an even sky, down to the ground plane", "off on"},
    {"shadows", RG_PARAM_CHOICE, AT(shadows), 1, 0, 1, "1", "whether the scene casts shadows on itself", "off on"},
    {"shadow_map_px", RG_PARAM_INT, AT(shadow_map_px), 2048, 16, 8192, "px", "a side of the sun's shadow map", NULL},
    {"eye_x_m", RG_PARAM_FLOAT, AT(eye_x_m), -4.9, -1e6, 1e6, "m", "the viewer's place", NULL},
    {"eye_y_m", RG_PARAM_FLOAT, AT(eye_y_m), 2.5, -1e6, 1e6, "m", "above the ground", NULL},
    {"eye_z_m", RG_PARAM_FLOAT, AT(eye_z_m), 93, -1e6, 1e6, "m", "the viewer's place", NULL},
    {"heading_deg", RG_PARAM_FLOAT, AT(heading_deg), -5.1, -360, 360, "deg", "the viewer's turn about the upright axis (p): 0 looks along -z; the view is level, as in the paper", NULL},
    {"view_angle_deg", RG_PARAM_FLOAT, AT(view_angle_deg), 60, 1, 150, "deg", "vertical angle of view (beta)", NULL},
    {"walk_m_s", RG_PARAM_FLOAT, AT(walk_m_s), 0, -1000, 1000, "m/s", "how fast the viewer walks ahead", NULL},
    {"light", RG_PARAM_FLOAT, AT(light), 1.5, 0, 1000, "1", "of drops, in that of the sky overhead", NULL},
    {"opacity", RG_PARAM_FLOAT, AT(opacity), 0.6, 0, 1, "1", "what a drop hides of what lies behind it", NULL},
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
