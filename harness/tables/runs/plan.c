#include "harness/tables/runs/plan.h"

#include <string.h>

#include "harness/tables/runs/needed.h"

int rg_budget_kind_of(const struct rg_table *const tables[], int i)
{
    for (int k = 0; k < i && !tables[i]->is_of_textures; k++)
        if (!strcmp(tables[k]->technique, tables[i]->technique) &&
            tables[k]->width == tables[i]->width && !tables[k]->is_of_textures)
            return k;
    return i;
}

bool rg_budget_has_truth(const struct rg_table *table, enum rg_budget_size size)
{
    return table->truth && (size == RG_BUDGET_WHOLE || rg_needs_truth(table));
}

static int cells_a_device(const struct rg_budget_table *t, const struct rg_budget_choice *c)
{
    return (c->all_rows ? t->rows : t->needed_rows) *
           (c->all_variants ? t->variants : t->needed_variants) * (c->all_works ? t->works : 1);
}

double rg_budget_expect(const struct rg_budget_table *t, const struct rg_budget_choice *c)
{
    double cell_s = c->devices ? t->check_s[c->size] : 0;
    for (int d = 0; d < RG_MAX_DEVICES; d++)
        if (c->devices >> d & 1)
            cell_s += c->all_samples ? t->cells[d][c->size].all_s : t->cells[d][c->size].few_s;
    return cell_s * cells_a_device(t, c);
}

// --- what more could be measured ---

enum stage {
    FIRST,   // a table, on the first device
    CLAIMED, // a table that claims are about, on one device more
    NEEDED,  // any other
    HALF,
    SAMPLES,
    WHOLE,
    ROWS,
    VARIANTS,
    WORKS,
    LAST, // on one of the last devices
    STAGES
};

static bool is_of_devices(enum stage stage)
{
    return stage == FIRST || stage == CLAIMED || stage == NEEDED || stage == LAST;
}

// The choice with more of a stage in it; false where it has that, or where the stage has none. Of a
// table that is on no device there is nothing to refine.
static bool grow(const struct rg_budget_table *t, struct rg_budget_choice *c, enum stage stage,
                 unsigned device)
{
    const struct rg_budget_choice before = *c;
    if (!c->devices && (!is_of_devices(stage) || stage == LAST))
        return false;
    switch (stage) {
    case CLAIMED:
        if (!t->has_claims)
            return false;
        c->devices |= device;
        return c->devices != before.devices;
    case FIRST:
    case NEEDED:
    case LAST:
        c->devices |= device;
        return c->devices != before.devices;
    case HALF:
        c->size = c->size < RG_BUDGET_HALF ? RG_BUDGET_HALF : c->size;
        return c->size != before.size;
    case SAMPLES:
        c->all_samples = true;
        return !before.all_samples;
    case WHOLE:
        c->size = RG_BUDGET_WHOLE;
        return c->size != before.size;
    case ROWS:
        c->all_rows = true;
        return !before.all_rows && t->rows > t->needed_rows;
    case VARIANTS:
        c->all_variants = true;
        return !before.all_variants && t->variants > t->needed_variants;
    default:
        c->all_works = true;
        return !before.all_works && t->works > 1;
    }
}

// A step of a stage: one table more, on one device where the stage is about devices.
struct step {
    int table;
    struct rg_budget_choice grown;
    double more_s;
};

static unsigned devices_of(const struct rg_budget_devices *devices, enum stage stage)
{
    return stage == FIRST  ? devices->first
           : stage == LAST ? devices->all & devices->last
                           : devices->all & ~devices->last;
}

// Of the budget, so much is left for cells that take longer than they are expected to: else a
// larger picture of one table would cost another all of it.
#define RESERVE 0.2

static bool is_of_least(enum stage stage)
{
    return stage <= NEEDED;
}

// The cheapest step that a stage still has; false where it has none.
static bool find_step(const struct rg_budget_table *costs, int count, enum stage stage,
                      unsigned devices, const struct rg_budget_choice *choices, struct step *found)
{
    bool any = false;
    for (int i = 0; i < count; i++) {
        for (int d = 0; d < (is_of_devices(stage) ? RG_MAX_DEVICES : 1); d++) {
            struct step step = {i, choices[i], 0};
            if (is_of_devices(stage) && !(devices >> d & 1))
                continue;
            if (!grow(&costs[i], &step.grown, stage, 1u << d))
                continue;
            step.grown.expected_s = rg_budget_expect(&costs[i], &step.grown);
            step.more_s = step.grown.expected_s - choices[i].expected_s;
            if (!any || step.more_s < found->more_s)
                *found = step;
            any = true;
        }
    }
    return any;
}

double rg_budget_plan(const struct rg_budget_table *costs, int count,
                      const struct rg_budget_devices *devices, double budget_s,
                      struct rg_budget_choice *choices)
{
    double planned_s = 0;
    struct step step = {0};
    for (int i = 0; i < count; i++)
        choices[i] = (struct rg_budget_choice){.size = costs[i].smallest};
    for (enum stage stage = FIRST; stage < STAGES; stage++) {
        const double most_s = is_of_least(stage) ? budget_s : (1 - RESERVE) * budget_s;
        while (find_step(costs, count, stage, devices_of(devices, stage), choices, &step) &&
               planned_s + step.more_s <= most_s) {
            planned_s += step.more_s;
            choices[step.table] = step.grown;
        }
    }
    return planned_s;
}
