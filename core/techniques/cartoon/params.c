#include "core/techniques/cartoon/cartoon.h"
#include "kernels/cartoon/rain/params.h"

#define AT(field) offsetof(struct cartoon_settings, field)

// clang-format off
static const struct rg_param rows[] = {
    {"seed", RG_PARAM_INT, AT(seed), 1, 0, 2147483647, "1", "of all chance", NULL},
    {"preset", RG_PARAM_CHOICE, AT(preset), 0, 0, 4, "1", "settings together, which others may follow: those of the paper's figure 6, or a storm", "none car table park2 storm"},
    {"scene", RG_PARAM_CHOICE, AT(scene), 0, 0, CARTOON_MESH, "1", "what it rains on; mesh: what the parameter mesh names", "car house1 house2 table park1 park2 ground mesh"},
    {"mesh", RG_PARAM_FILE, AT(mesh), 0, 0, 0, "file", "the mesh of scene=mesh: a name such as bunny, armadillo or torus, or a file", "torus"},
    {"style", RG_PARAM_CHOICE, AT(style), CARTOON_TONED_OUTLINES, 0, CARTOON_STYLES - 1, "1", "how the scene is drawn", "gooch gooch_outlines cartoon cartoon_outlines outlines hatching"},
    {"turn_deg", RG_PARAM_FLOAT, AT(turn_deg), 0, -360, 360, "deg", "how far the camera is turned about the scene, counter-clockwise seen from above", NULL},
    {"rise_deg", RG_PARAM_FLOAT, AT(rise_deg), 0, -90, 90, "deg", "how much higher above the horizon the camera is than the scene's own", NULL},
    {"zoom", RG_PARAM_FLOAT, AT(zoom), 1, 0.05, 20, "1", "the camera comes so many times nearer", NULL},
    {"spin_deg", RG_PARAM_FLOAT, AT(spin_deg), 0, -180, 180, "deg/frame", "how fast the camera goes round the scene", NULL},
    {"light_turn_deg", RG_PARAM_FLOAT, AT(light_turn_deg), -50, -360, 360, "deg", "where the light comes from: about the upright axis, from where the camera stands at first", NULL},
    {"light_rise_deg", RG_PARAM_FLOAT, AT(light_rise_deg), 45, -90, 90, "deg", "how high above the horizon the light is", NULL},
    {"outline_px", RG_PARAM_FLOAT, AT(outline_px), 1.6, 0, 32, "px", "width of contours and boundaries", NULL},
    {"inner_px", RG_PARAM_FLOAT, AT(inner_px), 0.9, 0, 32, "px", "width of creases", NULL},
    {"crease_deg", RG_PARAM_FLOAT, AT(crease_deg), 40, 0, 180, "deg", "faces that differ by more make a crease", NULL},
    {"gooch_blue", RG_PARAM_FLOAT, AT(gooch_blue), 0.4, 0, 1, "1", "blue of cool light, as display value", NULL},
    {"gooch_yellow", RG_PARAM_FLOAT, AT(gooch_yellow), 0.4, 0, 1, "1", "red and green of warm light, as display value", NULL},
    {"gooch_alpha", RG_PARAM_FLOAT, AT(gooch_alpha), 0.2, 0, 1, "1", "share of the material's colour in cool light", NULL},
    {"gooch_beta", RG_PARAM_FLOAT, AT(gooch_beta), 0.6, 0, 1, "1", "share of the material's colour in warm light", NULL},
    {"shadow_tone", RG_PARAM_FLOAT, AT(shadow_tone), 0.62, 0, 1, "1", "of the material's colour in the cartoon's shadow, as display value", NULL},
    {"middle_tone", RG_PARAM_FLOAT, AT(middle_tone), 0.84, 0, 1, "1", "of the material's colour between shadow and light, as display value", NULL},
    {"middle_from", RG_PARAM_FLOAT, AT(middle_from), 0.2, 0, 1, "1", "cosine of the light's angle at which the shadow ends", NULL},
    {"lit_from", RG_PARAM_FLOAT, AT(lit_from), 0.55, 0, 1, "1", "cosine of the light's angle at which full light begins", NULL},
    {"tone_softness", RG_PARAM_FLOAT, AT(tone_softness), 0.03, 0.0001, 1, "1", "how wide the step between two tones is, as cosine", NULL},
    {"hatch_px", RG_PARAM_FLOAT, AT(hatch_px), 200, 16, 4096, "px", "side of a tile of strokes at the distance of what the camera looks at", NULL},
    {"hatch_ambient", RG_PARAM_FLOAT, AT(hatch_ambient), 0.3, 0, 1, "1", "tone of what faces away from the light, 0 darkest to 1", NULL},
    {"hatch_wash", RG_PARAM_FLOAT, AT(hatch_wash), 0.35, 0, 1, "1", "share of the material's colour on the paper of hatching; 0: white paper", NULL},
    {"redraw", RG_PARAM_CHOICE, AT(redraw), CARTOON_MOVED, 0, 1, "1", "when the scene's normal map, depth and outlines are drawn: in each frame, or where the camera has moved; the picture is the same", "always moved"},
    {"drops_s", RG_PARAM_INT, AT(rain.drops_s), 6000, 0, 1000000000, "1/s", "drops that are released", NULL},
    {"steps_s", RG_PARAM_INT, AT(rain.steps_s), 60, 1, 1000, "1/s", "steps, and so frames, of a second", NULL},
    {"top_m", RG_PARAM_FLOAT, AT(rain.top_m), 0, 0, 1000, "m", "above the ground where drops start; 0: above the scene, and as high as a drop falls in a second", NULL},
    {"speed_m_s", RG_PARAM_FLOAT, AT(rain.speed_m_s), 8, 0.1, 50, "m/s", "with which the heaviest drops start", NULL},
    {"spread_deg", RG_PARAM_FLOAT, AT(rain.spread_deg), 2, 0, 60, "deg", "how far from straight down they may start", NULL},
    {"gravity_m_s2", RG_PARAM_FLOAT, AT(rain.gravity_m_s2), 9.81, 0, 100, "m/s2", "which pulls drops down", NULL},
    {"drag", RG_PARAM_CHOICE, AT(rain.drag), CARTOON_DRAG_CONSTANT, 0, 1, "1", "the air's resistance: constant and vertical, as in the paper's program, or by the square of the speed", "constant quadratic"},
    {"drag_m_s2", RG_PARAM_FLOAT, AT(rain.drag_m_s2), 9, 0, 100, "m/s2", "of constant drag", NULL},
    {"drag_1_m", RG_PARAM_FLOAT, AT(rain.drag_1_m), 0.15, 0, 10, "1/m", "of quadratic drag: k of f = k v^2, for a drop's mass of 1", NULL},
    {"wind", RG_PARAM_CHOICE, AT(rain.wind), CARTOON_WIND_CONSTANT, 0, 2, "1", "whether the wind stays as it is, changes by chance, or goes by a script", "constant random script"},
    {"wind_m_s", RG_PARAM_FLOAT, AT(rain.wind_m_s), 0, 0, 340, "m/s", "the wind's speed, below that of sound; of random wind in the mean", NULL},
    {"wind_turn_deg", RG_PARAM_FLOAT, AT(rain.wind_turn_deg), 0, -360, 360, "deg", "where it blows to, counter-clockwise seen from above from x", NULL},
    {"wind_s", RG_PARAM_FLOAT, AT(rain.wind_s), 1, 0.01, 100, "s", "in which it brings a drop to its own speed, with constant drag", NULL},
    {"gust", RG_PARAM_FLOAT, AT(rain.gust), 0.6, 0, 1, "1", "share by which random wind changes", NULL},
    {"gust_s", RG_PARAM_FLOAT, AT(rain.gust_s), 1.5, 0.01, 1000, "s", "from one gust to the next", NULL},
    {"wind_script", RG_PARAM_FILE, AT(rain.wind_script), 0, 0, 0, "file", "lines of seconds, m/s and degrees, of scripted wind", ""},
    {"collide", RG_PARAM_CHOICE, AT(rain.collide), CARTOON_COLLIDE_CORRECT, 0, 2, "1", "when a drop has hit: where few samples of it are seen, as in the paper, also behind things; where its middle passes what is seen; where no sample is seen", "faithful correct any"},
    {"query", RG_PARAM_CHOICE, AT(rain.query), CARTOON_QUERY_DISCS, 0, 1, "1", "how samples are counted: as discs, or as tessellated spheres that are rasterised, a query a drop", "discs spheres"},
    {"least_samples", RG_PARAM_INT, AT(rain.least_samples), 3, 1, 1000, "1", "a drop of which fewer are seen has hit (the paper's DEFINE_COUNT)", NULL},
    {"bound_m", RG_PARAM_FLOAT, AT(rain.bound_m), 0, 0, 10, "m", "radius of the sphere about a drop; 0: 2.5 px where the scene is looked at", NULL},
    {"precision_m", RG_PARAM_FLOAT, AT(rain.precision_m), 0.001, 0.000001, 10, "m", "within which bisection finds a hit on a drop's way", NULL},
    {"drop_m", RG_PARAM_FLOAT, AT(rain.drop_m), 0, 0, 10, "m", "side of the heaviest drops' squares; 0: as suits the scene", NULL},
    {"splash_m", RG_PARAM_FLOAT, AT(rain.splash_m), 0, 0, 10, "m", "the same of their splashes", NULL},
    {"fade_s", RG_PARAM_FLOAT, AT(rain.fade_s), 0.1, 0, 10, "s", "in which a drop that has hit fades", NULL},
    {"splash_s", RG_PARAM_FLOAT, AT(rain.splash_s), 0.2, 0, 10, "s", "that a splash lasts", NULL},
    {"cut", RG_PARAM_CHOICE, AT(rain.cut), 1, 0, 1, "1", "whether sprites are cut to what is not transparent; the picture is the same", "off on"},
};
// clang-format on

// The settings of the paper's figure 6, and a storm of ours, in the order of the choices.
static const char *const presets[] = {
    "",
    "scene=car style=cartoon_outlines drops_s=15000",
    "scene=table style=cartoon drops_s=20000 wind_m_s=5 wind_turn_deg=20",
    "scene=park2 style=cartoon drops_s=18000 wind_m_s=6 wind_turn_deg=-160",
    "scene=house1 style=cartoon_outlines drops_s=20000 wind=random wind_m_s=14 wind_turn_deg=10",
};

const struct rg_param_table cartoon_param_table = {
    .technique = "cartoon",
    .rows = rows,
    .count = sizeof(rows) / sizeof(rows[0]),
    .settings_size = sizeof(struct cartoon_settings),
    .presets = presets,
};
