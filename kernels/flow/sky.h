// flow: the environment behind everything, as one quad that fills the view.
#include "kernels/flow/panes/view_params.h"

#define RG_PARAMS flow_view_params
#define RG_SLOTS  SAMPLED(1, RG11B10F, environment, CUBE)
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/view_quad.h"

#include "kernels/dialect/image/cube_light.h"

RG_DRAW_ITEM(flow_sky)
{
    return view_quad();
}

RG_DRAW_RECORD(flow_sky)
{
    return view_quad_record();
}

RG_DRAW_FRAGMENT(flow_sky)
{
    v3 ray = m4_turn(p.rays, v3_make(rg_to_float(px), rg_to_float(py), 1.0f));
    v3 light = light_from(rg, ray, 0, p.environment_size);
    return rg_fragment_make(rg_rgba(light.x, light.y, light.z, 1.0f), 1.0f);
}
