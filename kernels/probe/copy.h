// Copies words, marked with the run's salt, for tests of buffers, folding and origins.
#include "kernels/probe/copy_params.h"

#define RG_PARAMS probe_copy_params
#define RG_SLOTS  IN(1, uint, source) OUT(2, uint, target)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(probe_copy)
{
    int i = (z * p.height + y) * p.width + x;
    target_put(rg, i, source_at(rg, i) ^ p.salt);
}
