#include "tests/oracle/drops/random.h"

#include <math.h>

static uint64_t split_mix(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

struct oracle_random oracle_random_open(uint64_t seed, uint64_t stream)
{
    uint64_t mixed = stream;
    mixed = split_mix(&mixed) ^ seed;
    struct oracle_random random;
    for (int i = 0; i < 4; i++)
        random.state[i] = split_mix(&mixed);
    return random;
}

static uint64_t rotated(uint64_t x, int bits)
{
    return x << bits | x >> (64 - bits);
}

static uint64_t next(struct oracle_random *random)
{
    uint64_t *s = random->state;
    const uint64_t result = rotated(s[0] + s[3], 23) + s[0];
    const uint64_t t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = rotated(s[3], 45);
    return result;
}

double oracle_random_uniform(struct oracle_random *random, double low, double high)
{
    return low + (high - low) * ldexp((double)(next(random) >> 11), -53);
}

// Box and Muller's method, without its sine.
double oracle_random_normal(struct oracle_random *random, double mean, double deviation)
{
    const double radius = sqrt(-2 * log(1 - oracle_random_uniform(random, 0, 1)));
    return mean + deviation * radius * cos(2 * M_PI * oracle_random_uniform(random, 0, 1));
}
