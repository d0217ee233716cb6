// Directions that texels keep (`direction=texel`), the paper's future work: a texel's direction
// follows those of its neighbours too, and texels that move sweep along the water beside them.
//
// A direction is one word. It has the first of two of the eight neighbours (figure 8), and the
// share of the given water that goes to the next one clockwise, in 256ths. A bit says whether the
// texel moved by itself, or was swept along. The word is 0 if the texel gives nothing.
#ifndef RG_KERNELS_FLOW_SWEPT_HEADING_H
#define RG_KERNELS_FLOW_SWEPT_HEADING_H

#include "kernels/dialect/math.h"
#include "kernels/flow/water/water.h"

#define FLOW_HEADING_SHARES 256
#define FLOW_HEADING_MOVES  2048u // the texel moved by itself

RG_STRUCT(flow_way)
{
    float x;
    float y;
};

// The eight neighbours, clockwise from the right one.
RG_FN int flow_step_x(int eighth)
{
    return ((eighth + 1) & 7) <= 2 ? 1 : ((eighth + 5) & 7) <= 2 ? -1 : 0;
}

RG_FN int flow_step_y(int eighth)
{
    return ((eighth + 7) & 7) <= 2 ? 1 : ((eighth + 3) & 7) <= 2 ? -1 : 0;
}

RG_FN int flow_heading_eighth(uint heading)
{
    return rg_to_int(heading & 7u);
}

RG_FN float flow_heading_share(uint heading)
{
    return rg_to_float(rg_to_int((heading >> 3) & 255u)) * (1.0f / 256.0f);
}

// The word for the direction nearest to (x, y), which is not (0, 0): by angle, 4 * 256 parts in
// half a turn.
RG_FN uint flow_heading_of(float x, float y)
{
    float parts = rg_atan2(y, x) * 325.949323f;
    int nearest = rg_to_int(rg_floor(parts + 0.5f)) & (8 * FLOW_HEADING_SHARES - 1);
    return rg_to_uint(nearest / FLOW_HEADING_SHARES) |
           (rg_to_uint(nearest & (FLOW_HEADING_SHARES - 1)) << 3);
}

// The direction of a word, of unit length.
RG_FN flow_way flow_heading_way(uint heading)
{
    int e = flow_heading_eighth(heading);
    float b = flow_heading_share(heading);
    float x = rg_to_float(flow_step_x(e)) * (1.0f - b) + rg_to_float(flow_step_x(e + 1)) * b;
    float y = rg_to_float(flow_step_y(e)) * (1.0f - b) + rg_to_float(flow_step_y(e + 1)) * b;
    float scale = 1.0f / rg_sqrt(x * x + y * y);
    flow_way way;
    way.x = x * scale;
    way.y = y * scale;
    return way;
}

// A pane whose two directions and share are those of this word.
RG_FN flow_pane flow_pane_headed(flow_pane pane, uint heading)
{
    int e = flow_heading_eighth(heading);
    flow_pane q = pane;
    q.ax = flow_step_x(e);
    q.ay = flow_step_y(e);
    q.bx = flow_step_x(e + 1);
    q.by = flow_step_y(e + 1);
    q.b_share = flow_heading_share(heading);
    return q;
}

#endif
