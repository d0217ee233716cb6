#include "harness/compare/gate/run/keep.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/interrupt.h"
#include "harness/record/output.h"

bool rg_keep_open(const struct rg_gate_request *asked, json_t *key, struct rg_kept_times **kept)
{
    if (!asked->folder || asked->pictures_only) {
        json_decref(key);
        return true;
    }
    *kept = rg_kept_times_open(asked->folder, key, asked->fresh);
    const int count = *kept ? rg_kept_times_count(*kept) : 0;
    if (count)
        rg_info("%s: has times of %d launches of a gate that was interrupted, which goes on",
                asked->folder, count);
    return *kept;
}

void rg_keep_expect(struct rg_kept_times *kept, const struct rg_gate_case *c)
{
    char code[RG_AGREEMENT_CODE];
    if (!kept || !c->is_timed)
        return;
    rg_agreement_code(&c->agreement, code);
    rg_kept_times_expect(kept, c->name, code);
}

// Without a launch there is no file, and one that a gate before has left is none of this gate's.
static bool write_launches(const char *folder, const char *csv)
{
    char path[4096];
    if (*csv)
        return rg_output_write(folder, RG_GATE_LAUNCHES, csv);
    snprintf(path, sizeof(path), "%s/" RG_GATE_LAUNCHES, folder);
    return !unlink(path) || errno == ENOENT ||
           rg_system_error(errno, "%s: cannot be removed: %s", path, strerror(errno));
}

bool rg_keep_close(const struct rg_gate_request *asked, struct rg_kept_times *kept, bool is_done)
{
    char *csv = kept && is_done ? rg_kept_times_csv(kept) : NULL;
    const bool ok = !kept || !is_done || (csv && write_launches(asked->folder, csv));
    free(csv);
    rg_kept_times_close(kept, is_done && ok);
    if (rg_interrupted() && asked->folder)
        rg_info("gate: interrupted; the same command goes on");
    return ok;
}
