// Figures of L.-N. Ye, Raining Simulation based on Improved Particle Systems algorithms.
#include "harness/tables/figures/figures.h"

const struct rg_figure rg_figures_ye[] = {
    {.id = "ye-3",
     .technique = "shower",
     .settings = "system=improved",
     .frame = 120,
     .caption = "Rain by the improved particle system in a city, in three layers of drops.",
     .printed = "Rain scene simulation based on improved particle system algorithms"},
    {.id = NULL},
};
