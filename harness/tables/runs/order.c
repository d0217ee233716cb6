#include "harness/tables/runs/order.h"

#include <math.h>
#include <string.h>

#include "harness/tables/measuring/cell.h"
#include "harness/tables/runs/needed.h"

const struct rg_turn_row rg_turns[RG_TURNS] = {
    [RG_TURN_FIRST] = {"the first rows of each table", false, false},
    [RG_TURN_NEEDED] = {"the other rows that are needed", false, false},
    [RG_TURN_CLAIMED] = {"the other devices of tables that claims are about", true, true},
    [RG_TURN_DEVICES] = {"the other devices", true, true},
    [RG_TURN_BETTER] = {"larger pictures and more samples", false, true},
    [RG_TURN_ROWS] = {"all rows", false, false},
    [RG_TURN_VARIANTS] = {"all variants", false, true},
    [RG_TURN_WORKS] = {"all works", false, true},
    [RG_TURN_LAST] = {"cpu:reference", true, true},
};

struct rg_standing rg_standing_of(const struct rg_table *table)
{
    bool rows[RG_TABLE_ROWS], variants[RG_TABLE_VARIANTS];
    struct rg_standing s = {
        .table = table,
        .has_claims = rg_has_claims(table),
        .needed_rows = rg_needed_rows(table, rows),
        .quick_rows = rg_quick_rows(table, rows),
        .needed_variants = rg_needed_variants(table, variants),
        .share = {.divisor = rg_most_divisor(table), .all_samples = table->is_of_textures}};
    while (s.variants < RG_TABLE_VARIANTS && table->variants[s.variants].name)
        s.variants++;
    while (s.works < RG_TABLE_WORKS && table->works[s.works].name)
        s.works++;
    s.works += !s.works;
    return s;
}

// --- times of cells ---

static bool are_alike(const struct rg_standing *a, const struct rg_standing *b)
{
    return !strcmp(a->table->technique, b->table->technique) &&
           a->table->is_of_textures == b->table->is_of_textures;
}

// Estimates a cell's time on a device from the first of these that exist; 0: unknown. First the
// table's own cells there. Then other tables of the technique, scaled by a device on which both
// were measured. Then the table's cells on another device, which may be too little. Last other
// tables of the technique on this device.
static double cell_s(const struct rg_order *order, int table, int device)
{
    const struct rg_standing *own = &order->tables[table];
    double elsewhere_s = 0, alike_s = 0, scaled_s = 0;
    for (int d = RG_MAX_DEVICES - 1; d >= 0; d--)
        elsewhere_s = own->cell_s[d] > 0 ? own->cell_s[d] : elsewhere_s;
    for (int i = 0; i < order->count; i++) {
        const struct rg_standing *other = &order->tables[i];
        if (!are_alike(own, other) || !(other->cell_s[device] > 0))
            continue;
        alike_s = other->cell_s[device];
        for (int d = 0; d < RG_MAX_DEVICES; d++)
            if (other->cell_s[d] > 0)
                scaled_s = fmax(scaled_s, own->cell_s[d] * alike_s / other->cell_s[d]);
    }
    return own->cell_s[device] > 0 ? own->cell_s[device]
           : scaled_s > 0          ? scaled_s
           : elsewhere_s > 0       ? elsewhere_s
                                   : alike_s;
}

static double expect(const struct rg_order *order, const struct rg_step *step, int cells)
{
    double s = 0;
    for (int d = 0; d < RG_MAX_DEVICES; d++)
        if (step->devices >> d & 1)
            s += cells * cell_s(order, step->table, d);
    return s;
}

void rg_order_learn(struct rg_order *order, const struct rg_step *step, int cells, double seconds)
{
    const double expected_s = expect(order, step, cells);
    const double even_s = seconds / (cells * __builtin_popcount(step->devices));
    for (int d = 0; d < RG_MAX_DEVICES; d++)
        if (step->devices >> d & 1)
            order->tables[step->table].cell_s[d] =
                expected_s > 0 ? cell_s(order, step->table, d) * seconds / expected_s : even_s;
}

// --- the next step ---

// Whether a turn adds anything to a table; fills in the step's share and cells.
static bool grow(const struct rg_standing *s, struct rg_step *step)
{
    const enum rg_turn turn = step->turn;
    const int works = s->share.all_works ? s->works : 1;
    const int variants = s->share.all_variants ? s->variants : s->needed_variants;
    step->share = s->share;
    step->share.devices |= step->devices;
    step->share.all_samples |= turn == RG_TURN_BETTER;
    step->share.all_variants |= turn == RG_TURN_VARIANTS;
    step->share.all_works |= turn == RG_TURN_WORKS;
    step->share.divisor = turn == RG_TURN_BETTER ? 1 : s->share.divisor;
    step->cells = (rg_turns[turn].is_whole ? s->rows : 1) *
                  (turn == RG_TURN_VARIANTS ? s->variants - variants : variants) *
                  (turn == RG_TURN_WORKS ? s->works - works : works);
    const bool adds = turn == RG_TURN_NEEDED    ? s->rows < s->needed_rows
                      : turn == RG_TURN_CLAIMED ? s->has_claims
                      : turn == RG_TURN_BETTER  ? !s->table->is_of_textures
                      : turn == RG_TURN_ROWS    ? s->rows < s->quick_rows
                                                : step->cells > 0;
    return adds && (turn == RG_TURN_FIRST) == !s->rows;
}

static int waiting(const struct rg_order *order, enum rg_turn turn)
{
    int tables = 0;
    for (int i = 0; i < order->count; i++)
        tables += !order->tables[i].tried[turn];
    return tables;
}

// Chooses full pictures, or half their size if they would take more than the table's part of the
// time. Larger pictures take longer by at most the ratio of their pixels, and all samples of quick
// mode take twice as long as the fewest.
static void choose_size(const struct rg_order *order, double left_s, struct rg_step *step)
{
    const struct rg_share *before = &order->tables[step->table].share;
    const double side = before->divisor, samples = before->all_samples ? 1 : 2;
    const double now_s = samples * step->expected_s;
    step->expected_s = now_s * side * side;
    if (side < 4 || step->expected_s * waiting(order, RG_TURN_BETTER) <= left_s)
        return;
    step->share.divisor = 2;
    step->expected_s = now_s * side * side / 4;
}

// The untried devices for which a turn can have a step. In turns of devices it is only the one with
// number `d`, in others all together for d = 0.
static unsigned devices_of(const struct rg_order *order, int table, enum rg_turn turn, int d)
{
    const struct rg_standing *s = &order->tables[table];
    const unsigned others = turn == RG_TURN_LAST ? order->last : order->all & ~order->last;
    if (rg_turns[turn].of_devices)
        return others & ~s->share.devices & ~s->tried[turn] & 1u << d;
    return d ? 0 : (turn == RG_TURN_FIRST ? order->first : s->share.devices) & ~s->tried[turn];
}

// Guesses the work of a table without any measurement: from its pixels and frames, and more if the
// table says that smaller pictures show less.
static double look_of(const struct rg_order *order, const struct rg_step *step)
{
    enum { HEAVY = 1000 };
    const struct rg_table *table = order->tables[step->table].table;
    return (double)table->width * table->height / (step->share.divisor * step->share.divisor) *
           rg_cell_check_frames(table) * (table->smaller[0] ? HEAVY : 1);
}

static bool is_cheaper(const struct rg_order *order, const struct rg_step *a,
                       const struct rg_step *b)
{
    return a->expected_s != b->expected_s ? a->expected_s < b->expected_s
                                          : look_of(order, a) < look_of(order, b);
}

// Finds a turn's cheapest step of a table.
static void find(const struct rg_order *order, int table, enum rg_turn turn, double left_s,
                 struct rg_step *found, bool *any)
{
    for (int d = 0; d < RG_MAX_DEVICES; d++) {
        struct rg_step step = {.table = table, .turn = turn};
        step.devices = devices_of(order, table, turn, d);
        if (!step.devices || !grow(&order->tables[table], &step))
            continue;
        step.expected_s = expect(order, &step, step.cells);
        if (turn == RG_TURN_BETTER)
            choose_size(order, left_s, &step);
        if (!*any || is_cheaper(order, &step, found))
            *found = step;
        *any = true;
    }
}

// Texture levels take no time once a texture is open, so their tables need no part of their own.
bool rg_order_next(struct rg_order *order, double left_s, struct rg_step *found)
{
    bool any = false;
    for (enum rg_turn turn = 0; turn < RG_TURNS && !any; turn++)
        for (int i = 0; i < order->count; i++)
            find(order, i, turn, left_s, found, &any);
    if (!any)
        return false;
    struct rg_standing *s = &order->tables[found->table];
    const bool has_part = found->turn == RG_TURN_FIRST && !s->table->is_of_textures;
    found->part_s = has_part ? left_s / waiting(order, RG_TURN_FIRST) : left_s;
    s->tried[found->turn] |= rg_turns[found->turn].of_devices ? found->devices : ~0u;
    return true;
}
