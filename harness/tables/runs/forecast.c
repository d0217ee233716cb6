#include "harness/tables/runs/forecast.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/interrupt.h"
#include "harness/tables/runs/chosen.h"
#include "harness/tables/runs/probe.h"

// Cells of quick mode that are fewer are measured sooner than it is known how long they take.
enum { MANY_CELLS = 300 };

bool rg_forecast_is_worth(int cells, bool full)
{
    return full || cells >= MANY_CELLS;
}

void rg_forecast(struct rg_forecast *forecasts, int count, struct rg_kept *kept)
{
    const struct rg_table *tables[RG_BUDGET_TABLES];
    struct rg_budget_kind *kinds = rg_alloc((size_t)count, sizeof(*kinds), "forecast");
    for (int i = 0; i < count; i++)
        tables[i] = forecasts[i].table;
    for (int i = 0; kinds && i < count && !rg_interrupted(); i++)
        rg_budget_probe_rows(tables[i], kept, &forecasts[i].part, forecasts[i].rows,
                             &kinds[rg_budget_kind_of(tables, i)], forecasts[i].times);
    free(kinds);
}
