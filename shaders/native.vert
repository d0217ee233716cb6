// The vertex stage of a DRAW program on native devices: a vertex for each item, which moves it and
// makes its corners in clip space. shaders/native.geom draws these.
#define RG_STAGE_VERTEX 1
#include "kernels/dialect/rounding.h"
#include RG_KERNEL_HEADER

layout(std140, binding = 0) uniform rg_run_block
{
    ivec4 origin;
    ivec4 end;
    RG_RUN_PARAMS params;
} rg_run;

layout(location = 0) out vec4 rg_corners[4];
layout(location = 4) flat out int rg_number; // of the item; -1: there is nothing to draw

vec4 rg_placed(rg_corner c)
{
    return vec4(c.x, c.y, c.z, c.w);
}

void main()
{
    rg_ctx rg;
    rg.p = rg_run.params;
    rg_item t = rg_item_closed(
        rg_program_item(rg, rg.p.draw, rg.p.program, RG_VERTEX_INDEX), RG_CORNERS);
    rg_corners[0] = rg_placed(t.a);
    rg_corners[1] = rg_placed(t.b);
    rg_corners[2] = rg_placed(t.c);
    rg_corners[3] = rg_placed(t.d);
    rg_number = t.alive != 0 ? RG_VERTEX_INDEX : -1;
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
