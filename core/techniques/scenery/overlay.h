// Overlays that explain a picture, as the figures of Creus's thesis do: boxes, planes and frusta as
// lines and translucent sheets, and depth maps in a corner.
//
// An overlay is a list in world coordinates, which the caller fills for each frame and draws over
// it.
#ifndef RG_CORE_TECHNIQUES_SCENERY_OVERLAY_H
#define RG_CORE_TECHNIQUES_SCENERY_OVERLAY_H

#include "core/techniques/technique.h"
#include "kernels/scenery/light.h"
#include "kernels/scenery/overlay/inset_params.h"
#include "kernels/scenery/overlay/plate_params.h"

struct scenery_overlay;

// An item's linear colour, with separate alpha, and the width of its edges in pixels, from 1 to 64.
struct scenery_ink {
    float r, g, b, a;
    float width_px;
};

// Adds the overlay's assets and stages to an instance. NULL, and one logged line, on failure. Close
// it before the instance's assets are freed.
struct scenery_overlay *scenery_overlay_open(struct rg_instance *instance);
void scenery_overlay_close(struct scenery_overlay *overlay);

// Empties the list; items added later stay until the next call. When memory for an item runs out,
// the next draw fails, with one logged line.
void scenery_overlay_begin(struct scenery_overlay *overlay);
void scenery_overlay_line(struct scenery_overlay *overlay, const float a[3], const float b[3],
                          const struct scenery_ink *ink);
// Adds the edges of a box that a matrix may have changed: corner k has its high x, y or z where bit
// 0, 1 or 2 of k is set.
void scenery_overlay_box(struct scenery_overlay *overlay, float corners[8][3],
                         const struct scenery_ink *ink);
// Adds the edges of the volume that a matrix maps to clip space; nothing if it is singular.
void scenery_overlay_frustum(struct scenery_overlay *overlay, const float to_clip[16],
                             const struct scenery_ink *ink);
// Adds a flat rectangle that a matrix may have changed, by its corners in order: its edges, and its
// area with `fill`, 0 to 1, of the ink's alpha.
void scenery_overlay_sheet(struct scenery_overlay *overlay, float corners[4][3],
                           const struct scenery_ink *ink, float fill);
// Adds a light's frustum, or its six, up to 10 m along the axis; for a sun, the volume of its map.
// The light is in world coordinates.
void scenery_overlay_light(struct scenery_overlay *overlay, const scenery_light *light,
                           const struct scenery_ink *ink);

// Draws sheets, then lines, over a colour target, with a matrix from the world to clip space.
// `depth` hides parts of them; NULL: nothing does.
bool scenery_overlay_draw(struct scenery_overlay *overlay, const float to_clip[16],
                          struct rg_image *colour, struct rg_image *depth);
// Draws a map into the pixels given by `inset`, which must be within the target.
bool scenery_overlay_inset(struct scenery_overlay *overlay, const scenery_inset_params *inset,
                           struct rg_image *map, struct rg_image *colour);

// Draws a map in greys as a plate in the world, hidden by `depth` where that is nearer.
bool scenery_overlay_plate(struct scenery_overlay *overlay, const scenery_plate_params *plate,
                           struct rg_image *map, struct rg_image *colour, struct rg_image *depth);

#endif
