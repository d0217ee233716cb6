// The first stage of packing: which items of a chunk are seen, and how many primitives they become.
// Included behind a DRAW program.
//
// What few items need stands in a loop of its own behind the one over all: drivers on the CPU run
// the inside of a branch or a loop, masked, for items that do not enter it too.

RG_GRID_KERNEL(draw_count)
{
    int begin = p.draw.item_begin + x * RG_DRAW_CHUNK;
    int end = rg_imin(begin + RG_DRAW_CHUNK, p.draw.item_end);
    int prims = 0;
    uint alive = 0u;
    uint clipped = 0u;
    for (int i = begin; i < end; i++) {
        rg_item t = rg_item_closed(rg_program_item(rg, p.draw, p.program, i), RG_CORNERS);
        int fate = rg_project(p.draw, t).fate;
        uint bit = 1u << rg_to_uint(i - begin);
        prims += fate == RG_FATE_WHOLE ? 1 : 0;
        alive |= fate != RG_FATE_DEAD ? bit : 0u;
        clipped |= fate == RG_FATE_CLIP ? bit : 0u;
    }
    for (uint left = clipped; left != 0u; left &= left - 1u) {
        int i = begin + rg_lowest_bit(left);
        rg_item t = rg_item_closed(rg_program_item(rg, p.draw, p.program, i), RG_CORNERS);
        prims += rg_polygon_prims(rg_clip(p.draw, t, RG_CORNERS, RG_FATE_CLIP), RG_CORNERS);
    }
    rg_counts_put(rg, x, rg_to_uint(prims));
    rg_alive_put(rg, x, alive);
}
