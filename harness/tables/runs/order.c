#include "harness/tables/runs/order.h"

#include <math.h>
#include <string.h>

#include "harness/tables/measuring/cell.h"
#include "harness/tables/runs/needed.h"

static const struct {
    const char *about;
    bool of_devices, is_whole;
} turns[] = {
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

const char *rg_turn_about(enum rg_turn turn)
{
    return turns[turn].about;
}

bool rg_turn_is_of_devices(enum rg_turn turn)
{
    return turns[turn].of_devices;
}

bool rg_turn_is_whole(enum rg_turn turn)
{
    return turns[turn].is_whole;
}

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

// Estimates a cell's time on a device: from the table's own cells there; else from other tables
// of the technique; else from the table's cells on another device, which may be too little.
// 0: unknown.
static double cell_s(const struct rg_standing *standings, int count, int table, int device)
{
    const struct rg_standing *of = &standings[table];
    double s = of->cell_s[device], elsewhere_s = 0, alike_s = 0;
    for (int d = 0; d < RG_MAX_DEVICES; d++) {
        if (!(of->cell_s[d] > 0))
            continue;
        elsewhere_s = elsewhere_s > 0 ? elsewhere_s : of->cell_s[d];
        for (int i = 0; i < count; i++)
            if (are_alike(of, &standings[i]) && standings[i].cell_s[d] > 0)
                alike_s = fmax(alike_s, of->cell_s[d] * standings[i].cell_s[device] /
                                            standings[i].cell_s[d]);
    }
    for (int i = 0; i < count && !(elsewhere_s > 0); i++)
        if (are_alike(of, &standings[i]) && standings[i].cell_s[device] > 0)
            alike_s = standings[i].cell_s[device];
    return s > 0 ? s : alike_s > 0 ? alike_s : elsewhere_s;
}

static double expect(const struct rg_standing *standings, int count, const struct rg_step *step)
{
    double s = 0;
    for (int d = 0; d < RG_MAX_DEVICES; d++)
        if (step->devices >> d & 1)
            s += step->cells * cell_s(standings, count, step->table, d);
    return s;
}

// Larger pictures take longer by at most the ratio of their pixels, and all samples of quick mode
// take twice as long as the fewest.
static double times_as_long(const struct rg_share *before, const struct rg_share *after)
{
    const double side = (double)before->divisor / after->divisor;
    return side * side * (after->all_samples && !before->all_samples ? 2 : 1);
}

void rg_order_learn(struct rg_standing *standings, int count, const struct rg_step *step, int cells,
                    double seconds)
{
    struct rg_step taken = *step;
    taken.cells = cells;
    const double expected_s = expect(standings, count, &taken);
    for (int d = 0; d < RG_MAX_DEVICES; d++)
        if (step->devices >> d & 1)
            standings[step->table].cell_s[d] =
                expected_s > 0 ? cell_s(standings, count, step->table, d) * seconds / expected_s
                               : seconds / (cells * __builtin_popcount(step->devices));
}

// --- the next step ---

// Whether a turn adds anything to a table; fills in the step's share and cells.
static bool grow(const struct rg_standing *s, enum rg_turn turn, struct rg_step *step)
{
    const int works = s->share.all_works ? s->works : 1;
    const int variants = s->share.all_variants ? s->variants : s->needed_variants;
    if ((turn == RG_TURN_FIRST) == (s->rows > 0))
        return false;
    step->share = s->share;
    step->share.devices |= step->devices;
    step->cells = variants * works * (rg_turn_is_whole(turn) ? s->rows : 1);
    switch (turn) {
    case RG_TURN_FIRST:
        return true;
    case RG_TURN_NEEDED:
        return s->rows < s->needed_rows;
    case RG_TURN_CLAIMED:
        return s->has_claims;
    case RG_TURN_BETTER:
        step->share.all_samples = true;
        step->share.divisor = 1;
        return !s->table->is_of_textures;
    case RG_TURN_ROWS:
        step->share.all_rows = true;
        return s->rows < s->quick_rows;
    case RG_TURN_VARIANTS:
        step->share.all_variants = true;
        step->cells = s->rows * works * (s->variants - variants);
        return s->variants > variants;
    case RG_TURN_WORKS:
        step->share.all_works = true;
        step->cells = s->rows * variants * (s->works - works);
        return s->works > works;
    default:
        return true;
    }
}

static int waiting(const struct rg_standing *standings, int count, enum rg_turn turn)
{
    int tables = 0;
    for (int i = 0; i < count; i++)
        tables += !standings[i].tried[turn];
    return tables;
}

double rg_order_part_s(const struct rg_standing *standings, int count, double left_s)
{
    const int tables = waiting(standings, count, RG_TURN_FIRST);
    return left_s / (tables ? tables : 1);
}

// Chooses full pictures, or half their size if they would take more than the table's part of the
// time.
static void choose_size(const struct rg_standing *standings, int count, double left_s,
                        struct rg_step *step)
{
    const struct rg_share *before = &standings[step->table].share;
    const double now_s = step->expected_s;
    step->expected_s = now_s * times_as_long(before, &step->share);
    if (before->divisor < 4 ||
        step->expected_s * waiting(standings, count, RG_TURN_BETTER) <= left_s)
        return;
    step->share.divisor = 2;
    step->expected_s = now_s * times_as_long(before, &step->share);
}

// The devices for which a turn can have a step.
static unsigned devices_of(const struct rg_standing *s, enum rg_turn turn,
                           const struct rg_order_devices *devices)
{
    if (turn == RG_TURN_FIRST)
        return devices->first;
    if (!turns[turn].of_devices)
        return s->share.devices;
    return (turn == RG_TURN_LAST ? devices->last : devices->all & ~devices->last) &
           ~s->share.devices;
}

// Finds the cheapest step of a table that was not tried yet.
static bool find(const struct rg_standing *standings, int count,
                 const struct rg_order_devices *devices, double left_s, struct rg_step *found)
{
    const struct rg_standing *s = &standings[found->table];
    const unsigned left = devices_of(s, found->turn, devices) & ~s->tried[found->turn];
    bool any = false;
    for (int d = 0; d < RG_MAX_DEVICES && left; d++) {
        struct rg_step step = *found;
        step.devices = turns[step.turn].of_devices ? left & 1u << d : d ? 0 : left;
        if (!step.devices || !grow(s, step.turn, &step))
            continue;
        step.expected_s = expect(standings, count, &step);
        if (step.turn == RG_TURN_BETTER)
            choose_size(standings, count, left_s, &step);
        if (!any || step.expected_s < found->expected_s)
            *found = step;
        any = true;
    }
    return any;
}

// Guesses the work of a table without any measurement: from its pixels and frames, and more if the
// table says that smaller pictures show less.
static double look_of(const struct rg_table *table, int divisor)
{
    enum { HEAVY = 1000 };
    return (double)table->width * table->height / (divisor * divisor) *
           rg_cell_check_frames(table) * (table->smaller[0] ? HEAVY : 1);
}

static bool is_cheaper(const struct rg_standing *standings, const struct rg_step *a,
                       const struct rg_step *b)
{
    return a->expected_s != b->expected_s
               ? a->expected_s < b->expected_s
               : look_of(standings[a->table].table, a->share.divisor) <
                     look_of(standings[b->table].table, b->share.divisor);
}

bool rg_order_next(const struct rg_standing *standings, int count,
                   const struct rg_order_devices *devices, double left_s, struct rg_step *found)
{
    bool any = false;
    for (enum rg_turn turn = 0; turn < RG_TURNS && !any; turn++)
        for (int i = 0; i < count; i++) {
            struct rg_step step = {.table = i, .turn = turn};
            if (!find(standings, count, devices, left_s, &step) ||
                (any && !is_cheaper(standings, &step, found)))
                continue;
            *found = step;
            any = true;
        }
    return any;
}

void rg_order_tried(struct rg_standing *standings, const struct rg_step *step)
{
    standings[step->table].tried[step->turn] |= turns[step->turn].of_devices ? step->devices : ~0u;
}
