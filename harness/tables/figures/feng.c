// Figures of Z.-X. Feng, M. Tang, J.-X. Dong and S.-C. Chou, Real-time Rain Simulation in Cartoon
// Style. `raingauge atlas cartoon` makes the textures of its figures 3 and 5.
#include "harness/tables/figures/figures.h"

const struct rg_figure rg_figures_feng[] = {
    {.id = "feng-6a",
     .technique = "cartoon",
     .settings = "preset=car",
     .frame = 60,
     .caption = "A car as a cartoon with outlines, in 15,000 drops a second.",
     .printed = "Cartoon & outlines effect (the car model) (15,000 particles released per second) "
                "(left) Cartoon & wind-driven effect (the table model) (20,000 particles released "
                "per second) (middle) Cartoon & wind-driven effect (the park2 model) (18,000 "
                "particles released per second) (right)"},
    {.id = "feng-6b",
     .technique = "cartoon",
     .settings = "preset=table",
     .frame = 60,
     .caption = "A table as a cartoon, in 20,000 drops a second that the wind drives.",
     .printed = "Cartoon & outlines effect (the car model) (15,000 particles released per second) "
                "(left) Cartoon & wind-driven effect (the table model) (20,000 particles released "
                "per second) (middle) Cartoon & wind-driven effect (the park2 model) (18,000 "
                "particles released per second) (right)"},
    {.id = "feng-6c",
     .technique = "cartoon",
     .settings = "preset=park2",
     .frame = 60,
     .caption =
         "A fountain with benches as a cartoon, in 18,000 drops a second that the wind drives.",
     .printed = "Cartoon & outlines effect (the car model) (15,000 particles released per second) "
                "(left) Cartoon & wind-driven effect (the table model) (20,000 particles released "
                "per second) (middle) Cartoon & wind-driven effect (the park2 model) (18,000 "
                "particles released per second) (right)"},
    {.id = NULL},
};
