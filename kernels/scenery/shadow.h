// Whether a light reaches a point, by its shadow maps. A program that includes this file has the
// slot
//   SAMPLED(n, D32F, shadows, SHADOW)  all lights' maps: a layer for each, six for a point light
// and includes this after dialect/draw/draw.h or dialect/slots/slots.h. If no light casts shadows,
// any image of one texel will do.
//
// The code has no branches, because cpu runs pixels side by side with one light for all. It reads
// texels whether a light casts shadows or not, always within the image.
#ifndef RG_KERNELS_SCENERY_SHADOW_H
#define RG_KERNELS_SCENERY_SHADOW_H

#include "kernels/dialect/image/cube.h"
#include "kernels/scenery/light.h"

// The place where the ray from the light to a point meets the light's shadow map.
RG_STRUCT(scenery_shadow_place)
{
    int layer;
    float x; // texels
    float y;
    float depth; // of the point, moved towards the light by the bias
    int known;   // 0: outside of the map, or the light has none
};

// The point is first moved towards the light along the ray itself. So it stays within its texel,
// and the bias is in metres, although depth is linear in distance for suns, and in 1 / distance for
// others.
RG_FN scenery_shadow_place scenery_shadow_locate(scenery_light l, v3 at, int size)
{
    v3 near = v3_add(at, v3_scale(scenery_light_reach(l, at).to_light, l.shadow_bias_m));
    rg_corner g = m4_project(l.to_shadow, near);
    // The face of a cube map that the axis with the largest component meets, as in cube_locate.
    float ax = rg_abs(g.x);
    float ay = rg_abs(g.y);
    float major = rg_max(ax, rg_max(ay, rg_abs(g.z)));
    float across = ax == major ? cube_turn(-g.z, g.x) : ay == major ? g.x : cube_turn(g.x, g.z);
    float down = ax == major ? -g.y : ay == major ? cube_turn(g.z, g.y) : -g.y;
    int face = ax == major   ? cube_face(0, g.x)
               : ay == major ? cube_face(2, g.y)
                             : cube_face(4, g.z);
    int cube = l.shadow_faces == 6 ? 1 : 0;
    float w = cube != 0 ? major : g.w;
    float x = cube != 0 ? across : g.x;
    float y = cube != 0 ? down : g.y;
    float over_w = 1.0f / rg_max(w, 1e-6f);
    float half_size = 0.5f * rg_to_float(size);
    scenery_shadow_place place;
    place.layer = rg_imax(l.shadow_layer, 0) + (cube != 0 ? face : 0);
    place.x = (x * over_w + 1.0f) * half_size;
    place.y = (y * over_w + 1.0f) * half_size;
    place.depth = cube != 0 ? l.to_shadow.wx + l.to_shadow.wy * over_w : g.z * over_w;
    place.known = (l.shadow_layer >= 0 ? 1 : 0) & (w > 1e-6f ? 1 : 0) &
                  (rg_max(rg_abs(x), rg_abs(y)) <= w ? 1 : 0) & (place.depth > 0.0f ? 1 : 0) &
                  (place.depth < 1.0f ? 1 : 0);
    return place;
}

// The texel that a coordinate lies in, clamped to the image.
RG_FN int scenery_shadow_texel(float at, int size)
{
    return rg_to_int(rg_clamp(at, 0.0f, rg_to_float(size - 1)));
}

#if RG_NATIVE_SAMPLERS

// The driver compares, at a place in texels; between their centres it weighs four answers if its
// samplers filter depths.
RG_FN float scenery_shadow_at(rg_ctx rg, scenery_shadow_place place, float x, float y)
{
    float over = 1.0f / rg_to_float(shadows_width(rg, 0));
    vec4 at = vec4(x * over, y * over, rg_to_float(place.layer), place.depth);
    return textureGrad(shadows_compared, at, vec2(0.0f), vec2(0.0f));
}

RG_FN float scenery_shadow_tap(rg_ctx rg, scenery_shadow_place place, int x, int y)
{
    return scenery_shadow_at(rg, place, rg_to_float(x) + 0.5f, rg_to_float(y) + 0.5f);
}

#else

RG_FN float scenery_shadow_tap(rg_ctx rg, scenery_shadow_place place, int x, int y)
{
    return place.depth <= shadows_texel(rg, x, y, place.layer, 0).r ? 1.0f : 0.0f;
}

#endif

// 1 if a light reaches a point, 0 if something is before it. A light reaches every point outside
// its map, and all points if it casts no shadows.
RG_FN float scenery_unshadowed(rg_ctx rg, scenery_light l, v3 at)
{
    int size = shadows_width(rg, 0);
    scenery_shadow_place place = scenery_shadow_locate(l, at, size);
    float lit = scenery_shadow_tap(rg, place, scenery_shadow_texel(place.x, size),
                                   scenery_shadow_texel(place.y, size));
    return 1.0f - rg_to_float(place.known) * (1.0f - lit);
}

// The same interpolated between four texels, 0 to 1.
RG_FN float scenery_shadow_soft(rg_ctx rg, scenery_shadow_place place)
{
#if RG_NATIVE_SAMPLERS
    if (rg_filters_depth)
        return scenery_shadow_at(rg, place, place.x, place.y);
#endif
    int size = shadows_width(rg, 0);
    float x = rg_clamp(place.x, 0.0f, rg_to_float(size)) - 0.5f;
    float y = rg_clamp(place.y, 0.0f, rg_to_float(size)) - 0.5f;
    int left = scenery_shadow_texel(rg_floor(x), size);
    int right = scenery_shadow_texel(rg_floor(x) + 1.0f, size);
    int above = scenery_shadow_texel(rg_floor(y), size);
    int below = scenery_shadow_texel(rg_floor(y) + 1.0f, size);
    float fx = x - rg_floor(x);
    float fy = y - rg_floor(y);
    float upper = scenery_shadow_tap(rg, place, left, above) * (1.0f - fx) +
                  scenery_shadow_tap(rg, place, right, above) * fx;
    float lower = scenery_shadow_tap(rg, place, left, below) * (1.0f - fx) +
                  scenery_shadow_tap(rg, place, right, below) * fx;
    return upper * (1.0f - fy) + lower * fy;
}

// For surfaces, on which a shadow's edge is seen.
RG_FN float scenery_unshadowed_soft(rg_ctx rg, scenery_light l, v3 at)
{
    scenery_shadow_place place = scenery_shadow_locate(l, at, shadows_width(rg, 0));
    float lit = scenery_shadow_soft(rg, place);
    return place.known != 0 ? lit : 1.0f;
}

// The point to ask about for a point of a surface. It lies two texels' width off the surface, along
// the unit normal on the light's side, so that a slanting surface does not shade itself.
RG_FN v3 scenery_off_surface(scenery_light l, v3 at, v3 normal)
{
    v3 away = v3_make(l.x - at.x, l.y - at.y, l.z - at.z);
    float distance = l.kind == SCENERY_SUN ? 1.0f : rg_sqrt(v3_dot(away, away));
    return v3_add(at, v3_scale(normal, 2.0f * l.shadow_texel * distance));
}

#endif
