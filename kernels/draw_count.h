// The first stage of packing: the primitives of a chunk of items. Included behind a DRAW program.

RG_GRID_KERNEL(draw_count)
{
    int begin = p.draw.item_begin + x * RG_DRAW_CHUNK;
    int end = rg_imin(begin + RG_DRAW_CHUNK, p.draw.item_end);
    int prims = 0;
    for (int i = begin; i < end; i++) {
        rg_item t = rg_item_closed(rg_program_item(rg, p.draw, p.program, i), RG_CORNERS);
        rg_projected s = rg_project(p.draw, t);
        prims += s.fate == RG_FATE_WHOLE ? 1 : 0;
        // For the few that are clipped: a loop that no other item enters.
        for (int clip = s.fate; clip == RG_FATE_CLIP; clip = RG_FATE_DEAD)
            prims += rg_polygon_prims(rg_clip(p.draw, t, RG_CORNERS, RG_FATE_CLIP), RG_CORNERS);
    }
    rg_counts_put(rg, x, rg_to_uint(prims));
}
