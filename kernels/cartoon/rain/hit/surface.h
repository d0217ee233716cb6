// The surface that the camera sees, more exactly than its images: no image says at which point
// within a texel the nearest face ends. The faces do: those seen in a place's texel and its
// neighbours, from the slots face_map, positions and indices.
#ifndef RG_KERNELS_CARTOON_RAIN_HIT_SURFACE_H
#define RG_KERNELS_CARTOON_RAIN_HIT_SURFACE_H

#include "kernels/cartoon/rain/view.h"

#define CARTOON_ABOUT 9 // texels: a place's own and its neighbours

// The number of the face seen in the nth of the CARTOON_ABOUT texels; -1: none.
RG_FN int cartoon_face_about(rg_ctx rg, cartoon_rain_params p, cartoon_spot s, int nth)
{
    int x = rg_to_int(rg_floor(s.x_px)) + nth % 3 - 1;
    int y = rg_to_int(rg_floor(s.y_px)) + nth / 3 - 1;
    rgba t = face_map_texel(rg, rg_iclamp(x, 0, p.width - 1), rg_iclamp(y, 0, p.height - 1), 0, 0);
    uint low = rg_to_uint(rg_to_int(t.r * 255.0f + 0.5f)) |
               rg_to_uint(rg_to_int(t.g * 255.0f + 0.5f)) << 8;
    uint high = rg_to_uint(rg_to_int(t.b * 255.0f + 0.5f)) |
                rg_to_uint(rg_to_int(t.a * 255.0f + 0.5f)) << 8;
    return rg_to_int(low | high << 16) - 1;
}

RG_FN v3 cartoon_corner_of(rg_ctx rg, int face, int k)
{
    int v = 3 * rg_to_int(indices_at(rg, 3 * face + k));
    return v3_make(positions_at(rg, v), positions_at(rg, v + 1), positions_at(rg, v + 2));
}

RG_FN v3 cartoon_less(v3 a, v3 b)
{
    return v3_make(a.x - b.x, a.y - b.y, a.z - b.z);
}

// The share of a way after which it meets a face (Moeller and Trumbore, 1997); -1: it does not. The
// face is enlarged by the share `wider` of itself.
RG_FN float cartoon_meets(rg_ctx rg, int face, v3 from, v3 way, float wider)
{
    v3 a = cartoon_corner_of(rg, face, 0);
    v3 along = cartoon_less(cartoon_corner_of(rg, face, 1), a);
    v3 aside = cartoon_less(cartoon_corner_of(rg, face, 2), a);
    v3 across = v3_cross(way, aside);
    v3 off = cartoon_less(from, a);
    v3 turned = v3_cross(off, along);
    float volume = v3_dot(along, across);
    float inverse = 1.0f / (rg_abs(volume) < 1e-20f ? 1e-20f : volume);
    float u = v3_dot(off, across) * inverse;
    float v = v3_dot(way, turned) * inverse;
    bool is_within = u >= -wider && v >= -wider && u + v <= 1.0f + wider;
    return is_within ? v3_dot(aside, turned) * inverse : -1.0f;
}

// Whether a face lies between a place and the eye, of those in the texels about the place. Faces
// are enlarged by as much as rounding may add up to, so that no ray slips between two of them.
#define CARTOON_WIDER 1e-6f

RG_FN bool cartoon_is_behind(rg_ctx rg, cartoon_rain_params p, cartoon_spot s, v3 at)
{
    v3 eye = v3_make(p.eye_x, p.eye_y, p.eye_z);
    v3 ray = cartoon_less(at, eye);
    int last = -1;
    bool is_behind = false;
    for (int i = 0; i < CARTOON_ABOUT; i++) {
        int face = cartoon_face_about(rg, p, s, i);
        if (face == last || face < 0)
            continue;
        last = face;
        float share = cartoon_meets(rg, face, eye, ray, CARTOON_WIDER);
        is_behind = is_behind || (share > 0.0f && share < 1.0f);
    }
    return is_behind;
}

// Whether a way meets a face of the texels about a place, between two shares of the way.
RG_FN bool cartoon_is_met(rg_ctx rg, cartoon_rain_params p, cartoon_spot s, v3 from, v3 way,
                          float least, float most)
{
    int met = 0; // counted: PoCL 6 ends the process that compiles `is_met = is_met || ...`
    for (int i = 0; i < CARTOON_ABOUT; i++) {
        int face = cartoon_face_about(rg, p, s, i);
        float share = face < 0 ? -1.0f : cartoon_meets(rg, face, from, way, 0.0f);
        met += share >= 0.0f && share >= least && share <= most ? 1 : 0;
    }
    return met > 0;
}

#endif
