#include "core/techniques/cartoon/cartoon.h"

#define AT(field) offsetof(struct cartoon_settings, field)

// clang-format off
static const struct rg_param rows[] = {
    {"seed", RG_PARAM_INT, AT(seed), 1, 0, 2147483647, "1", "of all chance", NULL},
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
};
// clang-format on

const struct rg_param_table cartoon_param_table = {
    .technique = "cartoon",
    .rows = rows,
    .count = sizeof(rows) / sizeof(rows[0]),
    .settings_size = sizeof(struct cartoon_settings),
};
