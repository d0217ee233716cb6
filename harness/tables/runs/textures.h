// What tables of textures take.
#ifndef RG_HARNESS_TABLES_RUNS_TEXTURES_H
#define RG_HARNESS_TABLES_RUNS_TEXTURES_H

#include "harness/tables/runs/look.h"

// Fills in what cells take on each device: a texture's level takes nothing but opening what holds
// it, which is done for the first row that is looked at.
void rg_look_textures(struct rg_looking *looking, struct rg_budget_table *costs);

#endif
