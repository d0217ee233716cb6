// The slots of ops.h and builtin.h: the bits of three inputs for each item, and the result's bits.
#include "kernels/probe/list.h"
#include "kernels/probe/ops_params.h"

#define RG_PARAMS probe_params
#define RG_SLOTS  IN(1, uint, first) IN(2, uint, second) IN(3, uint, third) OUT(4, uint, result)
#include "kernels/dialect/slots/slots.h"

#define RG_PROBE_BITS_FLOAT(e) rg_float_bits(e)
#define RG_PROBE_BITS_UINT(e)  (e)
#define RG_PROBE_TRY(number, name, inputs, result, e)                                              \
    if (op == number)                                                                              \
        bits = RG_PROBE_BITS_##result(e);
