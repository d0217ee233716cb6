// Running drops move on by a substep (eqs. 2 to 5), and remember their way. Before the first
// substep of a step they may leave another drop behind.
#include "kernels/drops/running/residue.h"
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    INOUT(1, drops_drop, drops)                                                                    \
    OUT(2, float, ways)                                                                            \
    IN(3, float, height) IN(4, float, affinity) ATOMIC(5, uint, tally) ATOMIC(6, uint, tiles)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/tiles/stir.h"

// Means over a region of cells (section 4.1).
RG_STRUCT(region)
{
    float height;
    float affinity;
};
RG_STRUCT_SIZE(region, 2)

// Cells beyond the pane do not count, and a region whose middle is beyond is dry.
RG_FN region region_at(rg_ctx rg, drops_params p, float x, float y)
{
    int column = rg_to_int(rg_floor(x / p.cell_mm));
    int row = rg_to_int(rg_floor(y / p.cell_mm));
    region r;
    r.height = 0.0f;
    r.affinity = 0.0f;
    float cells = 0.0f;
    if (!drops_on_pane(p, column, row))
        return r;
    for (int i = row - p.reach_cells; i <= row + p.reach_cells; i++) {
        for (int k = column - p.reach_cells; k <= column + p.reach_cells; k++) {
            if (drops_on_pane(p, k, i)) {
                int cell = drops_cell(p, k, i);
                r.height += height_at(rg, cell);
                r.affinity += affinity_at(rg, cell);
                cells += 1.0f;
            }
        }
    }
    r.height = r.height / cells;
    r.affinity = r.affinity / cells;
    return r;
}

// -1: to the left of straight down, as one looks along it with the pane's top above; 0: straight;
// 1: to the right. Straight wins ties, and so does the left among sides.
RG_FN int wetter(float straight, float left, float right)
{
    return straight >= left && straight >= right ? 0 : left >= right ? -1 : 1;
}

RG_FN int way_to_go(rg_ctx rg, drops_params p, drops_drop d)
{
    float x = d.x + p.down_x * p.ahead_mm;
    float y = d.y + p.down_y * p.ahead_mm;
    region straight = region_at(rg, p, x, y);
    region left = region_at(rg, p, x - p.down_y * p.beside_mm, y + p.down_x * p.beside_mm);
    region right = region_at(rg, p, x + p.down_y * p.beside_mm, y - p.down_x * p.beside_mm);
    bool is_dry = straight.height == 0.0f && left.height == 0.0f && right.height == 0.0f;
    return is_dry ? wetter(straight.affinity, left.affinity, right.affinity)
                  : wetter(straight.height, left.height, right.height);
}

// The distance to the right for 1 down: the tangent of the angle with straight down.
RG_FN float aside(drops_params p, uint id, int way)
{
    if (way != 0)
        return rg_to_float(way) * p.beside_mm / p.ahead_mm;
    uint step = p.step * rg_to_uint(p.substeps) + rg_to_uint(p.substep);
    float angle =
        p.meander_rad * (2.0f * rg_uniform(rg_random(p.seed, id, step, DROPS_MEANDER).x) - 1.0f);
    return rg_sin(angle) / rg_cos(angle);
}

// A drop as the step begins: it runs for the whole step, or stands. Only the first drops may leave
// others behind, as many as there is room for.
RG_FN drops_drop started(rg_ctx rg, drops_params p, drops_drop was, int index)
{
    drops_drop d = was;
    d.is_new = 0u;
    d.runs = d.mass > p.critical ? 1u : 0u;
    if (d.runs != 0u && d.rests != 0u) {
        spoil(rg, p, d);
        d.rests = 0u;
    }
    rg_uint4 words = rg_random(p.seed, d.id, p.step, DROPS_RESIDUAL);
    bool sheds = d.runs != 0u && does_shed(p, d, rg_uniform(words.x));
    d.since_s = sheds ? 0.0f : d.since_s + p.step_s;
    bool bears = sheds && p.count + index < p.most;
    uint mass = bears ? child_mass(p, d, rg_uniform(words.y)) : 0u;
    drops_put(rg, p.count + index, child_of(d, mass));
    if (mass > 0u)
        tally_add(rg, DROPS_BORN, 1u);
    d.mass -= mass;
    if (d.runs == 0u) {
        d.vx = 0.0f;
        d.vy = 0.0f;
    }
    return d;
}

RG_FN drops_drop moved(rg_ctx rg, drops_params p, drops_drop was)
{
    drops_drop d = was;
    float pull = (p.gravity_mm_s2 - p.held_mg_mm_s2 / drops_mg(d.mass)) * p.substep_s;
    float speed = rg_sqrt((d.vx + p.down_x * pull) * (d.vx + p.down_x * pull) +
                          (d.vy + p.down_y * pull) * (d.vy + p.down_y * pull));
    float across = aside(p, d.id, way_to_go(rg, p, d));
    float scale = speed / rg_sqrt(1.0f + across * across);
    d.vx = (p.down_x + p.down_y * across) * scale;
    d.vy = (p.down_y - p.down_x * across) * scale;
    d.x += d.vx * p.substep_s;
    d.y += d.vy * p.substep_s;
    return d;
}

RG_GRID_KERNEL(drops_run)
{
    drops_drop d = drops_at(rg, x);
    int place = 2 * (x * (p.substeps + 1) + p.substep);
    if (p.substep == 0) {
        d = started(rg, p, d, x);
        ways_put(rg, place, d.x);
        ways_put(rg, place + 1, d.y);
    }
    if (d.runs != 0u && drops_holds(p, d.x, d.y))
        d = moved(rg, p, d);
    ways_put(rg, place + 2, d.x);
    ways_put(rg, place + 3, d.y);
    drops_put(rg, x, d);
}
