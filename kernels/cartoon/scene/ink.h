// Outlines: edges of the mesh that are contours, creases or boundaries, as lines of a width in
// pixels (McGuire and Hughes, 2004). A pixel keeps 1 - ink as its depth, so that the darkest of
// crossing lines stays, in whatever order they are drawn.
//
// A pixel of a line is drawn if the nearest point of the line's axis is seen. It is if the depth
// map has nothing nearer in that point's pixel, or in one beside it. So a line keeps its whole
// width beside surfaces that it bounds, and ends where it goes behind another.
#include "kernels/cartoon/scene/ink_params.h"
#include "kernels/dialect/draw/line.h"

#define RG_PARAMS  cartoon_ink_params
#define RG_SLOTS   IN(1, float, edges) IMAGE(2, D32F, depth_map)
#define RG_CORNERS 4

// Lines are cut to this width.
#define CARTOON_WIDEST_PX 32.0f
// A line may lie behind the depth map by at least, and at most, this share of its distance.
#define CARTOON_LEAST_SLACK 0.0005f
#define CARTOON_MOST_SLACK  0.005f

RG_STRUCT(cartoon_line)
{
    rg_line line;
    float reach; // from the axis to where the smooth side ends
    float slack; // depth by which it may lie behind the depth map
};
#define RG_RECORD cartoon_line
#include "kernels/dialect/draw/draw.h"

RG_FN v3 cartoon_edge_v3(rg_ctx rg, cartoon_ink_params p, int i, int word)
{
    return v3_make(edges_at(rg, word * p.count + i), edges_at(rg, (word + 1) * p.count + i),
                   edges_at(rg, (word + 2) * p.count + i));
}

// The width of an edge's line: 0 if it is neither contour, crease nor boundary.
RG_FN float cartoon_width_px(rg_ctx rg, cartoon_ink_params p, int i)
{
    v3 a = cartoon_edge_v3(rg, p, i, 0);
    v3 n = cartoon_edge_v3(rg, p, i, 6);
    v3 m = cartoon_edge_v3(rg, p, i, 9);
    v3 to_eye = v3_make(p.eye_x - a.x, p.eye_y - a.y, p.eye_z - a.z);
    float contour = v3_dot(n, to_eye) * v3_dot(m, to_eye);
    float bend = v3_dot(n, m);
    float boundary = v3_dot(m, m);
    float crease_px = bend < p.cos_crease ? p.crease_px : 0.0f;
    return contour < 0.0f ? p.contour_px : boundary < 0.5f ? p.contour_px : crease_px;
}

RG_FN cartoon_line cartoon_line_of(rg_ctx rg, rg_draw_state draw, cartoon_ink_params p, int i)
{
    rg_corner a = m4_project(p.to_clip, cartoon_edge_v3(rg, p, i, 0));
    rg_corner b = m4_project(p.to_clip, cartoon_edge_v3(rg, p, i, 3));
    float far = rg_max(rg_max(a.w, b.w), p.full_m);
    float width_px = rg_min(cartoon_width_px(rg, p, i), CARTOON_WIDEST_PX) * (p.full_m / far);
    cartoon_line s;
    s.line = rg_line_seen(draw, a, b, CARTOON_WIDEST_PX);
    s.line.to = width_px > 0.0f ? s.line.to : -1.0f;
    s.reach = 0.5f * width_px + 0.5f;
    s.slack = 0.0f;
    return s;
}

RG_DRAW_ITEM(cartoon_ink)
{
    cartoon_line s = cartoon_line_of(rg, draw, p, i);
    return rg_line_item(draw, s.line, s.reach);
}

// The change of a face's depth over three quarters of a pixel, from its normal and its place
// relative to the eye: on a plane 1 / w = (n . ray) / (n . place).
RG_FN float cartoon_slope(cartoon_ink_params p, v3 n, v3 place)
{
    float right = rg_abs(n.x * p.right_x + n.y * p.right_y + n.z * p.right_z);
    float down = rg_abs(n.x * p.down_x + n.y * p.down_y + n.z * p.down_z);
    return 0.75f * p.depth_fall * (right + down) / rg_max(rg_abs(v3_dot(n, place)), 1e-9f);
}

RG_DRAW_RECORD(cartoon_ink)
{
    cartoon_line s = cartoon_line_of(rg, draw, p, i);
    v3 a = cartoon_edge_v3(rg, p, i, 0);
    v3 place = v3_make(a.x - p.eye_x, a.y - p.eye_y, a.z - p.eye_z);
    rg_corner c = m4_project(p.to_clip, a);
    rg_corner d = m4_project(p.to_clip, cartoon_edge_v3(rg, p, i, 3));
    float slope = rg_max(cartoon_slope(p, cartoon_edge_v3(rg, p, i, 6), place),
                         cartoon_slope(p, cartoon_edge_v3(rg, p, i, 9), place));
    float fall = p.depth_fall / rg_max(rg_max(c.w, d.w), RG_LEAST_W);
    s.slack = rg_clamp(slope, fall * CARTOON_LEAST_SLACK, fall * CARTOON_MOST_SLACK);
    return s;
}

// The farthest depth that is seen in a pixel and its four neighbours.
RG_FN float cartoon_farthest(rg_ctx rg, float x, float y)
{
    int right = depth_map_width(rg, 0) - 1;
    int bottom = depth_map_height(rg, 0) - 1;
    int px = rg_iclamp(rg_to_int(rg_floor(x)), 0, right);
    int py = rg_iclamp(rg_to_int(rg_floor(y)), 0, bottom);
    float here = depth_map_texel(rg, px, py, 0, 0).r;
    float left_of = depth_map_texel(rg, rg_imax(px - 1, 0), py, 0, 0).r;
    float right_of = depth_map_texel(rg, rg_imin(px + 1, right), py, 0, 0).r;
    float above = depth_map_texel(rg, px, rg_imax(py - 1, 0), 0, 0).r;
    float below = depth_map_texel(rg, px, rg_imin(py + 1, bottom), 0, 0).r;
    return rg_max(here, rg_max(rg_max(left_of, right_of), rg_max(above, below)));
}

RG_DRAW_FRAGMENT(cartoon_ink)
{
    rg_line s = r.line;
    float x = rg_to_float(px) + 0.5f - s.x;
    float y = rg_to_float(py) + 0.5f - s.y;
    float along = rg_clamp(x * s.along_x + y * s.along_y, 0.0f, s.length_px);
    float dx = x - along * s.along_x;
    float dy = y - along * s.along_y;
    float ink = rg_clamp(r.reach - rg_sqrt(dx * dx + dy * dy), 0.0f, 1.0f);
    float depth = s.depth + (s.depth_there - s.depth) * along / rg_max(s.length_px, 1e-6f);
    float farthest = cartoon_farthest(rg, s.x + along * s.along_x, s.y + along * s.along_y);
    rg_fragment f = rg_fragment_make(rg_rgba(0.0f, 0.0f, 0.0f, 0.0f), 1.0f - ink);
    f.kept = ink > 0.0f ? (depth <= farthest + r.slack ? 1 : 0) : 0;
    return f;
}
