// An open flow: what open.c makes, and flow.c runs.
#ifndef RG_CORE_TECHNIQUES_FLOW_INSTANCE_H
#define RG_CORE_TECHNIQUES_FLOW_INSTANCE_H

#include "core/techniques/flow/flow.h"
#include "core/techniques/technique.h"

enum flow_pass {
    // movement
    FLOW_SPLAT,
    FLOW_GIVEN,
    FLOW_DRAIN,
    FLOW_MOVE,
    FLOW_REACH,
    FLOW_ARRIVE,
    // the water's surface
    FLOW_BLUR,
    FLOW_NORMALS,
    // what does not refract, and the final image
    FLOW_SKY,
    FLOW_MODEL,
    FLOW_COPY,
    FLOW_PANES,
    FLOW_SHOW_STAGE,
    // glow
    FLOW_GLOW_BRIGHT,
    FLOW_GLOW_BLUR,
    FLOW_GLOW,
    FLOW_PASS_COUNT
};

enum flow_counter { FLOW_DROPS, FLOW_TEXELS, FLOW_PIXELS, FLOW_TRIANGLES, FLOW_COUNTER_COUNT };

struct flow {
    struct rg_instance base;
    struct flow_settings settings; // resolution_px is what flow_texels made of it
    int pane_count, noise_size;
    struct rg_pass *passes[FLOW_PASS_COUNT]; // NULL: these settings do not run it
    // Maps of all panes, one behind the other.
    struct rg_buf *water, *moved; // of this frame, and scratch for the next
    struct rg_buf *given, *arriving, *blurred, *normals;
    struct rg_buf *ledger, *remainder, *noise, *panes;
    struct rg_image *environment;
    // The picture of what does not refract, with its depth; NULL without glass.
    struct rg_image *behind, *depth;
    // Without glow NULL: the image before it, and, at a quarter of the size, what is spread.
    struct rg_image *lit, *bright, *spread;
    // A model in a box of glass; no faces: none.
    struct rg_buf *positions, *model_normals, *indices;
    int model_faces;
    float model_low[3], model_high[3];
};

// Whether what does not refract is drawn apart, as a picture for glass to show.
bool flow_has_behind(const struct flow_settings *settings);

struct rg_instance *flow_open(struct rg_device *device, const void *settings, int width,
                              int height);
void flow_close(struct rg_instance *instance);
// Tells which buffers hold the state now.
void flow_show_state(struct flow *flow);
// Lands so many drops on each pane: the seeded ones (`frame` is -1), or those of a frame.
bool flow_land(struct flow *flow, int64_t frame, int count);

#endif
