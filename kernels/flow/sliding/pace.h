// flow: the pace at which each cell's water slides, and its place across a drop. A drop rests until
// gravity overcomes the contact line that holds it. The water around must then exceed a volume that
// falls with the slope by Furmidge's condition: volume^(2/3) times the slope's sine is constant.
// Above that, speed grows with the water. The middle of a drop carries along the water around it,
// so that the drop slides as a whole and sweeps up small ones.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS  IN(1, float, wide) IN(2, flow_pane, panes) OUT(3, uint, pace) OUT(4, float, ridge)
#include "kernels/dialect/slots/slots.h"

RG_FN float wide_between(rg_ctx rg, flow_slide_params p, int z, float u, float v)
{
    flow_between b = flow_between_at(p, z, u, v);
    int below = b.i + flow_lattice_stride(p);
    return flow_mix(b, wide_at(rg, b.i), wide_at(rg, b.i + 1), wide_at(rg, below),
                    wide_at(rg, below + 1));
}

// 1 on the axis along which a drop slides, 0 on its flanks: by how much more water is here than on
// both sides, as a share.
RG_FN float ridge_of(rg_ctx rg, flow_slide_params p, flow_pane q, int z, int x, int y)
{
    float across_x = q.speed > 0.0f ? -q.b.y / q.speed * p.aside : p.aside;
    float across_y = q.speed > 0.0f ? q.t.y / q.speed * p.aside : 0.0f;
    float u = rg_to_float(x) + 0.5f;
    float v = rg_to_float(y) + 0.5f;
    float here = wide_at(rg, flow_pane_index(p.cells, z, x, y));
    float flanks = wide_between(rg, p, z, u + across_x, v + across_y) +
                   wide_between(rg, p, z, u - across_x, v - across_y);
    float more = (2.0f * here - flanks) / rg_max(here, FLOW_DROPLET);
    return rg_clamp(2.0f * more - 0.3f, 0.0f, 1.0f);
}

// A cell's water that carries along water at this distance: 0 if the distance is too large.
RG_FN float carried(rg_ctx rg, flow_slide_params p, int i, float distance2)
{
    float near = distance2 <= p.reach2 ? 1.0f : 0.0f;
    return near * wide_at(rg, i);
}

// The most in a row of cells. Written out, because compilers for processors vectorise over items
// only without a loop.
RG_FN float most_of_row(rg_ctx rg, flow_slide_params p, int i, float dy2)
{
    float most = carried(rg, p, i, dy2);
    most = rg_max(most, carried(rg, p, i - 1, dy2 + 1.0f));
    most = rg_max(most, carried(rg, p, i + 1, dy2 + 1.0f));
    most = rg_max(most, carried(rg, p, i - 2, dy2 + 4.0f));
    most = rg_max(most, carried(rg, p, i + 2, dy2 + 4.0f));
    most = rg_max(most, carried(rg, p, i - 3, dy2 + 9.0f));
    return rg_max(most, carried(rg, p, i + 3, dy2 + 9.0f));
}

RG_FN float most_of_rows(rg_ctx rg, flow_slide_params p, int i, int down, float dy2)
{
    return rg_max(most_of_row(rg, p, i - down, dy2), most_of_row(rg, p, i + down, dy2));
}

RG_GRID_KERNEL(flow_pace)
{
    int i = flow_pane_index(p.cells, z, x, y);
    int stride = flow_lattice_stride(p);
    flow_pane q = panes_at(rg, z);
    float most = rg_max(most_of_row(rg, p, i, 0.0f), most_of_rows(rg, p, i, stride, 1.0f));
    most = rg_max(most, most_of_rows(rg, p, i, 2 * stride, 4.0f));
    most = rg_max(most, most_of_rows(rg, p, i, 3 * stride, 9.0f));
    float slope = q.speed * rg_sqrt(q.speed);
    float speed = (most * slope / p.slides_above - 1.0f) * p.gain_mm_s;
    uint pace = 0u;
    float next = p.slowest_mm_s;
    for (int c = 1; c < FLOW_PACES; c++) {
        pace = speed > next ? pace + 1u : pace;
        next = next * FLOW_PACE_RATIO;
    }
    pace_put(rg, i, pace);
    ridge_put(rg, i, ridge_of(rg, p, q, z, x, y));
}
