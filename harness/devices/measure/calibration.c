#include "harness/devices/measure/calibration.h"

#include <stdint.h>
#include <string.h>

#include "harness/console/clock.h"

enum { STEPS = 400000, WORDS = 1 << 18 }; // 2 MiB

// The median of three counts, because a virtual machine may pause for longer than a load, which
// says nothing of its speed.
enum { LOADS = 3 };

// Each step depends on the one before it, so that neither vector width nor reordering changes the
// load.
static uint64_t chain(uint64_t x)
{
    for (int i = 0; i < STEPS; i++) {
        x ^= x << 13;
        x ^= x >> 7;
        x ^= x << 17;
    }
    return x;
}

static uint64_t sweep(uint64_t *words, uint64_t x)
{
    uint64_t sum = 0;
    for (int i = 0; i < WORDS; i++)
        words[i] = x + (uint64_t)i;
    for (int i = 0; i < WORDS; i++)
        sum += words[i] ^ (uint64_t)i;
    return sum;
}

void rg_calibration_load(void)
{
    static uint64_t words[WORDS];
    static volatile uint64_t kept; // keeps the compiler from removing the work
    kept = sweep(words, chain(88172645463325252u + kept % 2));
}

void rg_calibration_take(struct rg_calibration *calibration)
{
    if (!calibration->load || calibration->count > RG_MAX_SAMPLES)
        return;
    double ms[LOADS];
    for (int i = 0; i < LOADS; i++) {
        const double start = rg_now_ms();
        calibration->load();
        ms[i] = rg_now_ms() - start;
    }
    calibration->ms[calibration->count++] = rg_median(ms, LOADS).median;
}

static double median_from(const struct rg_calibration *calibration, int first, int count)
{
    double ms[RG_MAX_SAMPLES + 1];
    memcpy(ms, calibration->ms + first, (size_t)count * sizeof(*ms));
    return rg_median(ms, count).median;
}

void rg_calibration_tell(const struct rg_calibration *calibration, double *begin_ms, double *end_ms)
{
    const int third = (calibration->count + 2) / 3;
    *begin_ms = third ? median_from(calibration, 0, third) : 0;
    *end_ms = third ? median_from(calibration, calibration->count - third, third) : 0;
}
