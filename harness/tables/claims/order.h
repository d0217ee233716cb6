// Tests whether one cell is faster than another, from their samples.
#ifndef RG_HARNESS_TABLES_CLAIMS_ORDER_H
#define RG_HARNESS_TABLES_CLAIMS_ORDER_H

// The p value of Mann and Whitney's test (1947), small if `low` is truly lower. It is the
// probability that of two sets of independent samples from one distribution, the first is at least
// as far below the second as `low` is below `high`. Each value of `low` is multiplied by `factor`
// first. Exact for up to 20 samples each, otherwise by the normal distribution.
double rg_order_probability(const double *low, int low_count, double factor, const double *high,
                            int high_count);

#endif
