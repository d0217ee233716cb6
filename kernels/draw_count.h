// The first stage of packing: the primitives of a chunk of items, and which of the items are alive.
// Included behind a DRAW program.

// The primitives of a chunk's items that have to be clipped: few, so they get a loop of their own.
RG_FN int rg_clipped_prims(rg_ctx rg, rg_draw_call p, int begin, int end)
{
    int prims = 0;
    for (int i = begin; i < end; i++) {
        rg_item t = rg_item_closed(rg_program_item(rg, p.draw, p.program, i), RG_CORNERS);
        int fate = rg_project(p.draw, t).fate;
        for (int clip = fate; clip == RG_FATE_CLIP; clip = RG_FATE_DEAD)
            prims += rg_polygon_prims(rg_clip(p.draw, t, RG_CORNERS, RG_FATE_CLIP), RG_CORNERS);
    }
    return prims;
}

RG_GRID_KERNEL(draw_count)
{
    int begin = p.draw.item_begin + x * RG_DRAW_CHUNK;
    int end = rg_imin(begin + RG_DRAW_CHUNK, p.draw.item_end);
    int prims = 0;
    int clipped = 0;
    uint first = 0u;
    uint second = 0u;
    // Straight on, without branches: compilers run several items side by side.
    for (int i = begin; i < end; i++) {
        rg_item t = rg_item_closed(rg_program_item(rg, p.draw, p.program, i), RG_CORNERS);
        int fate = rg_project(p.draw, t).fate;
        uint bit = (fate == RG_FATE_DEAD ? 0u : 1u) << ((i - begin) & 31);
        first |= i - begin < 32 ? bit : 0u;
        second |= i - begin < 32 ? 0u : bit;
        prims += fate == RG_FATE_WHOLE ? 1 : 0;
        clipped += fate == RG_FATE_CLIP ? 1 : 0;
    }
    if (clipped > 0)
        prims += rg_clipped_prims(rg, p, begin, end);
    rg_counts_put(rg, x, rg_to_uint(prims));
    rg_alive_put(rg, 2 * x, first);
    rg_alive_put(rg, 2 * x + 1, second);
}
