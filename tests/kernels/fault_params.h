// The parameters of fault.h.
#ifndef RG_TESTS_KERNELS_FAULT_PARAMS_H
#define RG_TESTS_KERNELS_FAULT_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(test_fault_params)
{
    int offset;
};
RG_STRUCT_SIZE(test_fault_params, 1)

#endif
