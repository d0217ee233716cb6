// Draws the scene's faces: each pixel gets the number of its surface, and its depth.
// city_shade.h then computes each pixel's look once, after all faces are drawn. Drawn without a
// colour target, the faces make depth maps.
#include "kernels/scenery/city_params.h"
#include "kernels/dialect/draw/triangle.h"

#define RG_PARAMS  scenery_city_params
#define RG_SLOTS   IN(1, float, faces) IN(2, uint, surface_of) IN(3, uint, blocks)
#define RG_CORNERS 4

// The part of rg_planes that depth needs.
RG_STRUCT(scenery_city_record)
{
    float origin_x;
    float origin_y;
    rg_plane depth;
    float nearest;
    float farthest;
    uint surface;
};
#define RG_RECORD scenery_city_record
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

RG_FN rg_corner scenery_city_corner(rg_ctx rg, m4 to_clip, int first_word)
{
    return m4_project(to_clip, v3_make(faces_at(rg, first_word), faces_at(rg, first_word + 1),
                                       faces_at(rg, first_word + 2)));
}

RG_FN int scenery_city_face(rg_ctx rg, int i)
{
    return rg_to_int(blocks_at(rg, i / SCENERY_BLOCK_FACES * 2)) + i % SCENERY_BLOCK_FACES;
}

RG_FN rg_item scenery_city_item(rg_ctx rg, m4 to_clip, int face)
{
    int word = face * SCENERY_FACE_WORDS;
    rg_item t;
    t.alive = 1;
    t.a = scenery_city_corner(rg, to_clip, word);
    t.b = scenery_city_corner(rg, to_clip, word + 3);
    t.c = scenery_city_corner(rg, to_clip, word + 6);
    t.d = scenery_city_corner(rg, to_clip, word + 9);
    return t;
}

RG_DRAW_ITEM(streaks_city)
{
    int count = rg_to_int(blocks_at(rg, i / SCENERY_BLOCK_FACES * 2 + 1));
    int k = i % SCENERY_BLOCK_FACES;
    rg_item t = scenery_city_item(rg, p.to_clip,
                                  rg_to_int(blocks_at(rg, i / SCENERY_BLOCK_FACES * 2)) +
                                      rg_imin(k, count - 1));
    t.alive = k < count ? 1 : 0;
    return t;
}

RG_DRAW_RECORD(streaks_city)
{
    int face = scenery_city_face(rg, i);
    rg_item t = scenery_city_item(rg, p.to_clip, face);
    rg_planes s = rg_planes_of(draw, t);
    scenery_city_record r;
    r.origin_x = s.origin_x;
    r.origin_y = s.origin_y;
    r.depth = s.depth;
    // Planes are made of three corners; the fourth may lie nearer or farther. A face that the near
    // plane cuts has no bounds.
    float fourth = t.d.w > RG_LEAST_W ? t.d.z / rg_max(t.d.w, RG_LEAST_W) : s.nearest;
    r.nearest = t.d.w > RG_LEAST_W ? rg_min(s.nearest, fourth) : 0.0f;
    r.farthest = t.d.w > RG_LEAST_W ? rg_max(s.farthest, fourth) : 1.0f;
    r.surface = surface_of_at(rg, face);
    return r;
}

RG_FN float scenery_city_byte(uint word)
{
    return rg_to_float(word & 255u) / 255.0f;
}

RG_DRAW_FRAGMENT(streaks_city)
{
    float dx = rg_to_float(px) + 0.5f - r.origin_x;
    float dy = rg_to_float(py) + 0.5f - r.origin_y;
    float depth = rg_clamp(rg_plane_at(r.depth, dx, dy), r.nearest, r.farthest);
    rgba number = rg_rgba(scenery_city_byte(r.surface), scenery_city_byte(r.surface >> 8),
                          scenery_city_byte(r.surface >> 16), scenery_city_byte(r.surface >> 24));
    return rg_fragment_make(number, depth);
}
