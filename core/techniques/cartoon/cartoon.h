// cartoon: rain in cartoon style over a scene drawn in one of several styles, after Z. Feng et al.,
// "Real-time Rain Simulation in Cartoon Style". docs/cartoon.md explains.
#ifndef RG_CORE_TECHNIQUES_CARTOON_CARTOON_H
#define RG_CORE_TECHNIQUES_CARTOON_CARTOON_H

#include "core/techniques/cartoon/rain/settings.h"

enum { CARTOON_MESH = 7 }; // the scene that is a user's mesh; lower values are enum diorama_scene
enum cartoon_style {
    CARTOON_GOOCH,
    CARTOON_GOOCH_OUTLINES,
    CARTOON_TONED,
    CARTOON_TONED_OUTLINES,
    CARTOON_OUTLINES,
    CARTOON_HATCHING,
    CARTOON_STYLES
};

// When the scene is redrawn: each frame, or when its view has moved.
enum cartoon_redraw { CARTOON_ALWAYS, CARTOON_MOVED };

struct cartoon_settings {
    int seed, preset;
    // The scene.
    int scene;
    char mesh[RG_PATH_SIZE];
    int style; // enum cartoon_style
    // The camera and the light, relative to the scene's own camera.
    double turn_deg, rise_deg, zoom, spin_deg;
    double light_turn_deg, light_rise_deg;
    double ink[3], paper[3]; // red, green, blue, as display values
    // Outlines.
    double outline_px, inner_px, crease_deg;
    // Gooch shading.
    double gooch_blue, gooch_yellow, gooch_alpha, gooch_beta;
    // Cartoon tones.
    double shadow_tone, middle_tone, middle_from, lit_from, tone_softness, glint_from, shadow_blue;
    // Hatching.
    double hatch_px, hatch_ambient, hatch_lit, hatch_wash;
    int redraw; // enum cartoon_redraw
    struct cartoon_rain_settings rain;
    struct cartoon_water_settings water;
};

extern const struct rg_param_table cartoon_param_table;

#endif
