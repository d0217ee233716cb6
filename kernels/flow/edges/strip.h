// The strips along a pane's edges that water crosses in a step: FLOW_MARGIN rows or columns on each
// side.
#ifndef RG_KERNELS_FLOW_EDGES_STRIP_H
#define RG_KERNELS_FLOW_EDGES_STRIP_H

#include "kernels/flow/water/water.h"

RG_STRUCT(flow_texel)
{
    int x;
    int y;
};

// Texel i of strip s, 0 <= s < FLOW_STRIPS; x is -1 if there is none. Rows come first, near and far
// edge in turn; columns leave the corners to them. Panes are at least 4 FLOW_MARGIN wide.
RG_FN flow_texel flow_strip_texel(int size, int i, int s)
{
    int row = s < 2 * FLOW_MARGIN ? 1 : 0;
    int depth = (s >> 1) & (FLOW_MARGIN - 1);
    int across = (s & 1) == 0 ? depth : size - 1 - depth;
    flow_texel t;
    t.x = row != 0 ? i : across;
    t.y = row != 0 ? across : i;
    if (row == 0 && (i < FLOW_MARGIN || i >= size - FLOW_MARGIN))
        t.x = -1;
    return t;
}

// The texel by which water enters a pane, for its place `along` the edge that it left, and `beyond`
// whole texels past it.
RG_FN flow_texel flow_enter(int size, flow_neighbour over, int along, int beyond)
{
    int s = over.turned != 0 ? size - 1 - along : along;
    int across = (over.side & 1) == 0 ? beyond : size - 1 - beyond;
    flow_texel t;
    t.x = over.side < 2 ? s : across;
    t.y = over.side < 2 ? across : s;
    return t;
}

#endif
