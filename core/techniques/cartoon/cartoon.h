// cartoon: rain in cartoon style that falls on a scene in one of the styles of drawings, after Z.
// Feng et al., "Real-time Rain Simulation in Cartoon Style". docs/cartoon.md explains.
#ifndef RG_CORE_TECHNIQUES_CARTOON_CARTOON_H
#define RG_CORE_TECHNIQUES_CARTOON_CARTOON_H

#include "core/techniques/cartoon/rain/settings.h"

enum { CARTOON_MESH = 7 }; // of scenes: a user's mesh; those before it are enum diorama_scene
enum cartoon_style {
    CARTOON_GOOCH,
    CARTOON_GOOCH_OUTLINES,
    CARTOON_TONED,
    CARTOON_TONED_OUTLINES,
    CARTOON_OUTLINES,
    CARTOON_HATCHING,
    CARTOON_STYLES
};

// When the scene is drawn anew.
enum cartoon_redraw { CARTOON_ALWAYS, CARTOON_MOVED };

struct cartoon_settings {
    int seed, preset;
    // The scene.
    int scene;
    char mesh[RG_PATH_SIZE];
    int style; // enum cartoon_style
    // The camera, against that of the scene, and the light.
    double turn_deg, rise_deg, zoom, spin_deg;
    double light_turn_deg, light_rise_deg;
    double ink[3], paper[3]; // red, green, blue, as display values
    // Outlines.
    double outline_px, inner_px, crease_deg;
    // The style of Gooch.
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
