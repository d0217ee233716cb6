// Blends a layer of light, which was gathered from black in single precision, over its background.
// The sum is rounded once, to nearest. A subnormal on the way would be too small to see.
#include "kernels/scenery/layer/params.h"

#define RG_PARAMS layer_params
#define RG_SLOTS  IMAGE(1, RGBA32F, layer) IMAGE(2, RGBA16F, background)
#include "kernels/dialect/draw/view_quad.h"

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
    rgba light = layer_texel(rg, px, py, 0, 0);
    rgba behind = background_texel(rg, px, py, 0, 0);
    float rest = 1.0f - light.a;
    rgba met = rg_rgba(light.r + behind.r * rest, light.g + behind.g * rest,
                       light.b + behind.b * rest, light.a + behind.a * rest);
    return rg_fragment_make(rg_nearest_RGBA16F(met), 0.0f);
}
