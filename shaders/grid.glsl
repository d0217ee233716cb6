// Makes a compute stage of a GRID kernel. Each work item runs one item; the host folds large grids.
#include "kernels/dialect/rounding.h"
#include RG_KERNEL_HEADER

layout(local_size_x = 64) in;

layout(std140, binding = 0) uniform rg_run_block
{
    ivec4 origin;
    ivec4 end;
    RG_RUN_PARAMS params;
} rg_run;

void main()
{
    ivec3 item = rg_run.origin.xyz + ivec3(gl_GlobalInvocationID);
    if (item.x < rg_run.end.x && item.y < rg_run.end.y && item.z < rg_run.end.z) {
        rg_ctx rg;
        rg.p = rg_run.params;
        rg_kernel(rg, rg.p, item.x, item.y, item.z);
    }
}
