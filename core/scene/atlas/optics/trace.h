// Rays through a drop: the directions from which the viewer's light came.
#ifndef RG_CORE_SCENE_ATLAS_OPTICS_TRACE_H
#define RG_CORE_SCENE_ATLAS_OPTICS_TRACE_H

#include "core/scene/atlas/optics/drop.h"

// The paths of light: reflected outside; refracted in and out; the same with one to three
// reflections inside.
enum { RG_DROP_WAYS = 5, RG_TRACE_MAX = 512 };

// An orthographic camera. `towards` points from the drop to the viewer; all are unit vectors.
struct rg_drop_view {
    float towards[3], right[3], up[3];
};

// A row of rays as the viewer sees it: for each path the direction of the light's source (a unit
// vector) and its share of that source's radiance, 0 where the ray misses the drop. The shares sum
// to less than 1, because light still inside after three reflections is dropped: 0.1 % for a sphere
// and for drops that swing as measured, 2.3 % over an exposure for a drop of the database that is
// bent towards or away from the viewer.
struct rg_drop_row {
    float hit[RG_TRACE_MAX]; // 1 where the ray meets the drop, else 0
    float x[RG_DROP_WAYS][RG_TRACE_MAX], y[RG_DROP_WAYS][RG_TRACE_MAX],
        z[RG_DROP_WAYS][RG_TRACE_MAX], share[RG_DROP_WAYS][RG_TRACE_MAX];
};

// A viewer at an elevation, at azimuth 0 (+z).
struct rg_drop_view rg_drop_view(double elevation_deg);

// Traces `count` rays, up to RG_TRACE_MAX, at heights v and first_u + i * step_u to the right of
// the drop's centre, in radii.
void rg_drop_trace(const struct rg_drop_shape *shape, const struct rg_drop_view *view, float v,
                   float first_u, float step_u, int count, struct rg_drop_row *row);

#endif
