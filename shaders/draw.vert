// The vertex stage of a DRAW program: three or six vertices for each packed primitive, placed on
// its corners. In a viewport of RG_VIEWPORT_PX every step below is exact, so the driver snaps to
// the very integers that were packed.
#define RG_STAGE_VERTEX 1
#include "kernels/dialect/rounding.h"
#include RG_KERNEL_HEADER

layout(std140, binding = 0) uniform rg_run_block
{
    ivec4 origin;
    ivec4 end;
    RG_RUN_PARAMS params;
} rg_run;

// Packed primitives with their corners as an array, so that a vertex reads only its own.
struct rg_prim_corners
{
    int at[8];
    int item;
    RG_RECORD record;
};
layout(std430, binding = 12) restrict readonly buffer rg_block_corners
{
    rg_prim_corners rg_corners[];
};

layout(location = 0) flat out int rg_prim_index;

float rg_place(int snapped, int size)
{
    int margin = (RG_VIEWPORT_PX - size) / 2;
    return float(snapped + margin * RG_SUBPIXELS) * (2.0 / (RG_SUBPIXELS * RG_VIEWPORT_PX)) - 1.0;
}

void main()
{
    int vertices = RG_CORNERS == 3 ? 3 : 6;
    int prim = RG_VERTEX_INDEX / vertices;
    int corner = RG_VERTEX_INDEX - prim * vertices;
    corner = corner > 2 ? (corner == 3 ? 0 : corner - 2) : corner; // 0 1 2, 0 2 3
    int x = rg_corners[prim].at[2 * corner];
    int y = rg_corners[prim].at[2 * corner + 1];
    rg_prim_index = prim;
    gl_Position = vec4(rg_place(x, rg_run.params.draw.width),
                       rg_place(y, rg_run.params.draw.height), 0.0, 1.0);
}
