// The fragment stage of a DRAW program, whose inputs are the packed record and the pixel's place.
#define RG_STAGE_FRAGMENT 1
#include "kernels/dialect/rounding.h"
#include RG_KERNEL_HEADER
#include "kernels/dialect/draw/lit.h"
#include "kernels/dialect/draw/blend.h"

layout(std140, binding = 0) uniform rg_run_block
{
    ivec4 origin;
    ivec4 end;
    RG_RUN_PARAMS params;
} rg_run;

layout(location = 0) flat in int rg_prim_index;
RG_COLOUR(rg_colour)

// Counts a visible sample, against a depth that this draw does not write.
bool rg_counts(rg_ctx rg, int item, int x, int y, float depth)
{
    bool visible = rg_run.params.draw.depth_mode == 0 || depth < rg_behind_texel(rg, x, y, 0, 0).r;
    if (visible)
        rg_samples_add(rg, item, 1u);
    return visible;
}

void main()
{
    rg_ctx rg;
    rg.p = rg_run.params;
    int x = int(gl_FragCoord.x);
    int y = int(gl_FragCoord.y);
    RG_RECORD record = rg_prims_at(rg, rg_prim_index).record;
    rg_fragment f = rg_drawn_fragment(rg, rg.p.program, record, x, y);
    if (f.kept == 0)
        discard;
    if (rg.p.draw.counted != 0 &&
        !rg_counts(rg, rg_prims_at(rg, rg_prim_index).item, x, y, f.depth))
        discard;
    rgba c = rg_drawn(rg.p.draw, f.colour);
    c = RG_BLENDED(rg.p.draw, c, rg_colour);
    rg_colour = vec4(c.r, c.g, c.b, c.a);
    gl_FragDepth = f.depth;
}
