// flow: copies the picture behind the panes to the target.
#include "kernels/flow/panes/view_params.h"

#define RG_PARAMS     flow_view_params
#define RG_SLOTS      IMAGE(1, RGBA16F, behind) OUT_IMAGE(2, RGBA16F, target)
#define RG_OWN_TEXELS 0
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(flow_copy)
{
    target_store(rg, x, y, 0, behind_texel(rg, x, y, 0, 0));
}
