// The fragment stage of a DRAW program on native devices. The driver has interpolated the place
// among the corners, and tests depth itself, early if the program leaves depth to it. Without
// rg_interpolates the fragment computes its place, from a record that it makes anew: the geometry
// stage sends no planes.
#define RG_STAGE_FRAGMENT 1
layout(location = 0) in vec2 rg_at;
layout(location = 1) flat in int rg_item_drawn;
#include "kernels/dialect/rounding.h"
#include RG_KERNEL_HEADER
#include "kernels/dialect/draw/lit.h"

layout(std140, binding = 0) uniform rg_run_block
{
    ivec4 origin;
    ivec4 end;
    RG_RUN_PARAMS params;
} rg_run;

RG_RECEIVES(RG_RECORD)
layout(location = 0) out vec4 rg_colour;

// Counts a visible sample, against a depth that this draw does not write.
bool rg_counts(rg_ctx rg, int x, int y, float depth)
{
    bool visible = rg_run.params.draw.depth_mode == 0 || depth < rg_behind_texel(rg, x, y, 0, 0).r;
    if (visible)
        rg_samples_add(rg, rg_item_drawn, 1u);
    return visible;
}

void main()
{
    rg_ctx rg;
    rg.p = rg_run.params;
    int x = int(gl_FragCoord.x);
    int y = int(gl_FragCoord.y);
    RG_RECORD record = rg_received();
    if (!rg_interpolates)
        record = rg_program_record(rg, rg.p.draw, rg.p.program, rg_item_drawn);
    rg_fragment f = rg_drawn_fragment(rg, rg.p.program, record, x, y);
    if (f.kept == 0)
        discard;
    if (rg.p.draw.counted != 0 && !rg_counts(rg, x, y, f.depth))
        discard;
    rg_colour = vec4(f.colour.r, f.colour.g, f.colour.b, f.colour.a);
#if !defined(RG_DEPTH_OF_CORNERS)
    gl_FragDepth = f.depth;
#endif
}
