// Whether a drop has hit, where on its way in this step, and what.
//
// `faithful` follows the paper: a drop has hit when fewer samples of its sphere are seen than a
// threshold. `any`, an older occlusion query, asks that none is seen. Both also hold for a drop
// that is merely hidden. `correct` asks that the drop's middle passes through a face that is seen,
// from its front to behind it, and not past its rim.
#include "kernels/cartoon/rain/params.h"
#include "kernels/dialect/math.h"

#define RG_PARAMS cartoon_rain_params
#define RG_SLOTS                                                                                   \
    IN(1, uint, living)                                                                            \
    INOUT(2, cartoon_raindrop, raindrops)                                                          \
    IMAGE(3, D32F, depth_map)                                                                      \
    IMAGE(4, RGBA16F, normal_map)                                                                  \
    IN(5, uint, answers)                                                                           \
    OUT(6, uint, hits)                                                                             \
    OUT(7, cartoon_surface, surfaces)                                                              \
    ATOMIC(8, uint, tally) IMAGE(9, RGBA8, face_map) IN(10, float, positions) IN(11, uint, indices)
#include "kernels/dialect/slots/slots.h"

#include "kernels/cartoon/rain/hit/samples.h"
#include "kernels/cartoon/rain/hit/surface.h"

#define CARTOON_HALVINGS 24 // at most

RG_FN int cartoon_least(cartoon_rain_params p)
{
    return p.collide == CARTOON_COLLIDE_ANY ? 1 : p.least_samples;
}

// The test at a place of the drop's way.
RG_FN bool cartoon_collides(rg_ctx rg, cartoon_rain_params p, v3 at)
{
    cartoon_spot s = cartoon_spot_of(p, at);
    if (s.inside == 0)
        return false;
    if (p.collide == CARTOON_COLLIDE_CORRECT)
        return cartoon_is_behind(rg, p, s, at);
    return cartoon_samples(rg, p, s) < cartoon_least(p);
}

// Whether the drop may have hit where it is now. `faithful` and `any` take the answers of the
// queries: by nth living drop, or by slot if they are a frame late. A drop just released has no
// late answer.
RG_FN bool cartoon_may_hit(rg_ctx rg, cartoon_rain_params p, int nth, int slot, int age, v3 old,
                           v3 now)
{
    bool is_late = p.late != 0;
    if (cartoon_spot_of(p, now).inside == 0 || (is_late && age == 0))
        return false;
    if (p.collide != CARTOON_COLLIDE_CORRECT)
        return answers_at(rg, is_late ? slot : nth) < rg_to_uint(cartoon_least(p));
    return cartoon_collides(rg, p, now) && cartoon_spot_of(p, old).inside != 0 &&
           !cartoon_collides(rg, p, old);
}

RG_FN v3 cartoon_middle(v3 a, v3 b)
{
    return v3_scale(v3_add(a, b), 0.5f);
}

RG_STRUCT(cartoon_hit)
{
    v3 at;
    float share; // of the way, there
    float step;  // at share - step the drop had not hit yet
};

// Bisects the way from the drop's old place to its new one, until the ends are precision_m apart.
// The paper's step (c) forgets where it began; this takes the half in which the test changes.
RG_FN cartoon_hit cartoon_hit_between(rg_ctx rg, cartoon_rain_params p, v3 old, v3 now)
{
    v3 before_it = old;
    v3 way = cartoon_less(now, old);
    float apart_m = rg_sqrt(v3_dot(way, way));
    cartoon_hit hit;
    hit.at = now;
    hit.share = 1.0f;
    hit.step = 1.0f;
    for (int i = 0; i < CARTOON_HALVINGS; i++) {
        if (apart_m <= p.precision_m)
            break;
        v3 middle = cartoon_middle(before_it, hit.at);
        hit.step = hit.step * 0.5f;
        if (cartoon_collides(rg, p, middle)) {
            hit.at = middle;
            hit.share = hit.share - hit.step;
        } else {
            before_it = middle;
        }
        apart_m = apart_m * 0.5f;
    }
    return hit;
}

// A drop that passes behind the rim of something nearer has not hit it: its way meets no face
// there.
#define CARTOON_ROUNDED_M 2e-5f // rounding of places and of the points in which rays meet faces

RG_FN bool cartoon_has_met(rg_ctx rg, cartoon_rain_params p, cartoon_hit hit, v3 old, v3 now)
{
    if (p.collide != CARTOON_COLLIDE_CORRECT)
        return true;
    v3 way = cartoon_less(now, old);
    float slack = CARTOON_ROUNDED_M / rg_max(rg_sqrt(v3_dot(way, way)), 1e-6f);
    return cartoon_is_met(rg, p, cartoon_spot_of(p, hit.at), old, way, hit.share - hit.step - slack,
                          hit.share + slack);
}

// The normal from the normal map (section 4), and its angle with the direction the drop came from.
RG_FN cartoon_surface cartoon_surface_at(rg_ctx rg, cartoon_rain_params p, v3 at, v3 velocity)
{
    cartoon_spot s = cartoon_spot_of(p, at);
    int px = rg_iclamp(rg_to_int(rg_floor(s.x_px)), 0, p.width - 1);
    int py = rg_iclamp(rg_to_int(rg_floor(s.y_px)), 0, p.height - 1);
    rgba texel = normal_map_texel(rg, px, py, 0, 0);
    bool is_sky = texel.a == 0.0f;
    cartoon_surface f;
    f.nx = is_sky ? 0.0f : texel.r;
    f.ny = is_sky ? 1.0f : texel.g;
    f.nz = is_sky ? 0.0f : texel.b;
    v3 n = v3_make(f.nx, f.ny, f.nz);
    float lengths = rg_sqrt(rg_max(v3_dot(velocity, velocity) * v3_dot(n, n), 1e-12f));
    f.angle = rg_acos(rg_clamp(-v3_dot(velocity, n) / lengths, -1.0f, 1.0f));
    return f;
}

RG_GRID_KERNEL(cartoon_collide)
{
    hits_put(rg, x, 0u);
    int slot = rg_to_int(living_at(rg, x));
    cartoon_raindrop d = raindrops_at(rg, slot);
    v3 now = v3_make(d.x, d.y, d.z);
    v3 old = v3_make(d.from_x, d.from_y, d.from_z);
    if (d.state != CARTOON_DROP || !cartoon_may_hit(rg, p, x, slot, d.age, old, now))
        return;
    cartoon_hit hit = cartoon_hit_between(rg, p, old, now);
    if (!cartoon_has_met(rg, p, hit, old, now))
        return;
    d.x = hit.at.x;
    d.y = hit.at.y;
    d.z = hit.at.z;
    d.state = CARTOON_COLLISION;
    raindrops_put(rg, slot, d);
    surfaces_put(rg, x, cartoon_surface_at(rg, p, hit.at, v3_make(d.vx, d.vy, d.vz)));
    hits_put(rg, x, 1u);
    tally_add(rg, CARTOON_HITS, 1u);
}
