#include "harness/tables/runs/needed.h"

#include <string.h>

#include "harness/tables/claims/claim.h"

static bool is_about(const struct rg_claim *claim, const struct rg_table *table)
{
    return !strcmp(claim->table, table->id);
}

static void need(bool needed[RG_TABLE_ROWS], int row)
{
    if (row >= 1 && row <= RG_TABLE_ROWS)
        needed[row - 1] = true;
}

// Needs the middle row of first to last (from 1), unless a row between them is needed anyway.
static void need_middle(bool needed[RG_TABLE_ROWS], int first, int last)
{
    for (int row = first + 1; row < last; row++)
        if (needed[row - 1])
            return;
    need(needed, (first + last) / 2);
}

// The number of rows in quick mode: fewer than all if the table's later rows take long.
static int quick_rows_of(const struct rg_table *table)
{
    return table->quick_rows ? table->quick_rows : table->row_count;
}

// The last row that a claim needs. A claim about each row by itself needs only those of quick mode.
static int last_of(const struct rg_claim *claim, const struct rg_table *table)
{
    const int rows = quick_rows_of(table);
    return rg_claim_is_of_each_row(claim) && claim->last > rows ? rows : claim->last;
}

// Needs the rows at which claims begin, end or bend, and the middle row of claims about a curve
// rather than two rows.
static void need_claims(const struct rg_table *table, bool needed[RG_TABLE_ROWS])
{
    for (const struct rg_claim *claim = rg_claims; claim->table; claim++) {
        if (!is_about(claim, table))
            continue;
        need(needed, claim->first);
        need(needed, last_of(claim, table));
        need(needed, claim->knee);
        need(needed, claim->until);
    }
    for (const struct rg_claim *claim = rg_claims; claim->table; claim++)
        if (is_about(claim, table) && claim->test != RG_CLAIM_RATIO)
            need_middle(needed, claim->first, last_of(claim, table));
}

int rg_needed_rows(const struct rg_table *table, bool needed[RG_TABLE_ROWS])
{
    const int rows = quick_rows_of(table);
    int count = 0;
    memset(needed, 0, RG_TABLE_ROWS * sizeof(needed[0]));
    need(needed, 1);
    need(needed, rows);
    need_claims(table, needed);
    need_middle(needed, 1, rows);
    for (int row = 0; row < RG_TABLE_ROWS; row++) {
        needed[row] = (needed[row] || table->is_of_textures) && row < table->row_count;
        count += needed[row];
    }
    return count;
}

int rg_quick_rows(const struct rg_table *table, bool rows[RG_TABLE_ROWS])
{
    int count = 0;
    rg_needed_rows(table, rows);
    for (int row = 0; row < table->row_count; row++) {
        rows[row] = rows[row] || row < quick_rows_of(table);
        count += rows[row];
    }
    return count;
}

int rg_needed_variants(const struct rg_table *table, bool needed[RG_TABLE_VARIANTS])
{
    int count = 0;
    for (int v = 0; v < RG_TABLE_VARIANTS && table->variants[v].name; v++) {
        const char *name = table->variants[v].name;
        needed[v] = v == 0;
        for (const struct rg_claim *claim = rg_claims; claim->table; claim++)
            if (is_about(claim, table) && !claim->can_wait)
                needed[v] = needed[v] || !strcmp(name, claim->variant) ||
                            (claim->other && !strcmp(name, claim->other));
        count += needed[v];
    }
    return count;
}

bool rg_has_claims(const struct rg_table *table)
{
    bool any = false;
    for (const struct rg_claim *claim = rg_claims; claim->table; claim++)
        any = any || is_about(claim, table);
    return any;
}

// Whether this test judges a claim about the table. If quick settings reduce the work, no frame
// rate can be judged.
static bool has_test(const struct rg_table *table, enum rg_claim_test test)
{
    bool has = false;
    for (const struct rg_claim *claim = rg_claims; claim->table; claim++)
        has = has || (is_about(claim, table) && claim->test == test &&
                      !(test == RG_CLAIM_RATE && table->quick));
    return has;
}

int rg_most_divisor(const struct rg_table *table)
{
    enum { SMALL_PIXELS = 512 * 512 };
    const bool stays = table->is_of_textures || has_test(table, RG_CLAIM_RATE) ||
                       table->width * table->height <= SMALL_PIXELS;
    return stays ? 1 : 4;
}

bool rg_wants_truth(const struct rg_table *table, int divisor)
{
    return table->truth && (divisor == 1 || has_test(table, RG_CLAIM_FLATTENS));
}
