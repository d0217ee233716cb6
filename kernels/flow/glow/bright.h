// flow: the light that the glow spreads, at a quarter of the target's size (section 1, figure 1(c):
// a camera's optics spread the light of bright reflections).
#include "kernels/flow/glow/params.h"

#define RG_PARAMS     flow_glow_params
#define RG_SLOTS      IMAGE(1, RGBA16F, lit) OUT_IMAGE(2, RGBA16F, bright)
#define RG_OWN_TEXELS 0
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(flow_glow_bright)
{
    rgba sum = rg_rgba(0.0f, 0.0f, 0.0f, 0.0f);
    for (int j = 0; j < FLOW_GLOW_REDUCTION; j++) {
        for (int i = 0; i < FLOW_GLOW_REDUCTION; i++) {
            int px = x * FLOW_GLOW_REDUCTION + i;
            int py = y * FLOW_GLOW_REDUCTION + j;
            float there = px <= p.last_x && py <= p.last_y ? 1.0f : 0.0f;
            rgba c = lit_texel(rg, rg_imin(px, p.last_x), rg_imin(py, p.last_y), 0, 0);
            sum.r += flow_glowing(p, c.r) * there;
            sum.g += flow_glowing(p, c.g) * there;
            sum.b += flow_glowing(p, c.b) * there;
        }
    }
    float scale = 1.0f / rg_to_float(FLOW_GLOW_REDUCTION * FLOW_GLOW_REDUCTION);
    bright_store(rg, x, y, 0, rg_rgba(sum.r * scale, sum.g * scale, sum.b * scale, 0.0f));
}
