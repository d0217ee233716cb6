// Sums the samples of each drop's facets, and clears them for the next step's counts.
#include "kernels/cartoon/rain/params.h"

#define RG_PARAMS cartoon_rain_params
#define RG_SLOTS  INOUT(1, uint, facet_samples) OUT(2, uint, counts)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(cartoon_sum)
{
    uint count = 0u;
    for (int i = x * p.facets; i < (x + 1) * p.facets; i++) {
        count += facet_samples_at(rg, i);
        facet_samples_put(rg, i, 0u);
    }
    counts_put(rg, x, count);
}
