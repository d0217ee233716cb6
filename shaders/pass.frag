// The fragment stage of a GRID kernel whose texels native devices draw: a fragment for each item,
// whose colour is what the item stores (kernels/dialect/slots/glsl.h). The scissor has the items'
// extent, and a run has one layer.
#define RG_STAGE_PASS 1
layout(location = 0) out vec4 rg_texel;
// Some items store nothing. One of an array, for glslc makes a local of a global that is `precise`.
bool rg_is_stored[1];
#include "kernels/dialect/rounding.h"
#include RG_KERNEL_HEADER

layout(std140, binding = 0) uniform rg_run_block
{
    ivec4 origin;
    ivec4 end;
    RG_RUN_PARAMS params;
} rg_run;

void main()
{
    rg_ctx rg;
    rg.p = rg_run.params;
    rg_is_stored[0] = false;
    rg_texel = vec4(0.0);
    rg_kernel(rg, rg.p, int(gl_FragCoord.x), int(gl_FragCoord.y), rg_run.origin.z);
    if (!rg_is_stored[0])
        discard;
}
