// Shared declarations of shower's files.
#ifndef RG_CORE_TECHNIQUES_SHOWER_INSTANCE_H
#define RG_CORE_TECHNIQUES_SHOWER_INSTANCE_H

#include "core/device/scan.h"
#include "core/scene/camera.h"
#include "core/techniques/scenery/scenery.h"
#include "core/techniques/shower/shower.h"
#include "core/techniques/technique.h"
#include "kernels/shower/params.h"
#include "kernels/shower/view/params.h"

enum shower_stage {
    SHOWER_RUN_MOVE,
    SHOWER_RUN_BEAR,
    SHOWER_RUN_PROMOTE,
    SHOWER_RUN_SEGMENTS,
    SHOWER_RUN_QUADS,
    SHOWER_STAGES
};

enum shower_counter {
    SHOWER_COUNT_BORN,
    SHOWER_COUNT_DIED,
    SHOWER_COUNT_PROMOTED,
    SHOWER_COUNT_CROSSED,
    SHOWER_COUNT_PLACED,
    SHOWER_COUNT_DRAWN,
    SHOWER_COUNTERS
};

struct shower {
    struct rg_instance base;
    struct shower_settings settings;
    struct rg_layer layer;         // of rain
    struct scenery *scene;         // NULL: none
    struct scenery_lights *lights; // likewise
    struct shower_heap *heap;      // NULL: particles exist on the device only
    struct rg_scan *scan;          // for the free list; NULL: there is none
    shower_params params;
    shower_view_params view;
    struct rg_camera camera; // of the current frame
    uint32_t tally[SHOWER_TALLY];
    struct rg_asset *particles, *attributes, *marks, *unused, *found, *counts;
    int first_stage; // of enum shower_stage, after the scene's stages
};

extern const struct rg_proof shower_proof;

bool shower_open(struct rg_instance *instance);
void shower_close(struct rg_instance *instance);
bool shower_step(struct rg_instance *instance);
bool shower_draw(struct rg_instance *instance);

// Computes the region of births and the visible body (eqs. 2 to 8, section III.B) for a picture's
// size, at a frame: the camera and the parameters of both. False, and one logged line, where the
// eye is below the ground or nothing is large enough to be seen.
bool shower_look(struct shower *shower, int64_t frame);

// Adds the image `heights`, the scene's depth map from above, and draws it where particles land on
// the scene. False, and one logged line, on failure.
bool shower_add_heights(struct shower *shower);

// --- the host's own particles: each is allocated when it is born and freed when it dies ---

// Makes a heap without particles; `heights` is the depth map from above. NULL, and one logged line,
// on failure.
struct shower_heap *shower_heap_open(const struct shower *shower, struct rg_image *heights);
void shower_heap_close(struct shower_heap *heap);
// Makes a step and uploads the particles. False, and one logged line, on failure.
bool shower_heap_step(struct shower *shower);

#endif
