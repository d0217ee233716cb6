// flow: adds the glow to the target, between its pixels: one quad that fills the view.
#include "flow_glow_params.h"

#define RG_PARAMS flow_glow_params
#define RG_SLOTS  IMAGE(1, RGBA16F, glow)
#include "view_quad.h"

RG_DRAW_ITEM(flow_glow)
{
    return view_quad();
}

RG_DRAW_RECORD(flow_glow)
{
    return view_quad_record();
}

RG_DRAW_FRAGMENT(flow_glow)
{
    rgba c = glow_linear(rg, (rg_to_float(px) + 0.5f) / p.width,
                         (rg_to_float(py) + 0.5f) / p.height, 0, 0);
    return rg_fragment_make(rg_rgba(c.r, c.g, c.b, 0.0f), 0.0f);
}
