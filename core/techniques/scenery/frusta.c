// Frusta as lines, from a matrix to clip space, shown as far as lights reach.
#include <math.h>

#include "core/scene/matrix.h"
#include "core/techniques/scenery/lights/lights.h"
#include "core/techniques/scenery/overlay.h"

#define SHOWN_M 10.0f

// The world positions of clip space's corners between two depths; false if there are none.
static bool find_corners(const float to_clip[16], float near_depth, float far_depth,
                         float corners[8][3])
{
    for (int k = 0; k < 8; k++) {
        const float corner[3] = {k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? far_depth : near_depth};
        if (!rg_matrix_undo(to_clip, corner, corners[k]))
            return false;
    }
    return true;
}

void scenery_overlay_frustum(struct scenery_overlay *overlay, const float to_clip[16],
                             const struct scenery_ink *ink)
{
    float corners[8][3];
    if (find_corners(to_clip, 0, 1, corners))
        scenery_overlay_box(overlay, corners, ink);
}

// The depth in a light's map at SHOWN_M, where its frustum ends in the picture. Depth at w metres
// is scale + offset / w; a perspective matrix has both in its third row.
static float reach_depth(const scenery_light *light, const float to_clip[16])
{
    if (light->kind == SCENERY_SUN)
        return 1;
    const float *row = to_clip + 8, *w = to_clip + 12;
    const float scale = row[0] * w[0] + row[1] * w[1] + row[2] * w[2];
    const float depth = scale + (row[3] - scale * w[3]) / SHOWN_M;
    return fminf(depth, 1);
}

void scenery_overlay_light(struct scenery_overlay *overlay, const scenery_light *light,
                           const struct scenery_ink *ink)
{
    for (int face = 0; face < light->shadow_faces; face++) {
        float to_clip[16], corners[8][3];
        scenery_light_to_clip(light, face, to_clip);
        if (find_corners(to_clip, 0, reach_depth(light, to_clip), corners))
            scenery_overlay_box(overlay, corners, ink);
    }
}
