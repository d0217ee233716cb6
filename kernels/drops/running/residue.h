// Residual drops, which running drops leave behind (eq. 6). Every drop has a slot for its child.
#ifndef RG_KERNELS_DROPS_RUNNING_RESIDUE_H
#define RG_KERNELS_DROPS_RUNNING_RESIDUE_H

#include "kernels/dialect/rng.h"
#include "kernels/drops/params.h"

RG_FN bool does_shed(drops_params p, drops_drop d, float drawn)
{
    float share = rg_min(1.0f, d.since_s / p.residual_max_s);
    float chance = rg_min(1.0f, p.residual_beta * p.step_s / p.residual_max_s * share);
    return p.residual != 0 && drawn < chance;
}

RG_FN uint child_mass(drops_params p, drops_drop d, float drawn)
{
    float share = p.residual_low + (p.residual_high - p.residual_low) * drawn;
    uint mass = rg_to_uint(rg_to_int(rg_to_float(d.mass) * share));
    return mass < p.critical ? mass : p.critical;
}

// The child rests at its parent's place.
RG_FN drops_drop child_of(drops_drop d, uint mass)
{
    drops_drop child = d;
    child.parent = d.id;
    child.mass = mass;
    child.vx = 0.0f;
    child.vy = 0.0f;
    child.since_s = 0.0f;
    child.is_new = DROPS_BORN_NOW;
    child.runs = 0u;
    child.rests = 0u;
    return child;
}

#endif
