// Packs the drops that stay, in the order of their IDs, and appends those that land. A drop whose
// parent has merged gets the merged drop as its parent.
#include "kernels/drops/chance.h"
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    IN(1, drops_drop, drops)                                                                       \
    IN(2, uint, flags)                                                                             \
    IN(3, uint, before)                                                                            \
    IN(4, uint, joins)                                                                             \
    IN(5, uint, leaders)                                                                           \
    IN(6, uint, sums) OUT(7, drops_drop, packed) ATOMIC(8, uint, tally) ATOMIC(9, uint, tiles)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/sets/ids.h"
#include "kernels/drops/sets/owners.h"
#include "kernels/drops/tiles/stir.h"
#include "kernels/drops/merging/sums.h"

RG_FN uint parent_after(rg_ctx rg, drops_params p, uint parent)
{
    int at = parent != 0u && p.has_joined != 0 ? owner_of(rg, p, parent) : -1;
    int leader = at >= 0 ? leader_in(rg, joins_at(rg, at)) : -1;
    return leader >= 0 ? id_of_slot(rg, p, merged_slot(p, leader)) : parent;
}

// Most drops are small (section 4.1). The paper does not say how they land; its program draws their
// places at random.
RG_FN uint landing_mass(drops_params p, uint id)
{
    float mean = (p.most_mg - p.least_mg) * 0.2f + p.least_mg;
    float mg = drops_normal(rg_random(p.seed, id, p.step, DROPS_LAND_MASS), mean, 1.5f);
    return rg_to_uint(rg_to_int(rg_clamp(mg, p.least_mg, p.most_mg) * DROPS_QUANTA_MG + 0.5f));
}

RG_FN drops_drop landing(drops_params p, uint id)
{
    rg_uint4 place = rg_random(p.seed, id, p.step, DROPS_LAND_PLACE);
    drops_drop d;
    d.id = id;
    d.parent = 0u;
    d.mass = landing_mass(p, id);
    d.x = rg_uniform(place.x) * rg_to_float(p.columns) * p.cell_mm;
    d.y = rg_uniform(place.y) * rg_to_float(p.rows) * p.cell_mm;
    d.vx = 0.0f;
    d.vy = 0.0f;
    d.since_s = 0.0f;
    d.is_new = DROPS_LANDED_NOW;
    d.runs = 0u;
    d.rests = 0u;
    return d;
}

// Wakes the tiles that a drop will reach in the next step. Its speed rises by at most gravity's,
// and it runs within a box around its way.
RG_PROC void rouse(rg_ctx rg, drops_params p, drops_drop d)
{
    if (d.mass <= p.critical)
        return;
    float speed = rg_sqrt(d.vx * d.vx + d.vy * d.vy);
    float way = (speed + p.gravity_mm_s2 * p.step_s) * p.step_s * 1.01f;
    float beside = way * rg_max(p.beside_mm / p.ahead_mm, p.meander_rad);
    drops_block b = drops_block_around(p, d.x, d.y, d.x + p.down_x * way, d.y + p.down_y * way,
                                       drops_radius_mm(d.mass) + beside + p.cell_mm);
    if (b.left <= b.right && b.top <= b.bottom)
        mark(rg, p, b, DROPS_STIRRED);
}

// Whether the drop's water is on the pane although it does not run.
RG_FN bool does_rest(drops_drop d)
{
    return d.is_new == 0u ? d.runs == 0u : d.is_new == DROPS_BORN_NOW;
}

RG_PROC void land(rg_ctx rg, drops_params p, int nth)
{
    int slot = rg_to_int(before_at(rg, p.slots)) + nth;
    if (slot >= p.most)
        return;
    drops_drop d = landing(p, id_of_slot(rg, p, p.slots) + rg_to_uint(nth));
    rouse(rg, p, d);
    packed_put(rg, slot, d);
    tally_add(rg, DROPS_SOURCED, d.mass);
    tally_add(rg, DROPS_LANDED, 1u);
}

RG_GRID_KERNEL(drops_pack)
{
    if (x >= p.slots) {
        land(rg, p, x - p.slots);
        return;
    }
    if (flags_at(rg, x) == 0u)
        return;
    drops_drop d = drops_at(rg, x);
    d.id = x < p.count ? d.id : id_of_slot(rg, p, x);
    d.parent = parent_after(rg, p, d.parent);
    bool rests = does_rest(d);
    if (rests && d.rests == 0u)
        spoil(rg, p, d);
    d.rests = rests ? 1u : 0u;
    rouse(rg, p, d);
    packed_put(rg, rg_to_int(before_at(rg, x)), d);
}
