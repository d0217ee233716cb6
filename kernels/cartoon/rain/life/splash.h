// Makes a splash of each drop that has hit in this step: the nth takes the nth free slot.
#include "kernels/cartoon/rain/params.h"

#define RG_PARAMS cartoon_rain_params
#define RG_SLOTS                                                                                   \
    IN(1, uint, unused)                                                                            \
    INOUT(2, uint, living)                                                                         \
    IN(3, uint, hits)                                                                              \
    IN(4, uint, hits_before)                                                                       \
    IN(5, cartoon_raindrop, raindrops)                                                             \
    IN(6, cartoon_surface, surfaces) OUT(7, cartoon_spray, sprays) ATOMIC(8, uint, tally)
#include "kernels/dialect/slots/slots.h"

#include "kernels/cartoon/rain/life/lists.h"

// The angle of impact selects one of the paper's three patterns; the bounds, 30 and 60 degrees, are
// ours.
#define CARTOON_STEEP_RAD 0.523598776f
#define CARTOON_FLAT_RAD  1.04719755f

RG_FN cartoon_spray cartoon_spray_of(cartoon_raindrop d, cartoon_surface at)
{
    cartoon_spray s;
    s.x = d.x;
    s.y = d.y;
    s.z = d.z;
    s.nx = at.nx;
    s.ny = at.ny;
    s.nz = at.nz;
    s.weight = d.size;
    s.alpha = 1.0f;
    s.angle = at.angle;
    s.pattern = at.angle < CARTOON_STEEP_RAD ? 0 : at.angle < CARTOON_FLAT_RAD ? 1 : 2;
    s.texture = 0;
    s.age = 0;
    s.state = CARTOON_DROP;
    return s;
}

RG_GRID_KERNEL(cartoon_splash)
{
    if (hits_at(rg, x) == 0u)
        return;
    int nth = rg_to_int(hits_before_at(rg, x));
    if (nth >= p.free_sprays) {
        tally_add(rg, CARTOON_SPRAY_REFUSED, 1u);
        return;
    }
    int slot = rg_to_int(unused_at(rg, p.drop_slots + nth));
    cartoon_raindrop d = raindrops_at(rg, rg_to_int(living_at(rg, x)));
    living_put(rg, cartoon_new_sprays(p) + nth, rg_to_uint(slot));
    sprays_put(rg, slot, cartoon_spray_of(d, surfaces_at(rg, x)));
    tally_add(rg, CARTOON_SPLASHED, 1u);
}
