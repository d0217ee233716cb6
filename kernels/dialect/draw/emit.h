// The second stage of packing: writes a chunk's primitives to their places, in the order of the
// items. Included after a DRAW program. rg_draw_args gets the arguments of an indirect draw:
// vertices, instances, first vertex, first instance; then the number of primitives.
//
// Whole items and clipped items have a loop each, because software drivers run a loop's body for
// all items side by side, even if no item enters it.

RG_FN rg_prim rg_prim_of(rg_ctx rg, rg_draw_call p, rg_snapped corners, int i)
{
    rg_prim prim;
    prim.corners = corners;
    prim.item = i;
    prim.record = rg_program_record(rg, p.draw, p.program, i);
    return prim;
}

RG_FN rg_item rg_closed_item(rg_ctx rg, rg_draw_call p, int i)
{
    return rg_item_closed(rg_program_item(rg, p.draw, p.program, i), RG_CORNERS);
}

// A clipped item fills all the room that was left for it; primitives that it does not need have no
// area.
RG_PROC void rg_put_clipped(rg_ctx rg, rg_draw_call p, int place, int i)
{
    rg_polygon g = rg_clip(p.draw, rg_closed_item(rg, p, i), RG_CORNERS, RG_FATE_CLIP);
    for (int k = 0; k < RG_MOST_PRIMS(RG_CORNERS); k++)
        rg_prims_put(rg, place + k,
                     rg_prim_of(rg, p, rg_polygon_prim(p.draw, g, RG_CORNERS, k), i));
}

RG_GRID_KERNEL(draw_emit)
{
    int begin = p.draw.item_begin + x * RG_DRAW_CHUNK;
    int first = rg_to_int(rg_before_at(rg, x));
    uint whole = rg_fates_at(rg, 2 * x);
    uint clipped = rg_fates_at(rg, 2 * x + 1);
    for (uint left = whole; left != 0u; left = left & (left - 1u)) {
        uint earlier = rg_bits_below(left);
        int i = begin + rg_ones(earlier);
        int place = first + rg_chunk_prims(whole & earlier, clipped & earlier, RG_CORNERS);
        rg_projected s = rg_project(p.draw, rg_closed_item(rg, p, i));
        rg_prims_put(rg, place, rg_prim_of(rg, p, s.corners, i));
    }
    for (uint left = clipped; left != 0u; left = left & (left - 1u)) {
        uint earlier = rg_bits_below(left);
        int place = first + rg_chunk_prims(whole & earlier, clipped & earlier, RG_CORNERS);
        rg_put_clipped(rg, p, place, begin + rg_ones(earlier));
    }
    if (begin + RG_DRAW_CHUNK >= p.draw.item_end) {
        int prims = first + rg_chunk_prims(whole, clipped, RG_CORNERS);
        rg_draw_args_put(rg, 0, rg_to_uint(prims * (RG_CORNERS == 3 ? 3 : 6)));
        rg_draw_args_put(rg, 1, 1u);
        rg_draw_args_put(rg, 2, 0u);
        rg_draw_args_put(rg, 3, 0u);
        rg_draw_args_put(rg, 4, rg_to_uint(prims));
    }
}
