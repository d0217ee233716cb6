// The first stage of packing: the fates of a chunk's items, and the primitives to leave room for.
// Included after a DRAW program.

RG_GRID_KERNEL(draw_count)
{
    int begin = p.draw.item_begin + x * RG_DRAW_CHUNK;
    int end = rg_imin(begin + RG_DRAW_CHUNK, p.draw.item_end);
    uint whole = 0u;
    uint clipped = 0u;
    for (int i = begin; i < end; i++) {
        rg_item t = rg_item_closed(rg_program_item(rg, p.draw, p.program, i), RG_CORNERS);
        rg_projected s = rg_project(p.draw, t);
        uint bit = 1u << rg_to_uint(i - begin);
        whole |= s.fate == RG_FATE_WHOLE ? bit : 0u;
        clipped |= s.fate == RG_FATE_CLIP ? bit : 0u;
    }
    rg_fates_put(rg, 2 * x, whole);
    rg_fates_put(rg, 2 * x + 1, clipped);
    rg_counts_put(rg, x, rg_to_uint(rg_chunk_prims(whole, clipped, RG_CORNERS)));
}
