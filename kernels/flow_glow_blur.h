// flow: spreads the glow along one direction. Weights fall off with the square of the distance to
// the blur's end and sum to 1, so that light is spread, not made.
#include "flow_glow_params.h"

#define RG_PARAMS flow_glow_params
#define RG_SLOTS  IMAGE(1, RGBA16F, source) OUT_IMAGE(2, RGBA16F, spread)
#include "slots.h"

RG_GRID_KERNEL(flow_glow_blur)
{
    rgba sum = rg_rgba(0.0f, 0.0f, 0.0f, 0.0f);
    float total = 0.0f;
    for (int k = -FLOW_GLOW_RADIUS; k <= FLOW_GLOW_RADIUS; k++) {
        float end = rg_to_float(FLOW_GLOW_RADIUS + 1) - rg_abs(rg_to_float(k));
        float weight = end * end;
        rgba c = source_texel(rg, rg_iclamp(x + k * p.step_x, 0, p.last_x),
                              rg_iclamp(y + k * p.step_y, 0, p.last_y), 0, 0);
        sum = rg_rgba(sum.r + c.r * weight, sum.g + c.g * weight, sum.b + c.b * weight, 0.0f);
        total += weight;
    }
    spread_store(rg, x, y, 0, rg_rgba(sum.r / total, sum.g / total, sum.b / total, 0.0f));
}
