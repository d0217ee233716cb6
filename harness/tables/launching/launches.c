#include "harness/tables/launching/launches.h"

#include <string.h>

#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/judge/settle.h"

// --- rows and variants ---

static bool needs(const struct rg_table *table, int row, const char *variant)
{
    bool any = false;
    for (const struct rg_claim *claim = rg_claims; claim->table; claim++)
        any = any || (!strcmp(claim->table, table->id) && rg_claim_needs(claim, row, variant));
    return any;
}

static bool needs_row(const struct rg_result *result, const struct rg_table *table, int row)
{
    bool any = false;
    for (int v = 0; v < result->variant_count; v++)
        any = any || needs(table, row, result->variants[v]);
    return any;
}

static bool needs_variant(const struct rg_table *table, const char *variant)
{
    bool any = false;
    for (int row = 1; row <= table->row_count; row++)
        any = any || needs(table, row, variant);
    return any;
}

bool rg_launches_choose(struct rg_result *result, const struct rg_table *table)
{
    bool any = false;
    int kept = 0;
    for (int row = result->first_row; row <= result->last_row; row++) {
        const bool is_needed = needs_row(result, table, row + 1);
        result->left_out[row - result->first_row] = !is_needed;
        any = any || is_needed;
    }
    for (int v = 0; v < result->variant_count; v++)
        if (needs_variant(table, result->variants[v]))
            memmove(result->variants[kept++], result->variants[v], RG_NAME_SIZE);
    result->variant_count = kept;
    return any;
}

// --- the next launch: of claims ---

// Whether most launches of a claim are disturbed: its course would never end, as in a gate.
static bool is_hopeless(const struct rg_judgement *j)
{
    return j->disturbed > 32 && j->disturbed > 3 * j->launches;
}

static bool wants_launch(const struct rg_claim *claim, const struct rg_result *result, int device)
{
    const struct rg_judgement j = rg_claim_judge(claim, result, device);
    return j.verdict == RG_CLAIM_ONE_LAUNCH ||
           (j.verdict == RG_CLAIM_UNDECIDED && j.more && !is_hopeless(&j));
}

// Whether the claim's test compares the variants of each row, and not rows; or compares nothing.
static bool is_by_row(const struct rg_claim *claim)
{
    return claim->test == RG_CLAIM_FASTER || claim->test == RG_CLAIM_CROSSES ||
           claim->test == RG_CLAIM_RATE;
}

static int find_cell(struct rg_launch_cells *cells, struct rg_place at)
{
    int i = 0;
    while (i < cells->count &&
           (cells->cells[i].at.row != at.row || cells->cells[i].at.variant != at.variant))
        i++;
    if (i == cells->count)
        cells->cells[cells->count++] = (struct rg_launch_cell){.at = at, .group = i};
    return i;
}

static void join(struct rg_launch_cells *cells, int a, int b)
{
    const int from = cells->cells[b].group, to = cells->cells[a].group;
    for (int i = 0; i < cells->count; i++)
        if (cells->cells[i].group == from)
            cells->cells[i].group = to;
}

// Whether a cell has all launches that it may have: `most` undisturbed ones, or 0 for no limit.
static bool has_all(const struct rg_record *record, int most)
{
    return record->launch_count == RG_MAX_LAUNCHES ||
           (most && rg_record_calm_launches(record) >= most);
}

// Adds the claim's cells, and joins those that it compares.
static void add_claim(const struct rg_claim *claim, const struct rg_result *result, int most,
                      int device, struct rg_launch_cells *cells)
{
    int before = -1; // the claim's cell before this one
    for (int row = result->first_row; row <= result->last_row; row++) {
        before = is_by_row(claim) ? -1 : before;
        for (int v = 0; rg_result_has(result, row) && v < result->variant_count; v++) {
            const struct rg_place at = {row, rg_result_printed_work(result), v, device};
            if (!rg_claim_needs(claim, row + 1, result->variants[v]) ||
                has_all(rg_result_at(result, at), most))
                continue;
            const int cell = find_cell(cells, at);
            if (before >= 0)
                join(cells, before, cell);
            before = cell;
        }
    }
}

static void add_claims(const struct rg_launches_wanted *wanted, const struct rg_result *result,
                       int device, struct rg_launch_cells *cells)
{
    for (const struct rg_claim *claim = wanted->claims; claim->table; claim++)
        if (!strcmp(claim->table, result->table) && wants_launch(claim, result, device))
            add_claim(claim, result, wanted->most, device, cells);
}

// --- the next launch: of each cell ---

// How many launches a cell still wants. A busy machine would disturb launches for ever, so that as
// many as are wanted are replaced.
static int launches_wanted(const struct rg_record *record, int of_each)
{
    const int calm = rg_record_calm_launches(record);
    const int left = 2 * of_each - record->launch_count;
    const int wanted = of_each - calm < left ? of_each - calm : left;
    return record->outcome == RG_OK && wanted > 0 ? wanted : 0;
}

// Adds cells of one work; those of a row are compared.
static void add_each(int of_each, const struct rg_result *result, int device,
                     struct rg_launch_cells *cells)
{
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        const bool is_of_this =
            at.device == device && (!cells->count || at.work == cells->cells[0].at.work);
        if (!is_of_this || !launches_wanted(rg_result_at(result, at), of_each))
            continue;
        const int cell = find_cell(cells, at);
        if (cell && cells->cells[cell - 1].at.row == at.row)
            join(cells, cell - 1, cell);
    }
}

// --- the next launch ---

// Numbers the groups from 0.
static void number_groups(struct rg_launch_cells *cells)
{
    int numbers[RG_LAUNCH_CELLS];
    for (int i = 0; i < cells->count; i++)
        numbers[i] = -1;
    for (int i = 0; i < cells->count; i++) {
        int *number = &numbers[cells->cells[i].group];
        *number = *number < 0 ? cells->group_count++ : *number;
        cells->cells[i].group = *number;
    }
}

int rg_launches_next(const struct rg_result *result, const struct rg_launches_wanted *wanted,
                     int device, struct rg_launch_cells *cells)
{
    int last = 0;
    cells->count = cells->group_count = 0;
    if (wanted->claims)
        add_claims(wanted, result, device, cells);
    else
        add_each(wanted->of_each, result, device, cells);
    number_groups(cells);
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        const struct rg_record *record = rg_result_at(result, at);
        const int count = at.device == device ? record->launch_count : 0;
        if (count && record->launches[count - 1].number > last)
            last = record->launches[count - 1].number;
    }
    return cells->count ? last + 1 : 0;
}

bool rg_launches_are_due(const struct rg_result *result, const struct rg_launches_wanted *wanted)
{
    struct rg_launch_cells cells;
    bool any = false;
    for (int device = 0; device < result->device_count; device++)
        any = any || rg_launches_next(result, wanted, device, &cells) > 0;
    return any;
}

// --- the course ---

static bool is_over(double end_ms)
{
    return rg_interrupted() || (end_ms > 0 && rg_now_ms() >= end_ms);
}

// How many launches the device's open claims need until the next look, or its cells, at most.
static int launches_due(const struct rg_result *result, const struct rg_launches_wanted *wanted,
                        int device)
{
    int most = 0;
    for (struct rg_place at = rg_result_start(result);
         !wanted->claims && rg_result_next(result, &at);) {
        const int due = launches_wanted(rg_result_at(result, at), wanted->of_each);
        most = at.device == device && due > most ? due : most;
    }
    for (const struct rg_claim *claim = wanted->claims; claim && claim->table; claim++) {
        if (strcmp(claim->table, result->table) != 0 || !wants_launch(claim, result, device))
            continue;
        const struct rg_judgement j = rg_claim_judge(claim, result, device);
        const int due = j.verdict == RG_CLAIM_ONE_LAUNCH ? rg_settle_rule.looks[0] : j.more;
        most = due > most ? due : most;
    }
    return most;
}

bool rg_launches_take(struct rg_result *result, const struct rg_table *table,
                      const struct rg_launches_wanted *wanted, struct rg_journal *journal,
                      struct rg_progress *bar, double end_ms)
{
    struct rg_launch_cells cells;
    bool all = true;
    for (int device = 0; device < result->device_count; device++) {
        int number, due = 0;
        bool ok = true;
        while (ok && !is_over(end_ms) &&
               (number = rg_launches_next(result, wanted, device, &cells))) {
            if (!due)
                rg_progress_grow(bar, due = launches_due(result, wanted, device));
            rg_progress_label(bar, "%s on %s, launch %d", table->id, result->devices[device].name,
                              number);
            ok = rg_launch_take(result, table, &cells, number);
            rg_journal_add(journal, result, result->first_row, result->last_row);
            rg_journal_keep(journal);
            rg_progress_add(bar, 1);
            due--;
        }
        rg_progress_grow(bar, -due);
        all = all && (ok || rg_interrupted());
    }
    return all;
}
