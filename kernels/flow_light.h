// flow: one mirror pane that fills the view, lit by the Fresnel model (section 4.3; Fernando &
// Kilgard, The Cg Tutorial, p. 189): the water reflects the environment at its own normal, and
// shows the mirror's reflection behind it, bent by the normal (GPU Gems 2, chapter 19).
#include "cube.h"
#include "flow.h"
#include "flow_light_params.h"
#include "math.h"
#include "normal_map.h"

#define RG_PARAMS flow_light_params
#define RG_SLOTS  IN(1, uint, normals) IMAGE(2, RG11B10F, environment) OUT_IMAGE(3, RGBA16F, target)
#include "slots.h"

RG_FN wet_normal normal_at(rg_ctx rg, int i)
{
    return wet_normal_unpack(normals_at(rg, i));
}

// The normal map at a point of the pane, in texels, bilinear.
RG_FN wet_normal normal_between(rg_ctx rg, flow_light_params p, float s, float t)
{
    int x = rg_to_int(s + 1.0f) - 1;
    int y = rg_to_int(t + 1.0f) - 1;
    float fx = s - rg_to_float(x);
    int i = flow_index(p.size, x, y);
    int below = flow_index(p.size, x, y + 1);
    wet_normal top = wet_normal_lerp(normal_at(rg, i), normal_at(rg, i + 1), fx);
    wet_normal bottom = wet_normal_lerp(normal_at(rg, below), normal_at(rg, below + 1), fx);
    return wet_normal_lerp(top, bottom, t - rg_to_float(y));
}

// The environment's light from a direction in the pane's tangent space, of any length, in one of
// its levels, which is `size` texels along a face. The nearest texel will do: the host resamples
// the environment so that the mirror shows about a texel a pixel, and drops a small picture of it.
RG_FN v3 light_from(rg_ctx rg, flow_light_params p, v3 d, int level, int size)
{
    v3 world = v3_make(d.x * p.tx + d.y * p.bx + d.z * p.nx, d.x * p.ty + d.y * p.by + d.z * p.ny,
                       d.x * p.tz + d.y * p.bz + d.z * p.nz);
    cube_point c = cube_locate(world, size);
    rgba light = environment_texel(rg, cube_texel(c.x, size), cube_texel(c.y, size), c.face, level);
    return v3_make(light.r, light.g, light.b);
}

RG_GRID_KERNEL(flow_light)
{
    float px = rg_to_float(x) + 0.5f;
    float py = rg_to_float(y) + 0.5f;
    wet_normal w = normal_between(rg, p, px * p.texels_x - 0.5f, py * p.texels_y - 0.5f);
    float nx = wet_normal_component(w.x);
    float ny = wet_normal_component(w.y);
    float wetness = wet_normal_wetness(w);
    v3 n = v3_make(nx, ny, rg_sqrt(rg_max(1.0f - (nx * nx + ny * ny), 0.0f)));
    v3 view = v3_make(px * p.view_x - p.view_left, py * p.view_y - p.view_top, -1.0f);
    float towards = v3_dot(view, n);
    float grazing = rg_clamp(1.0f + towards / rg_sqrt(v3_dot(view, view)), 0.0f, 1.0f);
    float fresnel = p.fresnel_bias + p.fresnel_scale * rg_pow_whole(grazing, p.fresnel_power);
    float reflectance = wetness * rg_min(fresnel, 1.0f);
    v3 mirrored = v3_add(view, v3_scale(n, -2.0f * towards));
    v3 bent =
        v3_make(view.x - nx * p.refraction_strength, view.y - ny * p.refraction_strength, 1.0f);
    v3 light = v3_add(
        v3_scale(light_from(rg, p, mirrored, p.reflection_level, p.reflection_size), reflectance),
        v3_scale(light_from(rg, p, bent, 0, p.environment_size),
                 (1.0f - reflectance) * p.reflectivity));
    target_store(rg, x, y, 0, rg_rgba(light.x, light.y, light.z, 1.0f));
}
