// Whether one cell is faster than another, from their samples.
#ifndef RG_HARNESS_TABLES_CLAIMS_ORDER_H
#define RG_HARNESS_TABLES_CLAIMS_ORDER_H

// The probability that, of two sets of independent samples of one distribution, the first lies as
// far below the second as `low` lies below `high`, or farther (Mann and Whitney, 1947): small where
// `low` is truly lower. Each value of `low` is multiplied by `factor` first. Exact for up to 20
// samples each, else by the normal distribution.
double rg_order_probability(const double *low, int low_count, double factor, const double *high,
                            int high_count);

#endif
