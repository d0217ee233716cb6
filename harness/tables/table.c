#include "harness/tables/table.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"

struct rg_table_group *rg_table_group(const struct rg_table_run *run, int row, int variant)
{
    return &run->groups[(row - run->first_row) * rg_table_variant_count(run->table) + variant];
}

struct rg_cell *rg_table_cell(const struct rg_table_run *run, int row, int variant, int device)
{
    const long group = rg_table_group(run, row, variant) - run->groups;
    return &run->cells[group * run->devices->count + device];
}

double rg_cell_fps(const struct rg_cell *cell)
{
    return 1000 / cell->frame_ms.median;
}

double rg_table_published_fps(const struct rg_table *table, int row, int variant)
{
    const char *column = table->variants[variant].fps;
    return rg_table_is_published(table) && column ? rg_table_value(table, row, column) : NAN;
}

int rg_table_first_missing(const struct rg_table_run *run)
{
    int row = run->first_row;
    while (row <= run->last_row && !rg_table_group(run, row, 0)->is_missing)
        row++;
    return row;
}

char *rg_table_assignments(const struct rg_table_run *run, int row, int variant)
{
    const char *const parts[] = {run->table->rows[row].set, run->table->variants[variant].set,
                                 run->full || !run->table->quick ? "" : run->table->quick};
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    bool any = false;
    for (int i = 0; out && i < 3; i++) {
        if (!*parts[i])
            continue;
        fprintf(out, "%s%s", any ? " " : "", parts[i]);
        any = true;
    }
    if (out && fclose(out) == 0)
        return text;
    free(text);
    return rg_error_null("table '%s': no memory for a row's settings", run->table->id);
}

void rg_table_samples(const struct rg_table_run *run, int *least, int *most)
{
    *least = *most = 0;
    for (int i = 0; i < run->cell_count; i++) {
        const int samples = run->cells[i].sample_count;
        if (run->cells[i].status != RG_OK || !samples)
            continue;
        *least = !*least || samples < *least ? samples : *least;
        *most = samples > *most ? samples : *most;
    }
}

void rg_table_run_free(struct rg_table_run *run)
{
    for (int i = 0; i < run->cell_count; i++)
        rg_cell_free(&run->cells[i]);
    for (int i = 0; i < run->cell_count / run->devices->count; i++)
        free(run->groups[i].settings);
    free(run->groups);
    free(run->cells);
    json_decref(run->journal);
}
