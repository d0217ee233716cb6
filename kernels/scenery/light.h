// A light, and the share of it that reaches a point. Both are the same in the world and in the rain
// frame, which are rotated and moved against each other, but not scaled.
#ifndef RG_KERNELS_SCENERY_LIGHT_H
#define RG_KERNELS_SCENERY_LIGHT_H

#include "kernels/dialect/matrix.h"

// Kinds. A sun is so far away that its light comes from one direction, equally strong everywhere.
#define SCENERY_POINT 1
#define SCENERY_SPOT  2
#define SCENERY_SUN   3

// The most lights of a scene.
#define SCENERY_MAX_LIGHTS 16

// A light gets no stronger nearer than 0.1 m.
#define SCENERY_NEAREST_SQUARED_M2 0.01f

// A light's colour is the radiance of a white matt surface that faces it. Times pi, it is the
// light's irradiance there.
#define SCENERY_IRRADIANCE 3.14159274f

RG_STRUCT(scenery_light)
{
    int kind;
    float x, y, z;    // metres; of points and spots
    float dx, dy, dz; // the way light travels, of unit length; of spots and suns
    // Radiance, linear (SCENERY_IRRADIANCE), at 1 m from points and spots, and anywhere for suns.
    float r, g, b;
    // Cosines of the angles from a spot's axis: up to the first it is as bright as on the axis,
    // from the second on it is dark. The first cosine is larger, in lights of all kinds.
    float cos_inner, cos_outer;
    int shadow_layer;    // of the image of shadow maps; -1: casts none
    int shadow_faces;    // 1, or 6 for a point: the layers from shadow_layer on
    float shadow_bias_m; // surfaces nearer to a point do not shade it
    float shadow_texel;  // a texel's width in metres; of points and spots, at 1 m along the axis
    // With one face, the matrix from this frame to the shadow map's clip space. With six, its first
    // three rows lead to the frame of the cube map, which is left-handed, with the light at its
    // origin. Depth at w metres along a face's axis is wx + wy / w.
    m4 to_shadow;
};
RG_STRUCT_SIZE(scenery_light, 32)

RG_STRUCT(scenery_reach)
{
    v3 to_light; // of unit length
    float share; // of the light's colour: falls off with the squared distance, 0 outside a cone
};
RG_STRUCT_SIZE(scenery_reach, 4)

// The brightness of a spot at an angle from its axis with this cosine, 0 to 1, smooth at both
// edges.
RG_FN float scenery_cone(scenery_light l, float cosine)
{
    float t = rg_clamp((cosine - l.cos_outer) / (l.cos_inner - l.cos_outer), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

// The code has no branches, so that compilers vectorise over points.
RG_FN scenery_reach scenery_light_reach(scenery_light l, v3 at)
{
    v3 axis = v3_make(l.dx, l.dy, l.dz);
    v3 away = v3_make(l.x - at.x, l.y - at.y, l.z - at.z);
    float squared = v3_dot(away, away);
    v3 towards = v3_scale(away, 1.0f / rg_sqrt(rg_max(squared, 1e-12f)));
    float fallen = 1.0f / rg_max(squared, SCENERY_NEAREST_SQUARED_M2);
    float cone = scenery_cone(l, -v3_dot(towards, axis));
    int sun = l.kind == SCENERY_SUN ? 1 : 0;
    scenery_reach reach;
    reach.to_light.x = sun != 0 ? -axis.x : towards.x;
    reach.to_light.y = sun != 0 ? -axis.y : towards.y;
    reach.to_light.z = sun != 0 ? -axis.z : towards.z;
    reach.share = sun != 0 ? 1.0f : fallen * (l.kind == SCENERY_SPOT ? cone : 1.0f);
    return reach;
}

#endif
