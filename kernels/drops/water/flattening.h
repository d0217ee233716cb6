// A pass over the water. Drops at rest put their water back. The water flattens by a blur; below a
// least height none is left (section 4.2). IDs spread by a cell, as water may (section 4.3). Trails
// thin: runs of wet cells lose one at either side (section 4.2; simplified, as in the paper's
// program). By the paper's rules a step has one pass. A pass writes into other maps than it reads.
//
// Heights are whole steps of a quarter of a micrometre, so that water comes to rest instead of
// nearing rest for ever. A tile sleeps while no pass, and nothing around it, changes it: both maps
// then have the same in it.
//
// For kernels with the slots of flatten.h and a macro LEFT_OF: what is left of a cell's water after
// it has thinned.
#ifndef RG_KERNELS_DROPS_WATER_FLATTENING_H
#define RG_KERNELS_DROPS_WATER_FLATTENING_H

#include "kernels/drops/tiles/stir.h"

// Trails thin across the way that water runs. `across` is the distance, in cells of a map, to the
// next cell across that way, and `along` that to the next one down.
RG_STRUCT(ways)
{
    int across;
    int along;
};
RG_STRUCT_SIZE(ways, 2)

// A cell's place on the pane, as masks: at its ends across, which have no neighbour, or next to
// them; at its ends along; or beyond the pane.
RG_STRUCT(ends)
{
    uint is_first;
    uint is_second;      // or first
    uint is_second_last; // or last
    uint is_last;
    uint is_top;
    uint is_bottom;
    uint is_beyond;
};
RG_STRUCT_SIZE(ends, 7)

RG_FN uint owner_at(rg_ctx rg, int cell)
{
    uint id = ids_at(rg, cell);
    uint still_id = still_ids_at(rg, cell);
    uint is_still = mask_of(still_at(rg, cell) > height_at(rg, cell));
    return drops_owner((still_id & is_still) | (id & ~is_still));
}

// The height blurred along the way; beyond the pane's edge the last cell repeats.
RG_FN float along_at(rg_ctx rg, ends at, int along, int cell)
{
    float h = wet_at(rg, cell);
    float above = either(at.is_top, h, wet_at(rg, cell - along));
    float below = either(at.is_bottom, h, wet_at(rg, cell + along));
    return h + (above + below - 2.0f * h) * 0.33333334f;
}

// Three columns blurred across the way as well; `was` if water does not flatten.
RG_FN float flattened(drops_params p, float left, float middle, float right, float was)
{
    float h = middle + (left + right - 2.0f * middle) * 0.33333334f;
    return either(rg_to_uint(-p.does_smooth), h, was);
}

// Rounds to whole steps; 0 below p.dry_mm.
RG_FN float rounded(drops_params p, float h)
{
    float whole = rg_floor(h * DROPS_HEIGHTS_A_MM + 0.5f) * (1.0f / DROPS_HEIGHTS_A_MM);
    float kept = either(rg_to_uint(-p.does_smooth), whole, h);
    return h < p.dry_mm ? 0.0f : kept;
}

RG_FN float thinned(rg_ctx rg, drops_params p, ends at, ways w, int cell)
{
    float far_left = along_at(rg, at, w.along, cell - 2 * w.across);
    float left = along_at(rg, at, w.along, cell - w.across);
    float middle = along_at(rg, at, w.along, cell);
    float right = along_at(rg, at, w.along, cell + w.across);
    float far_right = along_at(rg, at, w.along, cell + 2 * w.across);
    float was_left = wet_at(rg, cell - w.across);
    float was = wet_at(rg, cell);
    float was_right = wet_at(rg, cell + w.across);
    float before = either(at.is_second, left, far_left);
    float after = either(at.is_second_last, right, far_right);
    float beside_left = either(at.is_first, middle, left);
    float beside_right = either(at.is_last, middle, right);
    float here = rounded(p, flattened(p, beside_left, middle, beside_right, was));
    float at_left = flattened(p, before, left, middle, was_left);
    float at_right = flattened(p, middle, right, after, was_right);
    // Beyond the pane there is no bank.
    uint has_left = mask_of(at_left < p.dry_mm) & ~at.is_first;
    uint has_right = mask_of(at_right < p.dry_mm) & ~at.is_last;
    return either((has_left | has_right) & rg_to_uint(-p.does_erode), 0.0f, here);
}

// The first that is not 0.
RG_FN uint or_else(uint first, uint second, uint third)
{
    uint two = first | (second & mask_of(first == 0u));
    return two | (third & mask_of(two == 0u));
}

// The owner that spreads to a cell, as in two passes over the cells without one. The first takes it
// from below, else from the right. The second, after that, takes it from above, else from the left.
RG_FN uint owner_around(rg_ctx rg, drops_params p, int cell)
{
    int down = p.down_cell;
    int right = p.right_cell;
    uint own = owner_at(rg, cell);
    uint above = owner_at(rg, cell - down);
    uint above_right = owner_at(rg, cell - down + right);
    uint left = owner_at(rg, cell - right);
    uint left_below = owner_at(rg, cell - right + down);
    uint here = or_else(own, owner_at(rg, cell + down), owner_at(rg, cell + right));
    return or_else(here, or_else(above, own, above_right), or_else(left, left_below, own));
}

RG_FN ways ways_of(drops_params p)
{
    ways w;
    w.across = (p.is_upright != 0 ? 1 : p.stride) * p.apart;
    w.along = (p.is_upright != 0 ? p.stride : 1) * p.apart;
    return w;
}

// All bits if a is below b, else none: by arithmetic, so that no compiler makes a branch of it.
RG_FN uint below(int a, int b)
{
    return rg_to_uint((a - b) >> 31);
}

RG_FN ends ends_of(drops_params p, int column, int row)
{
    int across = p.is_upright != 0 ? column : row;
    int last = (p.is_upright != 0 ? p.columns : p.rows) - 1;
    int down = p.is_upright != 0 ? row : column;
    int lowest = (p.is_upright != 0 ? p.rows : p.columns) - 1;
    ends e;
    e.is_first = below(across, p.apart);
    e.is_second = below(across, drops_reach(p));
    e.is_second_last = below(last - drops_reach(p), across);
    e.is_last = below(last - p.apart, across);
    e.is_top = below(down, p.apart);
    e.is_bottom = below(lowest - p.apart, down);
    e.is_beyond = below(p.columns - 1, column) | below(p.rows - 1, row);
    return e;
}

RG_FN ends all_ends(uint mask)
{
    ends e;
    e.is_first = mask;
    e.is_second = mask;
    e.is_second_last = mask;
    e.is_last = mask;
    e.is_top = mask;
    e.is_bottom = mask;
    e.is_beyond = mask;
    return e;
}

// The changes of a row's cells, as bits: anywhere, near its left end, and near its right end; and
// whether it has water without an owner.
RG_STRUCT(changes)
{
    uint any;
    uint at_left;
    uint at_right;
    uint unowned;
};
RG_STRUCT_SIZE(changes, 4)

RG_FN changes no_changes(uint none)
{
    changes c;
    c.any = none;
    c.at_left = none;
    c.at_right = none;
    c.unowned = none;
    return c;
}

RG_FN changes changed(drops_params p, changes was, int i, uint change)
{
    changes c = was;
    c.any = was.any | change;
    c.at_left = was.at_left | (i < drops_reach(p) ? change : 0u);
    c.at_right = was.at_right | (i >= DROPS_TILE_COLUMNS - drops_reach(p) ? change : 0u);
    return c;
}

// Makes a cell of the next maps, the i-th of its row.
RG_FN changes renewed(rg_ctx rg, drops_params p, changes was, ends at, ways w, int first, int i)
{
    int cell = first + i;
    float h = either(at.is_beyond, 0.0f, LEFT_OF(rg, cell, thinned(rg, p, at, w, cell)));
    uint own = owner_at(rg, cell);
    uint id = h >= p.owned_mm ? own : 0u;
    next_height_put(rg, cell, h);
    next_ids_put(rg, cell, id);
    changes c = was;
    c.unowned = c.unowned | (h >= p.owned_mm ? mask_of(own == 0u) : 0u);
    uint height_change = rg_float_bits(h) ^ rg_float_bits(height_at(rg, cell));
    return changed(p, c, i, height_change | (id ^ ids_at(rg, cell)));
}

// Renews a row of any tile; below, of a tile that lies well inside the pane, which is less work.
RG_FN changes row_at_ends(rg_ctx rg, drops_params p, int left, int row)
{
    int first = drops_cell(p, left, row);
    ways w = ways_of(p);
    changes c = no_changes(0u);
    RG_APART
    for (int i = 0; i < DROPS_TILE_COLUMNS; i++)
        c = renewed(rg, p, c, ends_of(p, left + i, row), w, first, i);
    return c;
}

RG_FN changes row_inside(rg_ctx rg, drops_params p, int left, int row)
{
    int first = drops_cell(p, left, row);
    ways w = ways_of(p);
    changes c = no_changes(0u);
    RG_APART
    for (int i = 0; i < DROPS_TILE_COLUMNS; i++)
        c = renewed(rg, p, c, all_ends(0u), w, first, i);
    return c;
}

// Water without an owner gets that of a cell beside it. Most rows have none.
RG_FN changes spread(rg_ctx rg, drops_params p, changes was, int first)
{
    changes c = was;
    RG_APART
    for (int i = 0; i < DROPS_TILE_COLUMNS; i++) {
        int cell = first + i;
        uint around = owner_around(rg, p, cell);
        uint had = next_ids_at(rg, cell);
        uint id = next_height_at(rg, cell) >= p.owned_mm ? around : 0u;
        next_ids_put(rg, cell, id);
        c = changed(p, c, i, id ^ had);
    }
    return c;
}

RG_FN bool is_inside(drops_params p, int left, int row)
{
    int reach = drops_reach(p);
    return row >= reach && row < p.rows - reach && left >= reach &&
           left + DROPS_TILE_COLUMNS <= p.columns - reach;
}

// Of the row of a tile that the item stands for.
RG_PROC void flatten(rg_ctx rg, drops_params p, int x, int y)
{
    int row = drops_row_of(p, y);
    int left = x * DROPS_TILE_COLUMNS;
    if (!is_awake_at(rg, p, left, row))
        return;
    changes c =
        is_inside(p, left, row) ? row_inside(rg, p, left, row) : row_at_ends(rg, p, left, row);
    if (c.unowned != 0u && p.does_spread != 0)
        c = spread(rg, p, c, drops_cell(p, left, row));
    if (c.any == 0u)
        return;
    int last = left + DROPS_TILE_COLUMNS - 1;
    mark_row(rg, p, row, c.at_left != 0u ? left : left + drops_reach(p),
             c.at_right != 0u ? last : last - drops_reach(p), DROPS_STIRRED);
}

#endif
