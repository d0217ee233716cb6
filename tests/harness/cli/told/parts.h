// Stand-ins for records of shards: reading finds two, or none.
#ifndef RG_TESTS_HARNESS_CLI_TOLD_PARTS_H
#define RG_TESTS_HARNESS_CLI_TOLD_PARTS_H

#include "harness/record/disk/parts.h"
#include "tests/harness/cli/asked.h"
#include "tests/harness/cli/told/steps.h"

static bool is_found; // shards left records

bool rg_parts_read(struct rg_parts *parts, const char *kind, const char *path)
{
    static json_t *of;
    of = of ? of : json_pack("{ss}", "expectations", "k1");
    asked_note("%s records of %s; ", kind, path);
    *parts = (struct rg_parts){.count = is_found ? 2 : 0, .of = of};
    return does("parts");
}

void rg_parts_free(struct rg_parts *parts)
{
    asked_note("free %d", parts->count);
}

#endif
