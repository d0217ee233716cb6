// The parameters of atomics.h.
#ifndef RG_TESTS_KERNELS_ATOMICS_PARAMS_H
#define RG_TESTS_KERNELS_ATOMICS_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(test_atomics_params)
{
    int buckets; // words a kind of operation
};
RG_STRUCT_SIZE(test_atomics_params, 1)

#endif
