#include "harness/compare/gate/cells/unused.h"

#include <inttypes.h>
#include <stdio.h>

#include "core/base/log.h"
#include "harness/compare/gate/text/glob.h"
#include "shaders/fixed/fixed.h"

static bool is_of_none(const struct rg_expectation *row, const struct rg_gate_cells *cells)
{
    bool any = false;
    for (int64_t i = 0; !any && i < cells->count; i++)
        any = rg_glob(row->cell, cells->cells[i].name);
    for (int i = 0; !any && i < rg_fixed_count(); i++)
        any = rg_glob(row->cell, rg_gate_fixed_cell(i));
    return !any;
}

// The field by which an expectation matches none of the targets; -1: it may match one.
static int unmatched_field(const struct rg_expectation *row, const struct rg_gate_target *targets,
                           int count)
{
    const char *device = row->values[RG_FIELD_DEVICE], *driver = row->values[RG_FIELD_DRIVER];
    bool any = false;
    for (int i = 0; i < count; i++) {
        if (device && !rg_glob(device, targets[i].device))
            continue;
        if (!driver || !targets[i].driver || rg_glob(driver, targets[i].driver))
            return -1;
        any = true;
    }
    return any ? RG_FIELD_DRIVER : RG_FIELD_DEVICE;
}

// The input of the warnings.
struct search {
    const struct rg_known *known;
    const struct rg_gate_cells *cells;
    const struct rg_gate_target *targets; // NULL: cells alone
    int target_count;
    int today;
};

// A warning about an expectation: its line, and two parts of a message, with the number of similar
// expectations between them.
struct odd {
    int64_t line;
    char says[200];
    const char *mend;
};
typedef bool (*looker)(const struct search *s, const struct rg_expectation *row, struct odd *odd);

// Logs one line per file and kind of warning. Mesa's files are skipped, since they belong to other
// suites too.
static int64_t warn(const struct search *s, const looker *looks, int look_count)
{
    int64_t all = 0;
    for (int i = 0; i < s->known->file_count * look_count; i++) {
        const struct rg_known_file *file = &s->known->files[i / look_count];
        int64_t count = 0;
        struct odd first, odd;
        char more[64] = "";
        for (int64_t k = 0; file->form == RG_FORM_OWN && k < s->known->count; k++) {
            const struct rg_expectation *row = &s->known->rows[k];
            if (row->file == i / look_count && looks[i % look_count](s, row, &odd) && !count++)
                first = odd;
        }
        if (count > 1)
            snprintf(more, sizeof(more), ", and %" PRId64 " more of this file", count - 1);
        if (count)
            rg_warning("%s:%" PRId64 ": %s%s%s", file->lines.name, first.line + 1, first.says, more,
                       first.mend);
        all += count;
    }
    return all;
}

// --- patterns that match nothing ---

static bool is_unused(const struct search *s, const struct rg_expectation *row, struct odd *odd)
{
    const bool has_cell = !is_of_none(row, s->cells);
    const int field =
        s->targets && has_cell ? unmatched_field(row, s->targets, s->target_count) : -1;
    if (s->targets ? field < 0 : has_cell)
        return false;
    odd->line = row->line;
    snprintf(odd->says, sizeof(odd->says), "'%.80s' is of no %s of this gate",
             s->targets ? row->values[field] : row->cell,
             !s->targets                ? "cell"
             : field == RG_FIELD_DRIVER ? "driver"
                                        : "device");
    odd->mend = "; mend the pattern, or take the expectation out";
    return true;
}

int64_t rg_gate_warn_of_unused(const struct rg_known *known, const struct rg_gate_cells *cells)
{
    return warn(&(struct search){.known = known, .cells = cells}, &(looker){is_unused}, 1);
}

int64_t rg_gate_warn_of_unused_on(const struct rg_known *known, const struct rg_gate_cells *cells,
                                  const struct rg_gate_target *targets, int count)
{
    return warn(&(struct search){known, cells, targets, count, 0}, &(looker){is_unused}, 1);
}

// --- days ---

static bool is_day(const struct rg_expectation *row, enum rg_known_field field, const char *says,
                   struct odd *odd)
{
    odd->line = row->at[field];
    snprintf(odd->says, sizeof(odd->says), "%s %s: %s", field == RG_FIELD_SINCE ? "since" : "until",
             row->values[field], says);
    odd->mend = "";
    return true;
}

static bool is_to_come(const struct search *s, const struct rg_expectation *row, struct odd *odd)
{
    return row->since > s->today &&
           is_day(row, RG_FIELD_SINCE, "is to come, so that nothing is expected until then", odd);
}

// After so long, people and drivers have changed, and nobody looks at it again.
static bool is_far(const struct search *s, const struct rg_expectation *row, struct odd *odd)
{
    enum { YEAR_DAYS = 366 };
    return row->values[RG_FIELD_UNTIL] && row->until - s->today > YEAR_DAYS &&
           is_day(row, RG_FIELD_UNTIL,
                  "is more than a year away; name a day on which somebody looks again", odd);
}

int64_t rg_gate_warn_of_days(const struct rg_known *known, int today)
{
    const looker looks[] = {is_to_come, is_far};
    return warn(&(struct search){.known = known, .today = today}, looks, 2);
}
