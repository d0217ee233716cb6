// shower: ends the step of a system whose particles are promoted; an item does a chunk of slots. It
// counts promotions. Particles whose column has no top, or that have no place yet, get another
// place. If that is out of sight or below the ground, they wait.
#include "kernels/shower/birth.h"
#include "kernels/shower/body.h"

#define RG_PARAMS shower_params
#define RG_SLOTS                                                                                   \
    INOUT(1, float, particles)                                                                     \
    IN(2, uint, marks) IMAGE(3, D32F, heights) INOUT(4, float, attributes) ATOMIC(5, uint, tally)
#include "kernels/dialect/slots/slots.h"

#include "kernels/shower/ground.h"
#include "kernels/shower/renewal/place.h"

// 1 if it found a place.
RG_FN uint shower_placed(rg_ctx rg, shower_params p, int slot)
{
    shower_particle q = shower_born(p, slot);
    if (shower_holds(p, q.at) == 0 || q.at.y < shower_ground(rg, p, q.at.x, q.at.z))
        return 0u;
    shower_put(rg, p, slot, q, p.is_full);
    return 1u;
}

RG_GRID_KERNEL(shower_promote)
{
    int end = rg_imin((x + 1) * SHOWER_CHUNK, p.slots);
    uint raised = 0u;
    uint passed = 0u;
    uint placed = 0u;
    uint alive = 0u;
    for (int i = x * SHOWER_CHUNK; i < end; i++) {
        uint mark = marks_at(rg, i);
        uint is_placed = mark == SHOWER_FREE ? shower_placed(rg, p, i) : 0u;
        raised += mark == SHOWER_PROMOTED ? 1u : 0u;
        passed += mark == SHOWER_CROSSED ? 1u : 0u;
        placed += is_placed;
        alive += mark == SHOWER_FREE ? is_placed : 1u;
    }
    tally_add(rg, SHOWER_RAISED, raised);
    tally_add(rg, SHOWER_PASSED, passed);
    tally_add(rg, SHOWER_PLACED, placed);
    tally_add(rg, SHOWER_ALIVE, alive);
}
