#include "core/device/scan.h"

#include <limits.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/device/grid.h"
#include "core/device/objects.h"
#include "kernels/scan/params.h"

enum { MAX_LEVELS = 6, MAX_COUNT = 1 << 30 };

struct rg_scan {
    struct rg_device *device;
    int max_count;
    struct rg_pass *sum_chunks, *spread, *compact;
    struct rg_buf *nothing; // one word 0: the sum before the first chunk
    // sums[l] holds the sum of each chunk of level l - 1, before[l] their prefix sums. The caller
    // has those of level 0.
    struct rg_buf *sums[MAX_LEVELS];
    struct rg_buf *before[MAX_LEVELS];
};

static int chunks_of(int count)
{
    return count > RG_SCAN_CHUNK ? (count - 1) / RG_SCAN_CHUNK + 1 : 1;
}

static bool create_levels(struct rg_scan *scan)
{
    int count = scan->max_count;
    for (int level = 1; level == 1 || count > 1; level++) {
        count = chunks_of(count);
        scan->sums[level] = rg_buf_create(scan->device, (int64_t)count * 4, "scan sums");
        scan->before[level] = rg_buf_create(scan->device, ((int64_t)count + 1) * 4, "scan before");
        if (!scan->sums[level] || !scan->before[level])
            return false;
    }
    return true;
}

struct rg_scan *rg_scan_create(struct rg_device *device, int max_count)
{
    if (max_count < 1 || max_count > MAX_COUNT)
        return rg_error_null("scan: %d elements; at least 1 and at most %d", max_count, MAX_COUNT);
    struct rg_scan *scan = rg_alloc(1, sizeof(*scan), "scan");
    if (!scan)
        return NULL;
    scan->device = device;
    scan->max_count = max_count;
    const unsigned zero = 0;
    if ((scan->sum_chunks = rg_grid_create(device, "scan_sums")) &&
        (scan->spread = rg_grid_create(device, "scan_spread")) &&
        (scan->compact = rg_grid_create(device, "scan_compact")) &&
        (scan->nothing = rg_buf_create_with(device, &zero, sizeof(zero), "scan nothing")) &&
        create_levels(scan))
        return scan;
    rg_scan_destroy(scan);
    return NULL;
}

void rg_scan_destroy(struct rg_scan *scan)
{
    if (!scan)
        return;
    for (int level = 1; level < MAX_LEVELS; level++) {
        rg_buf_destroy(scan->sums[level]);
        rg_buf_destroy(scan->before[level]);
    }
    rg_buf_destroy(scan->nothing);
    rg_grid_destroy(scan->sum_chunks);
    rg_grid_destroy(scan->spread);
    rg_grid_destroy(scan->compact);
    free(scan);
}

static bool run_sum_chunks(struct rg_scan *scan, struct rg_buf *values, struct rg_buf *sums,
                           int count, bool flags)
{
    const struct scan_params params = {.count = count, .flags = flags};
    return rg_grid_run(scan->sum_chunks, &(struct rg_run){
                                             .params = &params,
                                             .slots = {[1].buf = values, [2].buf = sums},
                                             .extent = {chunks_of(count), 1, 1},
                                         });
}

static bool run_spread(struct rg_scan *scan, struct rg_buf *values, struct rg_buf *before,
                       struct rg_buf *sums, int count)
{
    const struct scan_params params = {.count = count};
    return rg_grid_run(scan->spread,
                       &(struct rg_run){
                           .params = &params,
                           .slots = {[1].buf = values, [2].buf = before, [3].buf = sums},
                           .extent = {chunks_of(count), 1, 1},
                       });
}

// Makes the prefix sums of level 1 from its `count` sums: sums go up level by level, then prefix
// sums come down.
static bool scan_levels(struct rg_scan *scan, int count)
{
    int counts[MAX_LEVELS] = {0, count};
    int top = 1;
    for (; counts[top] > RG_SCAN_CHUNK; top++) {
        counts[top + 1] = chunks_of(counts[top]);
        if (!run_sum_chunks(scan, scan->sums[top], scan->sums[top + 1], counts[top], false))
            return false;
    }
    for (int level = top; level >= 1; level--)
        if (!run_spread(scan, scan->sums[level],
                        level == top ? scan->nothing : scan->before[level + 1], scan->before[level],
                        counts[level]))
            return false;
    return true;
}

// Refuses a buffer that is too small, since a kernel could not notice.
static bool check_words(const struct rg_buf *buf, int64_t words)
{
    if ((int64_t)(buf->size / 4) < words)
        return rg_error("scan: buffer '%s' holds %zu words, and %lld are needed", buf->name,
                        buf->size / 4, (long long)words);
    return true;
}

static bool check_count(const struct rg_scan *scan, int count)
{
    if (count < 0 || count > scan->max_count)
        return rg_error("scan: %d elements; this one was made for 0 to %d", count, scan->max_count);
    return true;
}

bool rg_scan_sum(struct rg_scan *scan, struct rg_buf *values, struct rg_buf *sums, int count)
{
    return check_count(scan, count) && check_words(values, count) &&
           check_words(sums, (int64_t)count + 1) &&
           run_sum_chunks(scan, values, scan->sums[1], count, false) &&
           scan_levels(scan, chunks_of(count)) &&
           run_spread(scan, values, scan->before[1], sums, count);
}

bool rg_scan_compact(struct rg_scan *scan, struct rg_buf *flags, struct rg_buf *indices,
                     struct rg_buf *found, int count)
{
    if (!check_count(scan, count) || !check_words(flags, count) ||
        !run_sum_chunks(scan, flags, scan->sums[1], count, true) ||
        !scan_levels(scan, chunks_of(count)))
        return false;
    const size_t capacity = indices->size / 4;
    const struct scan_params params = {.count = count,
                                       .capacity = capacity > INT_MAX ? INT_MAX : (int)capacity};
    return rg_grid_run(
        scan->compact,
        &(struct rg_run){
            .params = &params,
            .slots =
                {[1].buf = flags, [2].buf = scan->before[1], [3].buf = indices, [4].buf = found},
            .extent = {chunks_of(count), 1, 1},
        });
}
