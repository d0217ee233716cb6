// googletest's shards: cases that several machines share among them.
// https://google.github.io/googletest/advanced.html
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/files/file.h"
#include "core/base/log.h"
#include "harness/compare/gate/report/gtest.h"

static bool read_number(const char *variable, int *number)
{
    const char *text = getenv(variable);
    char *end;
    const long value = strtol(text, &end, 10);
    *number = (int)value;
    return (end != text && !*end && value >= 0 && value <= INT_MAX) ||
           rg_error(
               "%s '%.40s': must be a whole number from 0 to %d; unset it, or count shards with "
               "it",
               variable, text, INT_MAX);
}

// The file by which a runner knows that shards are understood: it need only be there, so that what
// it holds already stays.
static bool tell_runner(void)
{
    const char *path = getenv("GTEST_SHARD_STATUS_FILE"), *why;
    if (!path || !*path)
        return true;
    FILE *file = rg_file_append(path, &why);
    return (file && fclose(file) == 0) ||
           rg_system_error(errno,
                           "%s: cannot be written: %s; $GTEST_SHARD_STATUS_FILE names a file", path,
                           file ? strerror(errno) : why);
}

bool rg_gtest_shards(struct rg_gtest_shards *shards)
{
    const bool has_total = getenv("GTEST_TOTAL_SHARDS"), has_index = getenv("GTEST_SHARD_INDEX");
    *shards = (struct rg_gtest_shards){.total = 1};
    if (!tell_runner())
        return false;
    if (!has_total && !has_index)
        return true;
    if (!has_total || !has_index)
        return rg_error("GTEST_TOTAL_SHARDS and GTEST_SHARD_INDEX: one of them is not set; set "
                        "both, or none");
    return read_number("GTEST_TOTAL_SHARDS", &shards->total) &&
           read_number("GTEST_SHARD_INDEX", &shards->index) &&
           (shards->index < shards->total ||
            rg_error("GTEST_SHARD_INDEX %d: must be below GTEST_TOTAL_SHARDS, which is %d",
                     shards->index, shards->total));
}
