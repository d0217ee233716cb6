// Finds the chunks of a scene that a view can see.
#ifndef RG_CORE_TECHNIQUES_SCENERY_CULL_H
#define RG_CORE_TECHNIQUES_SCENERY_CULL_H

#include "core/scene/city/city.h"
#include "kernels/dialect/matrix.h"

enum { SCENERY_CULL_ACROSS = 192, SCENERY_CULL_DOWN = 108 };

// The view in cells, each with a depth beyond which boxes hide everything.
struct scenery_cull {
    const struct city_faces *faces;
    int box_count;
    const struct city_box *boxes; // solid boxes inside the geometry
    float hidden[SCENERY_CULL_DOWN][SCENERY_CULL_ACROSS];
};

// Sets `seen`, by chunk, for a matrix from the world to clip space: false for chunks that are
// outside the view, hidden by boxes, or, with `backs_culled`, turned away. Leaving these out
// changes no pixel, unless the eye is inside a box.
void scenery_cull(struct scenery_cull *cull, m4 to_clip, bool backs_culled, bool *seen);

#endif
