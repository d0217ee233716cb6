// A layer of light that was gathered from black in single precision, and what lies behind it: both
// meet once, and are rounded once, to nearest.
#include "kernels/scenery/layer/params.h"

#define RG_PARAMS layer_params
#define RG_SLOTS  IMAGE(1, RGBA32F, layer) IMAGE(2, RGBA16F, background)
#include "kernels/dialect/draw/view_quad.h"
#include "kernels/dialect/draw/blend.h"

RG_DRAW_ITEM(layer_meet)
{
    return view_quad();
}

RG_DRAW_RECORD(layer_meet)
{
    return view_quad_record();
}

RG_DRAW_FRAGMENT(layer_meet)
{
    rgba met = rg_blend_floats(layer_texel(rg, px, py, 0, 0), background_texel(rg, px, py, 0, 0),
                               RG_BLEND_IS_OVER);
    return rg_fragment_make(rg_nearest_RGBA16F(met), 0.0f);
}
