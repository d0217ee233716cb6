// An open flow: open.c makes it, step.c moves it and draw.c draws it.
#ifndef RG_CORE_TECHNIQUES_FLOW_INSTANCE_H
#define RG_CORE_TECHNIQUES_FLOW_INSTANCE_H

#include "core/techniques/flow/inputs/rain.h"
#include "core/techniques/flow/inputs/sliding.h"
#include "core/techniques/technique.h"
#include "kernels/flow/glow/params.h"

enum flow_pass {
    // movement
    FLOW_SPLAT,
    FLOW_LAND,
    FLOW_GIVEN,
    FLOW_DRAIN,
    FLOW_MOVE,
    FLOW_REACH,
    FLOW_SWEPT_GIVEN,
    FLOW_SWEPT_DRAIN,
    FLOW_SWEPT_MOVE,
    FLOW_ARRIVE,
    // movement of sliding drops
    FLOW_LEVEL,
    FLOW_SMOOTH_ONCE,
    FLOW_SMOOTH_TWICE,
    FLOW_SMOOTH_THRICE,
    FLOW_SMOOTH_WIDE,
    FLOW_PACE,
    FLOW_SPREAD,
    FLOW_WET_ROWS,
    FLOW_WET,
    FLOW_CLOSE_ACROSS,
    FLOW_RIDGE_ACROSS,
    FLOW_PULL,
    FLOW_RELAX_FAR,
    FLOW_RELAX,
    FLOW_CLING,
    FLOW_SLIDE_OFF,
    FLOW_SLIDE,
    // the water's surface
    FLOW_BLUR,
    FLOW_NORMALS,
    // everything that does not refract, and the final image
    FLOW_SKY,
    FLOW_DRY_MIRRORS,
    FLOW_BEHIND_MODEL,
    FLOW_MODEL,
    FLOW_COPY,
    FLOW_FAR_GLASS,
    FLOW_NEAR_GLASS,
    FLOW_MIRRORS,
    FLOW_SHOW_STAGE,
    // glow
    FLOW_GLOW_BRIGHT,
    FLOW_GLOW_ACROSS,
    FLOW_GLOW_DOWN,
    FLOW_GLOW,
    FLOW_PASS_COUNT
};

enum flow_counter { FLOW_DROPS, FLOW_TEXELS, FLOW_PIXELS, FLOW_TRIANGLES, FLOW_COUNTER_COUNT };

enum { FLOW_DROP_SIZES = 5 };

// The facts of `survey`; NULL without it.
struct flow_told {
    struct rg_fact *wet, *centre, *drops[FLOW_DROP_SIZES];
    struct rg_fact *resting, *convex; // NULL for move=paper
};

struct flow {
    struct rg_instance base;
    struct flow_settings settings; // resolution_px holds flow_texels' result
    int pane_count, noise_size;
    int finest_px;                   // the largest resolution_px as the camera moves
    struct rg_fact *texels;          // has resolution_px where the camera decides it; else NULL
    struct rg_asset *water, *moved;  // the maps of this frame and of the next, swapped
    struct rg_asset *kept, *heading; // the texels' directions, likewise; NULL: they have none
    struct flow_rain rain;
    // Of drops that slide, as they land (land.c).
    struct rg_fact *landed;          // the volume of all
    struct rg_asset *landing;        // what they bring, by texel
    uint32_t *landing_words;         // the host's copy
    double *landing_mm;              // a drop's height, by texel
    int64_t landing_texels;          // that one run reaches at most
    double owed_mm3[FLOW_MAX_PANES]; // of drops that landed, less than a droplet
    struct rg_asset *pace, *paces;   // of the lattice's cells, swapped as they spread; or NULL
    struct rg_asset *panes;          // the panes' orientations
    struct rg_asset *ways;           // the slides of water (flow_ways_at); NULL: nothing slides
    struct flow_told told;
    int model_faces; // 0: no model
    float model_low[3], model_high[3];
    // Parameters of the current frame's stages.
    flow_splat_params drop;
    flow_params movement;
    flow_slide_params sliding;
    flow_normals_params surface;
    flow_view_params view, model_view;
    flow_glow_params glow, glow_across, glow_down;
};

extern const struct rg_proof flow_proof;

bool flow_open(struct rg_instance *instance);
bool flow_step(struct rg_instance *instance);
bool flow_draw(struct rg_instance *instance);

void flow_close(struct rg_instance *instance);

// --- drops that land (land.c) ---

// Adds what move=sliding needs to land drops; flow_close frees it.
void flow_open_landing(struct flow *flow);
// Lands the drops of move=sliding: the initial ones, or those of the current frame.
bool flow_land_initial(struct flow *flow);
bool flow_land_rain(struct flow *flow);
// Lands `count` drops of move=paper on each pane: the initial ones if `frame` is -1, else those of
// a frame.
bool flow_splat_drops(struct flow *flow, int64_t frame, int count);

// --- the level of detail (detail.c) ---

// Sizes in words of all panes' maps, at the level that needs most.
struct flow_sizes {
    int64_t texels, cells, rows;
};
struct flow_sizes flow_most_sizes(const struct flow *flow);
// Set the level of the first frame, and, once there are maps, everything that depends on it.
void flow_open_detail(struct flow *flow);
void flow_use_detail(struct flow *flow);
// Changes to the level that the current camera distance asks for. Each pane keeps its water, to one
// droplet; texels' directions are reset.
bool flow_follow_camera(struct flow *flow);
bool flow_change_detail(struct flow *flow, int texels);
// Writes the current level's map of beads.
bool flow_write_beads(struct flow *flow);

// Adds the facts about water on the panes, all 0, and updates them for the current frame.
void flow_add_survey(struct flow *flow);
bool flow_survey(struct flow *flow);
// Writes the panes' orientations at the current frame.
bool flow_turn_panes(struct flow *flow);

#endif
