// Multiplies and adds as fast as a device can: eight independent chains of x * factor + term, 32
// steps each, and their sum. doctor calls this rate the arithmetic limit.
#include "kernels/probe/arithmetic_params.h"

#define RG_PARAMS probe_arithmetic_params
#define RG_SLOTS  OUT(1, float, sums)
#include "kernels/dialect/slots/slots.h"

#define CHAIN_STEP(v) v = v * p.factor + p.term;
#define CHAINS_STEP                                                                                \
    CHAIN_STEP(a)                                                                                  \
    CHAIN_STEP(b)                                                                                  \
    CHAIN_STEP(c) CHAIN_STEP(d) CHAIN_STEP(e) CHAIN_STEP(f) CHAIN_STEP(g) CHAIN_STEP(h)
#define CHAINS_8_STEPS                                                                             \
    CHAINS_STEP CHAINS_STEP CHAINS_STEP CHAINS_STEP CHAINS_STEP CHAINS_STEP CHAINS_STEP CHAINS_STEP

RG_GRID_KERNEL(probe_arithmetic)
{
    float a = rg_to_float(x) * 1.0e-6f;
    float b = a + 0.1f;
    float c = a + 0.2f;
    float d = a + 0.3f;
    float e = a + 0.4f;
    float f = a + 0.5f;
    float g = a + 0.6f;
    float h = a + 0.7f;
    CHAINS_8_STEPS
    CHAINS_8_STEPS
    CHAINS_8_STEPS
    CHAINS_8_STEPS
    sums_put(rg, x, ((a + b) + (c + d)) + ((e + f) + (g + h)));
}
