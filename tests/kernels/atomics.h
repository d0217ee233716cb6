// Every atomic of the dialect, with many items on few words: tests that no device loses one.
#include "tests/kernels/atomics_params.h"

#define RG_PARAMS test_atomics_params
#define RG_SLOTS  ATOMIC(1, uint, counts) ATOMIC(2, int, extremes)
#include "kernels/dialect/slots/slots.h"

// counts: sums, then or-ed bits, then maxima by exchange; extremes: minima, then maxima.
RG_GRID_KERNEL(test_atomics)
{
    int bucket = x % p.buckets;
    counts_add(rg, bucket, rg_to_uint(x));
    counts_or(rg, p.buckets + bucket, 1u << rg_to_uint((x / p.buckets) & 31));
    uint seen = counts_load(rg, 2 * p.buckets + bucket);
    for (int attempts = 0; attempts < 1000000 && seen < rg_to_uint(x); attempts++) {
        uint before = counts_exchange_if(rg, 2 * p.buckets + bucket, seen, rg_to_uint(x));
        seen = before == seen ? rg_to_uint(x) : before;
    }
    extremes_min(rg, bucket, 1000 - x);
    extremes_max(rg, p.buckets + bucket, x - 1000);
    if (x < p.buckets)
        extremes_store(rg, 2 * p.buckets + bucket, -x);
}
