// raster: what was drawn in RGBA8, shown in the target.
#include "kernels/raster/show_params.h"

#define RG_PARAMS     raster_show_params
#define RG_SLOTS      IMAGE(1, RGBA8, drawn) OUT_IMAGE(2, RGBA16F, target)
#define RG_OWN_TEXELS p.layer
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(raster_show_rgba8)
{
    target_store(rg, x, y, p.layer, drawn_texel(rg, x, y, p.layer, 0));
}
