// Counts how often each item ran. Items with a mark of 0 say that they have nothing to do, though
// they have: tests see by it which devices leave them out.
#include "tests/kernels/idle_params.h"

#define RG_PARAMS test_idle_params
#define RG_SLOTS  IN(1, uint, marks) INOUT(2, uint, runs)
#include "kernels/dialect/slots/slots.h"

#define RG_IDLE_ITEMS TEST_IDLE_ITEMS
RG_GRID_IDLE(test_idle)
{
    uint marked = 0u;
    for (int k = 0; k < count; k++)
        marked = marked | marks_at(rg, y * p.width + x + k);
    return marked == 0u;
}

RG_GRID_KERNEL(test_idle)
{
    runs_put(rg, y * p.width + x, runs_at(rg, y * p.width + x) + 1u);
}
