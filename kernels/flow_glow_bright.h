// flow: the light above a threshold, at a quarter of the target's size: what glows (section 1,
// figure 1(c): the optics of a camera spread the light of bright reflections).
#include "flow_glow_params.h"

#define RG_PARAMS flow_glow_params
#define RG_SLOTS  IMAGE(1, RGBA16F, target) OUT_IMAGE(2, RGBA16F, bright)
#include "slots.h"

RG_GRID_KERNEL(flow_glow_bright)
{
    rgba sum = rg_rgba(0.0f, 0.0f, 0.0f, 0.0f);
    for (int j = 0; j < FLOW_GLOW_REDUCTION; j++) {
        for (int i = 0; i < FLOW_GLOW_REDUCTION; i++) {
            rgba c = target_texel(rg, rg_imin(x * FLOW_GLOW_REDUCTION + i, p.last_x),
                                  rg_imin(y * FLOW_GLOW_REDUCTION + j, p.last_y), 0, 0);
            sum.r += rg_max(c.r - p.threshold, 0.0f);
            sum.g += rg_max(c.g - p.threshold, 0.0f);
            sum.b += rg_max(c.b - p.threshold, 0.0f);
        }
    }
    float scale = p.strength / rg_to_float(FLOW_GLOW_REDUCTION * FLOW_GLOW_REDUCTION);
    bright_store(rg, x, y, 0, rg_rgba(sum.r * scale, sum.g * scale, sum.b * scale, 0.0f));
}
