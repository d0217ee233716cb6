// The geometry stage of a DRAW program on native devices: makes the triangle or quad of an item, and
// its record. The driver clips, culls and snaps.
#define RG_STAGE_GEOMETRY 1
#include "kernels/dialect/rounding.h"
#include RG_KERNEL_HEADER

layout(points) in;
layout(triangle_strip, max_vertices = RG_CORNERS) out;

layout(std140, binding = 0) uniform rg_run_block
{
    ivec4 origin;
    ivec4 end;
    RG_RUN_PARAMS params;
} rg_run;

layout(location = 0) in vec4 rg_corners[][4];
layout(location = 4) flat in int rg_number[];

layout(location = 0) out vec2 rg_at;
layout(location = 1) flat out int rg_item_drawn;
RG_SENDS(RG_RECORD)

void rg_emit(RG_RECORD record, int corner, float across, float down)
{
    gl_Position = rg_corners[0][corner];
    rg_at = vec2(across, down);
    rg_item_drawn = rg_number[0];
    rg_send(record);
    EmitVertex();
}

// A quad's two triangles meet between its first and its third corner.
void main()
{
    if (rg_number[0] < 0)
        return;
    rg_ctx rg;
    rg.p = rg_run.params;
    RG_RECORD record = rg_program_record(rg, rg.p.draw, rg.p.program, rg_number[0]);
    if (RG_CORNERS == 4) {
        rg_emit(record, 1, 1.0, 0.0);
        rg_emit(record, 2, 1.0, 1.0);
        rg_emit(record, 0, 0.0, 0.0);
        rg_emit(record, 3, 0.0, 1.0);
    } else {
        rg_emit(record, 0, 0.0, 0.0);
        rg_emit(record, 1, 1.0, 0.0);
        rg_emit(record, 2, 0.0, 1.0);
    }
    EndPrimitive();
}
