// A step of the drops: falling ones move; those that have hit stick and fade.
#include "kernels/cartoon/rain/params.h"

#define RG_PARAMS cartoon_rain_params
#define RG_SLOTS  IN(1, uint, living) INOUT(2, cartoon_raindrop, raindrops) ATOMIC(3, uint, tally)
#include "kernels/dialect/slots/slots.h"

// Figure 1. With constant drag, the paper's air resists by a constant vertical force, and the wind
// pushes by a horizontal one. With quadratic drag, air resists by equation 2, f = k v^2, where v is
// the speed through air that moves with the wind.
RG_FN v3 cartoon_acceleration(cartoon_rain_params p, cartoon_raindrop d)
{
    float through_x = d.vx - p.push_x;
    float through_z = d.vz - p.push_z;
    float speed = rg_sqrt(through_x * through_x + d.vy * d.vy + through_z * through_z);
    float k = p.drag_1_m * speed;
    bool is_constant = p.drag == CARTOON_DRAG_CONSTANT;
    return v3_make(is_constant ? p.push_x : -k * through_x,
                   (is_constant ? p.drag_m_s2 : -k * d.vy) - p.gravity_m_s2,
                   is_constant ? p.push_z : -k * through_z);
}

// Euler's scheme: the new place and velocity both follow from the old ones.
RG_FN cartoon_raindrop cartoon_fallen(cartoon_rain_params p, cartoon_raindrop was)
{
    cartoon_raindrop d = was;
    v3 a = cartoon_acceleration(p, was);
    d.from_x = was.x;
    d.from_y = was.y;
    d.from_z = was.z;
    d.x = was.x + was.vx * p.step_s;
    d.y = was.y + was.vy * p.step_s;
    d.z = was.z + was.vz * p.step_s;
    d.vx = was.vx + a.x * p.step_s;
    d.vy = was.vy + a.y * p.step_s;
    d.vz = was.vz + a.z * p.step_s;
    d.ax = a.x;
    d.ay = a.y;
    d.az = a.z;
    return d;
}

RG_FN cartoon_raindrop cartoon_faded(cartoon_rain_params p, cartoon_raindrop was)
{
    cartoon_raindrop d = was;
    d.state = CARTOON_STICKED;
    d.stuck = was.stuck + 1;
    d.alpha = 1.0f - rg_to_float(d.stuck) / rg_to_float(p.fade_steps);
    return d;
}

RG_GRID_KERNEL(cartoon_move)
{
    int slot = rg_to_int(living_at(rg, x));
    cartoon_raindrop d = raindrops_at(rg, slot);
    bool falls = d.state == CARTOON_DROP;
    if (falls)
        d = cartoon_fallen(p, d);
    else
        d = cartoon_faded(p, d);
    d.age = d.age + 1;
    bool has_left = falls && (d.y < p.floor_m || d.age >= p.life_steps);
    bool has_faded = !falls && d.stuck >= p.fade_steps;
    if (has_left)
        tally_add(rg, CARTOON_LEFT, 1u);
    if (has_faded)
        tally_add(rg, CARTOON_FADED, 1u);
    d.state = has_left || has_faded ? CARTOON_DEATH : d.state;
    raindrops_put(rg, slot, d);
}
