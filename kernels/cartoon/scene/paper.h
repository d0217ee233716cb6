// Outlines alone, on paper.
#include "kernels/cartoon/scene/shade_params.h"

#define RG_PARAMS cartoon_shade_params
#define RG_SLOTS                                                                                   \
    IMAGE(1, D32F, depth_map)                                                                      \
    IMAGE(2, RGBA16F, normal_map) IN(3, uint, palette) IMAGE(4, D32F, ink)
#include "kernels/dialect/draw/view_quad.h"

#include "kernels/cartoon/scene/seen.h"

RG_DRAW_ITEM(cartoon_paper)
{
    return view_quad();
}

RG_DRAW_RECORD(cartoon_paper)
{
    return view_quad_record();
}

RG_DRAW_FRAGMENT(cartoon_paper)
{
    return cartoon_inked(rg, p, v3_make(p.paper_r, p.paper_g, p.paper_b), px, py);
}
