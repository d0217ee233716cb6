#include "tests/oracle/drops/merge.h"

#include "tests/oracle/drops/map.h"
#include "tests/oracle/drops/particles.h"

// Gives another ID to the cells of two IDs that are connected with a cell, through their sides.
static void fill(struct oracle_drops *o, int cell, uint32_t a, uint32_t b, uint32_t to)
{
    const int columns = o->settings.columns, rows = o->settings.rows;
    int depth = 0;
    o->id[cell] = to;
    o->stack[depth++] = cell;
    while (depth) {
        const int at = o->stack[--depth], row = at / columns, column = at % columns;
        const int beside[4] = {column > 0 ? at - 1 : at, column < columns - 1 ? at + 1 : at,
                               row > 0 ? at - columns : at, row < rows - 1 ? at + columns : at};
        for (int i = 0; i < 4; i++) {
            const uint32_t id = o->id[beside[i]];
            if (id == to || (id != a && id != b))
                continue;
            o->id[beside[i]] = to;
            o->stack[depth++] = beside[i];
        }
    }
}

// Makes one drop of two. Returns its ID.
static uint32_t unite(struct oracle_drops *o, struct oracle_drop *a, struct oracle_drop *b)
{
    const uint32_t parents[2] = {a->id, b->id};
    const bool b_lower = b->y_mm < a->y_mm || (b->y_mm == a->y_mm && b->id < a->id);
    const struct oracle_drop *lower = b_lower ? b : a;
    const double mass = a->mass_mg + b->mass_mg;
    const struct oracle_drop united = {
        .x_mm = lower->x_mm,
        .y_mm = lower->y_mm,
        .vx_mm_s = (a->mass_mg * a->vx_mm_s + b->mass_mg * b->vx_mm_s) / mass,
        .vy_mm_s = (a->mass_mg * a->vy_mm_s + b->mass_mg * b->vy_mm_s) / mass,
        .mass_mg = mass,
    };
    oracle_drops_end(o, a);
    oracle_drops_end(o, b);
    const uint32_t id = oracle_drops_insert(o, united);
    for (int i = 0; i < o->count; i++)
        if (o->drops[i].parent_id == parents[0] || o->drops[i].parent_id == parents[1])
            o->drops[i].parent_id = id;
    o->ledger.merges++;
    return id;
}

static void meet(struct oracle_drops *o, int cell, int neighbour)
{
    const uint32_t a = o->id[cell], b = o->id[neighbour];
    struct oracle_drop *first = oracle_drops_find(o, a), *second = oracle_drops_find(o, b);
    if (first && second) {
        if (first->parent_id == b || second->parent_id == a)
            return;
        const uint32_t id = unite(o, first, second);
        fill(o, cell, a, b, id);
        const struct oracle_drop *drop = oracle_drops_find(o, id);
        oracle_drops_place(o, id, drop->x_mm, drop->y_mm, drop->mass_mg);
    } else if (first || (!second && a < b)) {
        fill(o, neighbour, b, b, a);
    } else {
        fill(o, cell, a, a, b);
    }
}

// Whether a row has different neighbours: most rows have none, and this scan is quick.
static bool any_meet(const uint32_t *row, const uint32_t *below, int begin, int end)
{
    uint32_t any = 0;
    for (int j = begin; j < end; j++) {
        const uint32_t own = row[j], right = row[j + 1], down = below[j];
        any |= (own != 0) & (((right != 0) & (right != own)) | ((down != 0) & (down != own)));
    }
    const uint32_t down = below[end];
    return any || (row[end] && down && down != row[end]);
}

static void merge_row(struct oracle_drops *o, int row)
{
    const int columns = o->settings.columns, rows = o->settings.rows;
    for (int j = 0; j < columns; j++) {
        const int cell = row * columns + j;
        if (!o->id[cell])
            continue;
        if (j + 1 < columns && o->id[cell + 1] && o->id[cell + 1] != o->id[cell])
            meet(o, cell, cell + 1);
        if (row + 1 < rows && o->id[cell + columns] && o->id[cell + columns] != o->id[cell])
            meet(o, cell, cell + columns);
    }
}

void oracle_drops_merge(struct oracle_drops *o)
{
    for (int i = o->wet.row0; i < o->wet.row1; i++) {
        const uint32_t *row = &o->id[i * o->settings.columns];
        const uint32_t *below = i + 1 < o->settings.rows ? row + o->settings.columns : row;
        if (any_meet(row, below, 0, o->settings.columns - 1))
            merge_row(o, i);
    }
}
