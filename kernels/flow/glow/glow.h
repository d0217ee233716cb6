// flow: the final image with its glow. Bright pixels lose the light that the glow spreads, and all
// pixels get the light spread to them, interpolated from the smaller image.
#include "kernels/flow/glow/params.h"

#define RG_PARAMS flow_glow_params
#define RG_SLOTS                                                                                   \
    IMAGE(1, RGBA16F, lit) SAMPLED(2, RGBA16F, glow, FILTERED) OUT_IMAGE(3, RGBA16F, target)
#define RG_OWN_TEXELS 0
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(flow_glow)
{
    float width = rg_to_float(glow_width(rg, 0) * FLOW_GLOW_REDUCTION);
    float height = rg_to_float(glow_height(rg, 0) * FLOW_GLOW_REDUCTION);
    rgba c = lit_texel(rg, x, y, 0, 0);
    rgba g =
        glow_linear(rg, (rg_to_float(x) + 0.5f) / width, (rg_to_float(y) + 0.5f) / height, 0, 0);
    target_store(rg, x, y, 0,
                 rg_rgba(c.r - flow_glowing(p, c.r) + g.r, c.g - flow_glowing(p, c.g) + g.g,
                         c.b - flow_glowing(p, c.b) + g.b, c.a));
}
