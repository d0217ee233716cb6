// The item and record of a pane, from the slot panes of the program that includes this file.
#ifndef RG_KERNELS_FLOW_PANES_ITEM_H
#define RG_KERNELS_FLOW_PANES_ITEM_H

// The corner of a pane at (right, down), each -1 or 1.
RG_FN rg_corner pane_corner(m4 to_clip, flow_pane q, float right, float down)
{
    return m4_project(to_clip, v3_add(q.n, v3_add(v3_scale(q.t, right), v3_scale(q.b, down))));
}

// The corners run counter-clockwise on the screen if the pane is seen from outside.
RG_FN rg_item pane_item(rg_ctx rg, m4 to_clip, int i)
{
    flow_pane q = panes_at(rg, i);
    rg_item t;
    t.alive = 1;
    t.a = pane_corner(to_clip, q, -1.0f, -1.0f);
    t.b = pane_corner(to_clip, q, -1.0f, 1.0f);
    t.c = pane_corner(to_clip, q, 1.0f, 1.0f);
    t.d = pane_corner(to_clip, q, 1.0f, -1.0f);
    return t;
}

RG_FN flow_pane_record pane_record(rg_ctx rg, rg_draw_state draw, flow_view_params p, int i)
{
    rg_item corners = pane_item(rg, p.to_clip, i);
    float turn = rg_turn(corners);
    rg_item spanned = corners;
    spanned.b = corners.d;
    spanned.c = corners.b;
    flow_pane q = panes_at(rg, i);
    flow_pane_record r;
    r.planes = rg_planes_of(draw, spanned);
    r.first = flow_pane_index(p.size, i, 0, 0);
    r.facing = turn < 0.0f ? 1.0f : -1.0f;
    r.t = q.t;
    r.b = q.b;
    r.n = q.n;
    return r;
}

#endif
