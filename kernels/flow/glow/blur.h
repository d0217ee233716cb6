// flow: spreads the glow along one direction. Weights are the square of the distance to the blur's
// end, over their sum. Light that would leave the image is mirrored back. So no light is made or
// lost.
#include "kernels/flow/glow/params.h"

#define RG_PARAMS     flow_glow_params
#define RG_SLOTS      IMAGE(1, RGBA16F, source) OUT_IMAGE(2, RGBA16F, spread)
#define RG_OWN_TEXELS 0
#include "kernels/dialect/slots/slots.h"

// A coordinate, mirrored at both edges; within 0 to `last` even in images narrower than the blur.
RG_FN int thrown_back(int i, int last)
{
    int low = i < 0 ? -1 - i : i;
    int high = low > last ? 2 * last + 1 - low : low;
    return rg_iclamp(high, 0, last);
}

RG_GRID_KERNEL(flow_glow_blur)
{
    rgba sum = rg_rgba(0.0f, 0.0f, 0.0f, 0.0f);
    float total = 0.0f;
    for (int k = -FLOW_GLOW_RADIUS; k <= FLOW_GLOW_RADIUS; k++) {
        float end = rg_to_float(FLOW_GLOW_RADIUS + 1) - rg_abs(rg_to_float(k));
        float weight = end * end;
        rgba c = source_texel(rg, thrown_back(x + k * p.step_x, p.last_x),
                              thrown_back(y + k * p.step_y, p.last_y), 0, 0);
        sum = rg_rgba(sum.r + c.r * weight, sum.g + c.g * weight, sum.b + c.b * weight, 0.0f);
        total += weight;
    }
    spread_store(rg, x, y, 0, rg_rgba(sum.r / total, sum.g / total, sum.b / total, 0.0f));
}
