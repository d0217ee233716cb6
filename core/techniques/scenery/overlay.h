// What a picture of streaks shows beside the rain, as the thesis's figures do: boxes, planes and
// frusta as lines and translucent sheets, and depth maps in a corner.
//
// An overlay is a list that the caller fills for a frame, in the world, and draws over it.
#ifndef RG_CORE_TECHNIQUES_SCENERY_OVERLAY_H
#define RG_CORE_TECHNIQUES_SCENERY_OVERLAY_H

#include "core/techniques/technique.h"
#include "kernels/scenery/light.h"
#include "kernels/scenery/overlay/inset_params.h"

struct streaks_overlay;

// How something is drawn: a linear colour with its alpha apart, and how wide its edges are, in
// pixels, from 1 to 64.
struct streaks_ink {
    float r, g, b, a;
    float width_px;
};

// The inks of the thesis's figures 4.4, 4.11, 4.14 and 5.7.
extern const struct streaks_ink streaks_ink_rain_space;   // grey
extern const struct streaks_ink streaks_ink_local_planes; // green
extern const struct streaks_ink streaks_ink_radius;       // red
extern const struct streaks_ink streaks_ink_volume;       // blue: where the two meet
extern const struct streaks_ink streaks_ink_packets;      // purple
extern const struct streaks_ink streaks_ink_light;        // white

// NULL, and one logged line, on failure.
struct streaks_overlay *streaks_overlay_open(struct rg_device *device);
void streaks_overlay_close(struct streaks_overlay *overlay);

// Begins anew. What is added then is kept until the next call. Without memory for it the next
// draw fails, with one logged line.
void streaks_overlay_begin(struct streaks_overlay *overlay);
void streaks_overlay_line(struct streaks_overlay *overlay, const float a[3], const float b[3],
                          const struct streaks_ink *ink);
// The edges of what a box has become: corner k has its high x, y or z where bit 0, 1 or 2 of k is
// set.
void streaks_overlay_box(struct streaks_overlay *overlay, float corners[8][3],
                         const struct streaks_ink *ink);
// The edges of what a matrix takes to clip space. What has no inverse adds nothing.
void streaks_overlay_frustum(struct streaks_overlay *overlay, const float to_clip[16],
                             const struct streaks_ink *ink);
// A flat rectangle, or what of it a frame makes: its corners in turn. Edges, and within them
// `fill` of the ink's alpha, 0 to 1.
void streaks_overlay_sheet(struct streaks_overlay *overlay, float corners[4][3],
                           const struct streaks_ink *ink, float fill);
// A light's frustum, or its six, up to 10 m from it along the axis; of a sun, what its map holds.
// The light is in the world.
void streaks_overlay_light(struct streaks_overlay *overlay, const streaks_light *light,
                           const struct streaks_ink *ink);

// Draws sheets, then lines, over a colour target, with a matrix from the world to clip space.
// `depth`: what hides them; NULL: nothing does.
bool streaks_overlay_draw(struct streaks_overlay *overlay, struct rg_instance *instance,
                          const float to_clip[16], struct rg_image *colour, struct rg_image *depth);
// Draws a map into the pixels that `inset` names, which lie within the target.
bool streaks_overlay_inset(struct streaks_overlay *overlay, struct rg_instance *instance,
                           const streaks_inset_params *inset, struct rg_image *map,
                           struct rg_image *colour);

#endif
