// The two operations that GLSL lets be inexact. Each device is tested on them when it is opened
// (backends/asked/rounding.h).
#include "kernels/probe/rough_params.h"

#define RG_PARAMS probe_rough_params
#define RG_SLOTS  IN(1, uint, first) IN(2, uint, second) OUT(3, uint, result)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(probe_rough)
{
    float a = rg_bits_float(first_at(rg, x));
    float b = rg_bits_float(second_at(rg, x));
    uint quotient = rg_float_bits(a / b);
    uint root = rg_float_bits(rg_sqrt(rg_abs(a)));
    result_put(rg, x, p.roots != 0 ? root : quotient);
}
