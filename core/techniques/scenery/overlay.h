// What a picture shows over its scene: boxes, planes and frusta as lines and translucent sheets,
// and depth maps in a corner. It explains what is drawn, as the figures of Creus' thesis do.
//
// An overlay is a list that the caller fills for a frame, in the world, and draws over it.
#ifndef RG_CORE_TECHNIQUES_SCENERY_OVERLAY_H
#define RG_CORE_TECHNIQUES_SCENERY_OVERLAY_H

#include "core/techniques/technique.h"
#include "kernels/scenery/light.h"
#include "kernels/scenery/overlay/inset_params.h"
#include "kernels/scenery/overlay/plate_params.h"

struct scenery_overlay;

// How something is drawn: a linear colour with its alpha apart, and how wide its edges are, in
// pixels, from 1 to 64.
struct scenery_ink {
    float r, g, b, a;
    float width_px;
};

// Adds the overlay's assets and stages to an instance. NULL, and one logged line, on failure. To be
// closed before the instance's assets go.
struct scenery_overlay *scenery_overlay_open(struct rg_instance *instance);
void scenery_overlay_close(struct scenery_overlay *overlay);

// Empties the list. What is added then stays until the next call of this. Where memory for it is
// missing, the next draw fails, with one logged line.
void scenery_overlay_begin(struct scenery_overlay *overlay);
void scenery_overlay_line(struct scenery_overlay *overlay, const float a[3], const float b[3],
                          const struct scenery_ink *ink);
// The edges of a box that a matrix may have changed: corner k has its high x, y or z where bit 0, 1
// or 2 of k is set.
void scenery_overlay_box(struct scenery_overlay *overlay, float corners[8][3],
                         const struct scenery_ink *ink);
// The edges of what a matrix takes to clip space. What has no inverse adds nothing.
void scenery_overlay_frustum(struct scenery_overlay *overlay, const float to_clip[16],
                             const struct scenery_ink *ink);
// A flat rectangle that a matrix may have changed, by its corners in turn: its edges, and within
// them `fill` of the ink's alpha, 0 to 1.
void scenery_overlay_sheet(struct scenery_overlay *overlay, float corners[4][3],
                           const struct scenery_ink *ink, float fill);
// A light's frustum, or its six, up to 10 m from it along the axis; of a sun, what its map holds.
// The light is in the world.
void scenery_overlay_light(struct scenery_overlay *overlay, const scenery_light *light,
                           const struct scenery_ink *ink);

// Draws sheets, then lines, over a colour target, with a matrix from the world to clip space.
// `depth`: what hides them; NULL: nothing does.
bool scenery_overlay_draw(struct scenery_overlay *overlay, const float to_clip[16],
                          struct rg_image *colour, struct rg_image *depth);
// Draws a map into the pixels that `inset` names, which lie within the target.
bool scenery_overlay_inset(struct scenery_overlay *overlay, const scenery_inset_params *inset,
                           struct rg_image *map, struct rg_image *colour);

// Draws a map in greys as a plate in the world, hidden by `depth`.
bool scenery_overlay_plate(struct scenery_overlay *overlay, const scenery_plate_params *plate,
                           struct rg_image *map, struct rg_image *colour, struct rg_image *depth);

#endif
