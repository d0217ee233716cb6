// flow: a model inside the box, matt with a sheen, lit by the environment and by a lamp. In the
// lamp's light the drops on the panes cast shadows (Tatarchuk 2006, which the paper points to).
#include "kernels/flow/panes/panes.h"
#include "kernels/dialect/math.h"
#include "kernels/dialect/mesh/mesh.h"

#define RG_PARAMS flow_view_params
#define RG_SLOTS                                                                                   \
    IN(1, float, positions)                                                                        \
    IN(2, uint, normals)                                                                           \
    IN(3, uint, indices)                                                                           \
    SAMPLED(4, RG11B10F, environment, CUBE) IN(5, float, blurred)
#define RG_CORNERS 3
#define RG_RECORD  mesh_record
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

#include "kernels/dialect/image/cube_light.h"
#include "kernels/dialect/mesh/item.h"

RG_DRAW_ITEM(flow_model)
{
    return mesh_item(rg, p.to_clip, i);
}

RG_DRAW_RECORD(flow_model)
{
    return mesh_record_of(rg, draw, p.to_clip, i);
}

// The distance from `at` to the box's side along `d`; both are components along one axis.
RG_FN float to_side(float at, float d)
{
    float side = d < 0.0f ? -1.0f : 1.0f;
    float away = rg_abs(d) > 1e-6f ? d : side * 1e-6f;
    return (side - at) / away;
}

// The height of the water where the way to the lamp leaves the box. Panes 0 to 5 are front, back,
// right, left, top and bottom. Pane 0's frame is the box's own; the others' places follow from it.
// The code selects between numbers instead of branching, so that compilers vectorise over pixels.
RG_FN float water_before_lamp(rg_ctx rg, flow_view_params p, v3 at)
{
    v3 right = v3_make(p.turn.xx, p.turn.yx, p.turn.zx);
    v3 down = v3_make(-p.turn.xy, -p.turn.yy, -p.turn.zy);
    v3 out_of = v3_make(p.turn.xz, p.turn.yz, p.turn.zz);
    v3 lamp = v3_make(p.light_x, p.light_y, p.light_z);
    float dx = v3_dot(lamp, right);
    float dy = v3_dot(lamp, down);
    float dz = v3_dot(lamp, out_of);
    float by_x = to_side(v3_dot(at, right), dx);
    float by_y = to_side(v3_dot(at, down), dy);
    float by_z = to_side(v3_dot(at, out_of), dz);
    float way = rg_min(by_x, rg_min(by_y, by_z));
    float x = v3_dot(at, right) + dx * way;
    float y = v3_dot(at, down) + dy * way;
    float z = v3_dot(at, out_of) + dz * way;
    float turned_x = dz < 0.0f ? -x : x;
    float side_z = dx < 0.0f ? z : -z;
    float level_z = dy < 0.0f ? z : -z;
    float u = by_z == way ? turned_x : by_x == way ? side_z : x;
    float v = by_z == way ? y : by_x == way ? y : level_z;
    int facing_z = dz < 0.0f ? 1 : 0;
    int facing_x = dx < 0.0f ? 3 : 2;
    int facing_y = dy < 0.0f ? 4 : 5;
    int pane = by_z == way ? facing_z : by_x == way ? facing_x : facing_y;
    float n = rg_to_float(p.size);
    int tx = rg_iclamp(rg_to_int((0.5f * u + 0.5f) * n), 0, p.size - 1);
    int ty = rg_iclamp(rg_to_int((0.5f * v + 0.5f) * n), 0, p.size - 1);
    return blurred_at(rg, flow_pane_index(p.size, pane, tx, ty));
}

RG_DRAW_FRAGMENT(flow_model)
{
    v3 turned = m4_turn(p.turn, mesh_normal_at(r, px, py));
    v3 n = v3_scale(turned, 1.0f / rg_sqrt(rg_max(v3_dot(turned, turned), 1e-12f)));
    v3 ray = m4_turn(p.rays, v3_make(rg_to_float(px), rg_to_float(py), 1.0f));
    float towards = rg_min(v3_dot(ray, n), 0.0f);
    v3 around = light_from(rg, n, p.ambient_level, p.ambient_size);
    v3 sheen = light_from(rg, v3_add(ray, v3_scale(n, -2.0f * towards)), p.reflection_level,
                          p.reflection_size);
    float lamp = p.light * rg_max(v3_dot(n, v3_make(p.light_x, p.light_y, p.light_z)), 0.0f);
    v3 at = v3_add(v3_make(p.rays.xw, p.rays.yw, p.rays.zw),
                   v3_scale(ray, rg_planes_w(r.planes, px, py)));
    float water = water_before_lamp(rg, p, at);
    lamp = lamp * (1.0f - p.drop_shadow * rg_min(water * p.wet_per_height, 1.0f));
    float reflectance = 0.5f * flow_fresnel(p, ray, towards);
    float matt = 1.0f - reflectance;
    rgba c = rg_rgba((around.x + lamp) * p.model_grey * matt + sheen.x * reflectance,
                     (around.y + lamp) * p.model_grey * matt + sheen.y * reflectance,
                     (around.z + lamp) * p.model_grey * matt + sheen.z * reflectance, 1.0f);
    return rg_fragment_make(c, rg_planes_depth(r.planes, px, py));
}
