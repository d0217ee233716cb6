#include "harness/tables/runs/forecast.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/interrupt.h"
#include "harness/tables/runs/probe.h"

// Cells of quick mode that are fewer are measured sooner than it is known how long they take.
enum { MANY_CELLS = 300 };

bool rg_forecast_is_worth(int cells, bool full)
{
    return full || cells >= MANY_CELLS;
}

// What opening, checking and sampling a cell takes, from what those of a row take on all devices.
static struct rg_cell_time time_of(const struct rg_budget_table *costs, int devices)
{
    struct rg_cell_time time = {.open_ms = 1e3 * costs->check_s[RG_BUDGET_WHOLE]};
    for (int d = 0; d < devices; d++) {
        const struct rg_budget_cost *cost = &costs->cells[d][RG_BUDGET_WHOLE];
        time.open_ms += 1e3 * (cost->all_s - cost->sampling_s);
        time.sampling_ms += 1e3 * cost->sampling_s;
    }
    time.open_ms /= devices;
    time.sampling_ms /= devices;
    return time;
}

void rg_forecast(const struct rg_table *const tables[], int count, struct rg_kept *kept, bool full,
                 struct rg_cell_time *times)
{
    struct rg_budget_kind *kinds = rg_alloc((size_t)count, sizeof(*kinds), "forecast");
    for (int i = 0; kinds && i < count && !rg_interrupted(); i++) {
        struct rg_budget_table costs = {0};
        rg_budget_probe(tables[i], kept, full, &kinds[rg_budget_kind_of(tables, i)], &costs);
        times[i] = time_of(&costs, kept->devices->count);
    }
    free(kinds);
}
