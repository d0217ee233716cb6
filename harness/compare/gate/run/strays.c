#include "harness/compare/gate/run/strays.h"

#include <inttypes.h>

#include "core/base/log.h"
#include "harness/compare/gate/text/glob.h"

static bool is_of_none(const struct rg_expectation *row, const struct rg_gate_cells *cells)
{
    bool any = false;
    for (int64_t i = 0; !any && i < cells->count; i++)
        any = rg_glob(row->cell, cells->cells[i].name);
    return !any;
}

static int64_t warn_of_file(const struct rg_known *known, int file,
                            const struct rg_gate_cells *cells)
{
    const struct rg_expectation *first = NULL;
    int64_t count = 0;
    for (int64_t i = 0; i < known->count; i++) {
        const struct rg_expectation *row = &known->rows[i];
        if (row->file != file || !is_of_none(row, cells))
            continue;
        first = first ? first : row;
        count++;
    }
    char more[64] = "";
    if (count > 1)
        snprintf(more, sizeof(more), ", and %" PRId64 " more of this file", count - 1);
    if (first)
        rg_warning("%s:%" PRId64 ": '%.80s' is of no cell of this gate%s; mend the pattern, or "
                   "take the expectation out",
                   known->files[file].lines.name, first->line + 1, first->cell, more);
    return count;
}

int64_t rg_gate_warn_of_strays(const struct rg_known *known, const struct rg_gate_cells *cells)
{
    int64_t count = 0;
    for (int file = 0; file < known->file_count; file++)
        if (known->files[file].form == RG_FORM_OWN)
            count += warn_of_file(known, file, cells);
    return count;
}
