#include "harness/record/shard.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/text/add.h"

struct load {
    double seconds;
    int64_t thing;
};

// The largest first; of equal ones the first.
static int compare(const void *a, const void *b)
{
    const struct load *x = a, *y = b;
    return x->seconds != y->seconds ? (x->seconds < y->seconds ? 1 : -1)
                                    : (x->thing > y->thing) - (x->thing < y->thing);
}

static int least(const double *seconds, int count)
{
    int found = 0;
    for (int i = 1; i < count; i++)
        found = seconds[i] < seconds[found] ? i : found;
    return found;
}

bool rg_shard_cut(const double *seconds, int64_t count, int shards, int *shard_of,
                  double *longest_s)
{
    const int used = shards < count ? shards : (int)count; // the others get nothing
    struct load *loads = rg_alloc((size_t)count, sizeof(*loads), "shards");
    double *taken = rg_alloc((size_t)used, sizeof(*taken), "shards");
    const bool ok = loads && taken;
    for (int64_t i = 0; ok && i < count; i++)
        loads[i] = (struct load){seconds[i], i};
    if (ok && count)
        qsort(loads, (size_t)count, sizeof(*loads), compare);
    for (int64_t i = 0; ok && i < count; i++) {
        const int shard = least(taken, used);
        taken[shard] += loads[i].seconds;
        shard_of[loads[i].thing] = shard + 1;
    }
    if (ok && longest_s) {
        *longest_s = 0;
        for (int i = 0; i < used; i++)
            *longest_s = taken[i] > *longest_s ? taken[i] : *longest_s;
    }
    free(loads);
    free(taken);
    return ok;
}

void rg_shard_array(const bool *has, int count, char *text, size_t size)
{
    *text = 0;
    for (int i = 0; i < count; i++) {
        int end = i;
        while (end < count && has[end])
            end++;
        if (end == i)
            continue;
        rg_text_add(text, size, ",", "%d", i + 1);
        if (end - i > 1)
            rg_text_add(text, size, "", "-%d", end);
        i = end;
    }
}
