#include "harness/tables/farm/plan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/array.h"

bool rg_farm_add_group(struct rg_farm_plan *plan, const char *table, const char *id)
{
    if (!rg_array_fit(&plan->groups, &plan->group_room, plan->group_count + 1,
                      sizeof(*plan->groups), "groups of a plan"))
        return false;
    struct rg_farm_group *group = &plan->groups[plan->group_count++];
    *group = (struct rg_farm_group){.first_cell = plan->cell_count};
    rg_text_copy(group->id, sizeof(group->id), id);
    rg_text_copy(group->table, sizeof(group->table), table);
    return true;
}

bool rg_farm_add_cell(struct rg_farm_plan *plan, const struct rg_farm_cell *cell)
{
    if (!rg_array_fit(&plan->cells, &plan->cell_room, plan->cell_count + 1, sizeof(*plan->cells),
                      "cells of a plan"))
        return false;
    plan->cells[plan->cell_count++] = *cell;
    plan->groups[plan->group_count - 1].cell_count++;
    return true;
}

double rg_farm_sum(struct rg_farm_plan *plan)
{
    double all = 0;
    for (int64_t g = 0; g < plan->group_count; g++) {
        struct rg_farm_group *group = &plan->groups[g];
        group->seconds = 0;
        for (int i = 0; i < group->cell_count; i++)
            group->seconds += plan->cells[group->first_cell + i].seconds;
        all += group->seconds;
    }
    return all;
}

void rg_farm_cell_id(const struct rg_farm_plan *plan, const struct rg_farm_group *group,
                     const struct rg_farm_cell *cell, char *text, size_t size)
{
    snprintf(text, size, "%s/%d/%s%s%s/%s", group->table, cell->row, cell->work,
             *cell->work ? "/" : "", cell->variant, plan->devices[cell->device].name);
}

int64_t rg_farm_table_end(const struct rg_farm_plan *plan, int64_t group)
{
    int64_t end = group + 1;
    while (end < plan->group_count && !strcmp(plan->groups[end].table, plan->groups[group].table))
        end++;
    return end;
}

bool rg_farm_has_row(const struct rg_farm_plan *plan, int64_t first, int64_t end, int row)
{
    for (int64_t g = first; g < end; g++) {
        const struct rg_farm_group *group = &plan->groups[g];
        for (int i = 0; i < group->cell_count; i++)
            if (plan->cells[group->first_cell + i].row == row + 1)
                return true;
    }
    return false;
}

void rg_farm_plan_free(struct rg_farm_plan *plan)
{
    free(plan->cells);
    free(plan->groups);
    *plan = (struct rg_farm_plan){0};
}
