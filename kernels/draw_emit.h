// The second stage of packing: a chunk's primitives, each at its place, in the order of the items.
// Included behind a DRAW program. rg_draw_args becomes what an indirect draw takes: vertices,
// instances, first vertex, first instance; then the number of primitives.

RG_FN rg_prim rg_prim_of(rg_snapped corners, int item, RG_RECORD record)
{
    rg_prim prim;
    prim.corners = corners;
    prim.item = item;
    prim.record = record;
    return prim;
}

RG_GRID_KERNEL(draw_emit)
{
    int begin = p.draw.item_begin + x * RG_DRAW_CHUNK;
    int place = rg_to_int(rg_before_at(rg, x));
    for (uint left = rg_alive_at(rg, x); left != 0u; left &= left - 1u) {
        int i = begin + rg_lowest_bit(left);
        rg_item t = rg_item_closed(rg_program_item(rg, p.draw, p.program, i), RG_CORNERS);
        rg_projected s = rg_project(p.draw, t);
        RG_RECORD record = rg_program_record(rg, p.draw, p.program, i);
        if (s.fate == RG_FATE_WHOLE) {
            rg_prims_put(rg, place, rg_prim_of(s.corners, i, record));
            place++;
        }
        // For the few that are clipped: a loop that no other item enters.
        for (int clip = s.fate; clip == RG_FATE_CLIP; clip = RG_FATE_DEAD) {
            rg_polygon g = rg_clip(p.draw, t, RG_CORNERS, RG_FATE_CLIP);
            int prims = rg_polygon_prims(g, RG_CORNERS);
            for (int k = 0; k < prims; k++)
                rg_prims_put(rg, place + k,
                             rg_prim_of(rg_polygon_prim(p.draw, g, RG_CORNERS, k), i, record));
            place += prims;
        }
    }
    if (begin + RG_DRAW_CHUNK >= p.draw.item_end) {
        rg_draw_args_put(rg, 0, rg_to_uint(place * (RG_CORNERS == 3 ? 3 : 6)));
        rg_draw_args_put(rg, 1, 1u);
        rg_draw_args_put(rg, 2, 0u);
        rg_draw_args_put(rg, 3, 0u);
        rg_draw_args_put(rg, 4, rg_to_uint(place));
    }
}
