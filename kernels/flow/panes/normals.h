// flow: the normal map of the blurred water (section 4.3), by central differences.
#include "kernels/flow/water/water.h"
#include "kernels/flow/panes/normals_params.h"
#include "kernels/flow/panes/normal_map.h"

#define RG_PARAMS flow_normals_params
#define RG_SLOTS  IN(1, float, blurred) OUT(2, uint, normals)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(flow_normals)
{
    int i = flow_pane_index(p.size, z, x, y);
    int stride = p.size + 2 * FLOW_MARGIN;
    float slope_x = (blurred_at(rg, i + 1) - blurred_at(rg, i - 1)) * p.slope_per_height;
    float slope_y = (blurred_at(rg, i + stride) - blurred_at(rg, i - stride)) * p.slope_per_height;
    float scale = 1.0f / rg_sqrt(slope_x * slope_x + slope_y * slope_y + 1.0f);
    float wetness = blurred_at(rg, i) * p.wet_per_height;
    normals_put(rg, i, wet_normal_pack(-slope_x * scale, -slope_y * scale, wetness));
}
