// The second stage of packing: a chunk's primitives, each at its place, in the order of the items.
// Included behind a DRAW program. rg_draw_args becomes what an indirect draw takes: vertices,
// instances, first vertex, first instance; then the number of primitives.

RG_FN rg_prim rg_prim_of(rg_ctx rg, rg_draw_call p, rg_snapped corners, int i)
{
    rg_prim prim;
    prim.corners = corners;
    prim.item = i;
    prim.record = rg_program_record(rg, p.draw, p.program, i);
    return prim;
}

// Packs an item that is alive; returns the place behind its primitives.
RG_FN int rg_emit(rg_ctx rg, rg_draw_call p, int i, int first_place)
{
    int place = first_place;
    rg_item t = rg_item_closed(rg_program_item(rg, p.draw, p.program, i), RG_CORNERS);
    rg_projected s = rg_project(p.draw, t);
    if (s.fate == RG_FATE_WHOLE) {
        rg_prims_put(rg, place, rg_prim_of(rg, p, s.corners, i));
        place++;
    }
    for (int clip = s.fate; clip == RG_FATE_CLIP; clip = RG_FATE_DEAD) {
        rg_polygon g = rg_clip(p.draw, t, RG_CORNERS, RG_FATE_CLIP);
        int prims = rg_polygon_prims(g, RG_CORNERS);
        for (int k = 0; k < prims; k++) {
            rg_prims_put(rg, place,
                         rg_prim_of(rg, p, rg_polygon_prim(p.draw, g, RG_CORNERS, k), i));
            place++;
        }
    }
    return place;
}

RG_GRID_KERNEL(draw_emit)
{
    int begin = p.draw.item_begin + x * RG_DRAW_CHUNK;
    int end = rg_imin(begin + RG_DRAW_CHUNK, p.draw.item_end);
    int place = rg_to_int(rg_before_at(rg, x));
    uint first = rg_alive_at(rg, 2 * x);
    uint second = rg_alive_at(rg, 2 * x + 1);
    for (int i = (first | second) == 0u ? end : begin; i < end; i++) {
        uint alive = (i - begin < 32 ? first : second) >> ((i - begin) & 31);
        if ((alive & 1u) != 0u)
            place = rg_emit(rg, p, i, place);
    }
    if (end == p.draw.item_end) {
        rg_draw_args_put(rg, 0, rg_to_uint(place * (RG_CORNERS == 3 ? 3 : 6)));
        rg_draw_args_put(rg, 1, 1u);
        rg_draw_args_put(rg, 2, 0u);
        rg_draw_args_put(rg, 3, 0u);
        rg_draw_args_put(rg, 4, rg_to_uint(place));
    }
}
