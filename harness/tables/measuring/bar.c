// A table's part of a command's bar.
#include <math.h>

#include "harness/tables/measuring/measure.h"

// How far a cell is of which nobody knows how long it takes: so much when it is open, and as much
// again when it is sampled.
enum { CELL_UNITS = 1000 };

struct rg_table_bar rg_table_bar_of(const struct rg_cell_time times[RG_TABLE_ROWS],
                                    struct rg_progress *progress, struct rg_table_learned *learned)
{
    struct rg_table_bar bar = {.progress = progress, .learned = learned, .is_expected = times};
    for (int row = 0; row < RG_TABLE_ROWS; row++) {
        bar.cell_units[row][RG_BAR_OPENING] =
            times ? (int64_t)(times[row].open_ms / RG_TABLE_UNIT_MS) : CELL_UNITS;
        bar.cell_units[row][RG_BAR_SAMPLING] =
            times ? (int64_t)(times[row].sampling_ms / RG_TABLE_UNIT_MS) : CELL_UNITS;
    }
    return bar;
}

int64_t rg_table_row_units(const struct rg_result *result, const struct rg_table_bar *bar, int row,
                           enum rg_bar_part part)
{
    return bar->cell_units[row][part] * rg_result_row_cells(result);
}

int64_t rg_table_bar_add(const struct rg_table_bar *bar, const struct rg_result *result,
                         const struct rg_journal *journal)
{
    int64_t all = 0;
    for (int row = result->first_row; row <= result->last_row; row++) {
        if (!rg_result_wants(result, row) || rg_journal_has(journal, row))
            continue;
        for (int part = 0; part < RG_BAR_PARTS; part++) {
            const int64_t units = rg_table_row_units(result, bar, row, (enum rg_bar_part)part);
            bar->learned->parts[part].left += units;
            bar->learned->parts[part].shown += units;
            all += units;
        }
    }
    return all;
}

// --- what is left, by what was opened ---

// What is not begun takes so many times as long as it was due.
static double scale_of(const struct rg_table_learned *learned, enum rg_bar_part part)
{
    const double planned = learned->parts[part].planned;
    return planned > 0 ? learned->parts[part].taken / planned : 1;
}

int64_t rg_table_bar_begin(const struct rg_table_bar *bar, enum rg_bar_part part, int64_t units)
{
    struct rg_table_learned *learned = bar->learned;
    const int64_t begun = llround((double)units * scale_of(learned, part));
    learned->parts[part].left -= units;
    learned->parts[part].shown -= begun;
    return begun;
}

void rg_table_bar_learn(const struct rg_table_bar *bar, enum rg_bar_part part, int64_t units,
                        double ms)
{
    struct rg_table_learned *learned = bar->learned;
    if (!bar->is_expected)
        return;
    learned->parts[part].planned += (double)units;
    learned->parts[part].taken += ms / RG_TABLE_UNIT_MS;
    const int64_t left = llround((double)learned->parts[part].left * scale_of(learned, part));
    rg_progress_grow(bar->progress, left - learned->parts[part].shown);
    learned->parts[part].shown = left;
}

void rg_table_bar_correct(const struct rg_table_bar *bar, int64_t shown, double ms)
{
    const int64_t more = bar->is_expected ? llround(ms / RG_TABLE_UNIT_MS) - shown : 0;
    rg_progress_grow(bar->progress, more);
    rg_progress_add(bar->progress, more);
}
