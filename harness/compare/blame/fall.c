#include "harness/compare/blame/fall.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/text/plain.h"
#include "harness/devices/workers/device.h"

struct rg_fall rg_fall_now(struct rg_device *device)
{
    struct rg_worker *worker = rg_remote_worker(device);
    struct rg_fall fall = {.outcome = RG_OK};
    const struct rg_failure failure = rg_failure_take();
    if (failure.fault != RG_FAULT_DRIVER || !worker)
        return fall;
    fall.outcome = failure.outcome;
    const char *what = fall.outcome == RG_ERROR ? failure.line : rg_worker_end_doing(worker);
    what += strspn(what, " ");
    snprintf(fall.what, sizeof(fall.what), "%s", *what ? what : "at its start");
    rg_plain(fall.what);
    rg_worker_renew(worker);
    return fall;
}

bool rg_fall_is_same(const struct rg_fall *a, const struct rg_fall *b)
{
    return a->outcome == b->outcome && !strcmp(a->what, b->what);
}

// Whether a line names a kernel in quotes, or one of its packing kernels.
static bool names(const char *line, const char *kernel)
{
    static const char *const ends[] = {"'", "_count'", "_emit'"};
    const size_t length = strlen(kernel);
    for (const char *at = line; length && (at = strchr(at, '\'')); at++)
        for (int i = 0; i < 3; i++)
            if (!strncmp(at + 1, kernel, length) &&
                !strncmp(at + 1 + length, ends[i], strlen(ends[i])))
                return true;
    return false;
}

int rg_fall_row(const struct rg_fall *fall, const struct rg_digests *digests)
{
    for (int i = 0; i < digests->count; i++)
        if (names(fall->what, digests->rows[i].stage))
            return i;
    return digests->count - 1;
}
