// What of all tables is measured, so that it takes no longer than a user will wait: a pure function
// of what cells are expected to take.
#ifndef RG_HARNESS_TABLES_RUNS_PLAN_H
#define RG_HARNESS_TABLES_RUNS_PLAN_H

#include "core/device/device.h"
#include "harness/tables/papers/published.h"

// Pictures of a fourth of the table's width and height, of half of them, and whole.
enum rg_budget_size { RG_BUDGET_FOURTH, RG_BUDGET_HALF, RG_BUDGET_WHOLE, RG_BUDGET_SIZES };

// A table's cells, and what they are expected to take, in seconds.
struct rg_budget_table {
    int rows, variants, works;        // all that it has
    int needed_rows, needed_variants; // what its curves and its claims cannot do without
    bool has_claims;                  // some are about it
    enum rg_budget_size smallest;     // below which its pictures show too little for its claims
    struct rg_budget_cost {
        double few_s;      // a cell of the fewest samples
        double all_s;      // of all that quick mode takes
        double sampling_s; // of these, what the samples take
    } cells[RG_MAX_DEVICES][RG_BUDGET_SIZES];
    // Beside the cells, for the picture that those of a row, variant and work must show.
    double check_s[RG_BUDGET_SIZES];
};

// Whether errors of pictures are measured at a size: where they are whole, or claims are about
// them.
bool rg_budget_has_truth(const struct rg_table *table, enum rg_budget_size size);

// What of a table is measured. Without devices it is left out.
struct rg_budget_choice {
    unsigned devices; // a bit each
    enum rg_budget_size size;
    bool all_samples, all_rows, all_variants, all_works; // else the fewest, those that are needed,
                                                         // and the work that was printed
    double expected_s;
};

// What a choice is expected to take.
double rg_budget_expect(const struct rg_budget_table *table, const struct rg_budget_choice *choice);

// The devices of a plan, a bit each.
struct rg_budget_devices {
    unsigned all;
    unsigned first; // one of them, on which each table is measured before any is on another
    unsigned last;  // some of them, which come when all else is measured
};

// The first table of the same technique, and of the same kind of size. Those of textures are alike
// in nothing.
int rg_budget_kind_of(const struct rg_table *const tables[], int table);

// Chooses for each table, in stages. First come, on device `first` and in the smallest pictures,
// the rows, variants and work that are needed, of each table; then the same on each device but
// those of `last`, of tables that claims are about before others; then pictures of half the size,
// all samples, whole pictures, all rows, all variants, all works, and the devices of `last`. Behind
// the first three a fifth of the budget is left over, for cells that take longer than expected.
// Within a stage the cheapest table comes first, so that a large one keeps no small one out. Where
// the rest of a stage is too dear, the next one has what time is left. So a larger budget never
// measures less of a stage while it measures the same of those before it. Returns what all of it is
// expected to take. `costs` and `choices` have `count`.
double rg_budget_plan(const struct rg_budget_table *costs, int count,
                      const struct rg_budget_devices *devices, double budget_s,
                      struct rg_budget_choice *choices);

#endif
