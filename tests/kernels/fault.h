// Writes at a given place, even outside the buffer: tests that cpu:reference notices.
#include "tests/kernels/fault_params.h"

#define RG_PARAMS test_fault_params
#define RG_SLOTS  OUT(1, uint, target)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(test_fault)
{
    target_put(rg, x + p.offset, 1u);
}
