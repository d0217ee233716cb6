// The scene's picture as it was drawn when the camera came to stand: its texels are halves, as
// those of the target, so that nothing is lost.
#include "kernels/cartoon/scene/shade_params.h"

#define RG_PARAMS cartoon_shade_params
#define RG_SLOTS  IMAGE(1, RGBA16F, picture)
#include "kernels/dialect/draw/view_quad.h"

RG_DRAW_ITEM(cartoon_kept)
{
    return view_quad();
}

RG_DRAW_RECORD(cartoon_kept)
{
    return view_quad_record();
}

RG_DRAW_FRAGMENT(cartoon_kept)
{
    return rg_fragment_make(picture_texel(rg, px, py, 0, 0), 0.0f);
}
