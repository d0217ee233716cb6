#include "harness/tables/runs/textures.h"

#include <stdlib.h>
#include <string.h>

#include "harness/console/clock.h"
#include "harness/tables/table.h"

// How many of a table's cells on a device open an instance: those that follow one with the same
// settings have it open, and take nothing.
static int openings(const struct rg_looking *p, const struct rg_budget_table *costs)
{
    char *before = NULL;
    int count = 0;
    for (int row = 0; row < costs->rows; row++) {
        for (int v = 0; v < costs->variants; v++) {
            const struct rg_place at = {.row = row, .variant = v};
            char *now = rg_table_assignments(&p->result, p->table, at);
            count += !before || !now || strcmp(before, now) != 0;
            free(before);
            before = now;
        }
    }
    free(before);
    return count;
}

// What opening a row's instance takes; 0 where it fails.
static double opening_ms(struct rg_looking *p, struct rg_device *device, int row)
{
    void *settings = rg_look_settings(p, row, RG_BUDGET_WHOLE, "");
    const struct rg_subject subject = {rg_technique_find(p->table->technique), settings,
                                       p->table->width, p->table->height};
    const double start_ms = rg_now_ms();
    const bool ok = settings && rg_kept_open(p->kept, device, &subject);
    free(settings);
    return ok ? rg_now_ms() - start_ms : 0;
}

void rg_look_textures(struct rg_looking *p, struct rg_budget_table *costs)
{
    const double share = (double)openings(p, costs) / (costs->rows * costs->variants);
    for (int d = 0; d < p->kept->devices->count; d++) {
        struct rg_device *device = p->kept->devices->devices[d];
        double ms = opening_ms(p, device, p->first);
        if (ms >= RG_LOOK_LATE_MS)
            ms = opening_ms(p, device, p->last);
        const double a_cell_s = 1e-3 * share * ms;
        for (int size = 0; size < RG_BUDGET_SIZES; size++)
            costs->cells[d][size] = (struct rg_budget_cost){a_cell_s, a_cell_s, 0};
    }
}
