// Whether one cell is faster than another, from their samples.
#ifndef RG_HARNESS_TABLES_CLAIMS_ORDER_H
#define RG_HARNESS_TABLES_CLAIMS_ORDER_H

// The probability that, of two sets of independent samples of one distribution, the first lies as
// far below the second as `low` lies below `high`, or farther (Mann and Whitney, 1947): small where
// `low` is truly lower. Each value of `low` is multiplied by `factor` first. Exact for up to 20
// samples each, else by the normal distribution.
double rg_order_probability(const double *low, int low_count, double factor, const double *high,
                            int high_count);

// The probability that, of independent samples whose median is `bound`, as many lie below it as of
// these do, or more (the sign test): small where their median is truly lower. With `side` -1
// instead of 1, above it. Samples that are equal to it count neither way.
double rg_sign_probability(const double *samples, int count, double bound, int side);

#endif
