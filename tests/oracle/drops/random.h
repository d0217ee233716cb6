// The oracle's own random numbers: xoshiro256++ of Blackman and Vigna, with its state filled by
// splitmix64.
#ifndef RG_TESTS_ORACLE_DROPS_RANDOM_H
#define RG_TESTS_ORACLE_DROPS_RANDOM_H

#include <stdint.h>

struct oracle_random {
    uint64_t state[4];
};

// Streams of one seed are independent.
struct oracle_random oracle_random_open(uint64_t seed, uint64_t stream);
// From low up to, but without, high.
double oracle_random_uniform(struct oracle_random *random, double low, double high);
double oracle_random_normal(struct oracle_random *random, double mean, double deviation);

#endif
