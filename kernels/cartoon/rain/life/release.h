// Releases drops: each moves a slot from the free list to the living one. They start anywhere in
// their space, downwards within a cone.
#include "kernels/cartoon/rain/params.h"
#include "kernels/dialect/math.h"
#include "kernels/dialect/rng.h"

#define RG_PARAMS cartoon_rain_params
#define RG_SLOTS                                                                                   \
    IN(1, uint, unused)                                                                            \
    OUT(2, uint, living) OUT(3, cartoon_raindrop, raindrops) ATOMIC(4, uint, tally)
#include "kernels/dialect/slots/slots.h"

#include "kernels/cartoon/rain/life/lists.h"

// A direction within the cone, uniform over its solid angle.
RG_FN v3 cartoon_down(cartoon_rain_params p, rg_uint4 chance)
{
    float turn = rg_uniform(chance.x) * RG_PI * 2.0f;
    float down = 1.0f - rg_uniform(chance.y) * (1.0f - p.spread_cos);
    float across = rg_sqrt(rg_max(1.0f - down * down, 0.0f));
    return v3_make(across * rg_cos(turn), -down, across * rg_sin(turn));
}

RG_FN cartoon_raindrop cartoon_released(cartoon_rain_params p, uint number)
{
    rg_uint4 start = rg_random(p.seed, number, 0u, CARTOON_START);
    float small = rg_uniform(start.w);
    v3 down = cartoon_down(p, rg_random(p.seed, number, 0u, CARTOON_DOWN));
    cartoon_raindrop d;
    d.x = p.low_x + rg_uniform(start.x) * p.wide_x;
    d.y = p.low_y + rg_uniform(start.y) * p.wide_y;
    d.z = p.low_z + rg_uniform(start.z) * p.wide_z;
    d.size = small * small; // most are light
    float speed = p.speed_m_s * (p.slow + (1.0f - p.slow) * d.size);
    d.vx = down.x * speed;
    d.vy = down.y * speed;
    d.vz = down.z * speed;
    d.ax = 0.0f;
    d.ay = 0.0f;
    d.az = 0.0f;
    d.from_x = d.x;
    d.from_y = d.y;
    d.from_z = d.z;
    d.alpha = 1.0f;
    d.age = 0;
    d.stuck = 0;
    d.number = number;
    d.state = CARTOON_DROP;
    return d;
}

RG_GRID_KERNEL(cartoon_release)
{
    if (x >= p.free_drops) {
        tally_add(rg, CARTOON_REFUSED, 1u);
        return;
    }
    uint slot = unused_at(rg, x);
    living_put(rg, cartoon_new_drops(p) + x, slot);
    raindrops_put(rg, rg_to_int(slot), cartoon_released(p, p.released_before + rg_to_uint(x)));
    tally_add(rg, CARTOON_RELEASED, 1u);
}
