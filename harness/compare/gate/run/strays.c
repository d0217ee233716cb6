#include "harness/compare/gate/run/strays.h"

#include <inttypes.h>
#include <stdio.h>

#include "core/base/log.h"
#include "harness/compare/gate/text/glob.h"

static bool is_of_none(const struct rg_expectation *row, const struct rg_gate_cells *cells)
{
    bool any = false;
    for (int64_t i = 0; !any && i < cells->count; i++)
        any = rg_glob(row->cell, cells->cells[i].name);
    return !any;
}

// The field by which an expectation is of none of these; -1: it may be of one.
static int strange_field(const struct rg_expectation *row, const struct rg_gate_target *targets,
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

// What is looked for.
struct search {
    const struct rg_known *known;
    const struct rg_gate_cells *cells;
    const struct rg_gate_target *targets; // NULL: cells alone
    int target_count;
};

// The pattern of an expectation that nothing has, and what it is of; NULL: there is none.
static const char *stray_of(const struct search *s, const struct rg_expectation *row,
                            const char **of)
{
    const bool is_stray = is_of_none(row, s->cells);
    *of = "cell";
    if (!s->targets || is_stray)
        return is_stray && !s->targets ? row->cell : NULL;
    const int field = strange_field(row, s->targets, s->target_count);
    *of = field == RG_FIELD_DRIVER ? "driver" : "device";
    return field < 0 ? NULL : row->values[field];
}

static int64_t warn_of_file(const struct search *s, int file)
{
    const struct rg_expectation *first = NULL;
    const char *pattern = NULL, *of = NULL, *found, *found_of;
    int64_t count = 0;
    for (int64_t i = 0; i < s->known->count; i++) {
        const struct rg_expectation *row = &s->known->rows[i];
        if (row->file != file || !(found = stray_of(s, row, &found_of)))
            continue;
        if (!count++) {
            first = row;
            pattern = found;
            of = found_of;
        }
    }
    char more[64] = "";
    if (count > 1)
        snprintf(more, sizeof(more), ", and %" PRId64 " more of this file", count - 1);
    if (first)
        rg_warning("%s:%" PRId64 ": '%.80s' is of no %s of this gate%s; mend the pattern, or "
                   "take the expectation out",
                   s->known->files[file].lines.name, first->line + 1, pattern, of, more);
    return count;
}

static int64_t warn_of_files(const struct search *s)
{
    int64_t count = 0;
    for (int file = 0; file < s->known->file_count; file++)
        if (s->known->files[file].form == RG_FORM_OWN)
            count += warn_of_file(s, file);
    return count;
}

int64_t rg_gate_warn_of_strays(const struct rg_known *known, const struct rg_gate_cells *cells)
{
    return warn_of_files(&(struct search){.known = known, .cells = cells});
}

int64_t rg_gate_warn_of_strange(const struct rg_known *known, const struct rg_gate_cells *cells,
                                const struct rg_gate_target *targets, int count)
{
    return warn_of_files(&(struct search){known, cells, targets, count});
}

// --- days ---

static bool is_to_come(const struct rg_expectation *row, int today)
{
    return row->since > today;
}

// Nobody looks at it again before people and drivers have changed.
static bool is_far(const struct rg_expectation *row, int today)
{
    enum { YEAR_DAYS = 366 };
    return row->values[RG_FIELD_UNTIL] && row->until - today > YEAR_DAYS;
}

static int64_t warn_of_day(const struct rg_known *known, int file, int today,
                           bool (*is_odd)(const struct rg_expectation *row, int today),
                           enum rg_known_field field, const char *says)
{
    const struct rg_expectation *first = NULL;
    int64_t count = 0;
    for (int64_t i = 0; i < known->count; i++)
        if (known->rows[i].file == file && is_odd(&known->rows[i], today) && !count++)
            first = &known->rows[i];
    char more[64] = "";
    if (count > 1)
        snprintf(more, sizeof(more), ", and %" PRId64 " more of this file", count - 1);
    if (first)
        rg_warning("%s:%" PRId64 ": %s %s: %s%s", known->files[file].lines.name,
                   first->at[field] + 1, field == RG_FIELD_SINCE ? "since" : "until",
                   first->values[field], says, more);
    return count;
}

int64_t rg_gate_warn_of_days(const struct rg_known *known, int today)
{
    int64_t count = 0;
    for (int file = 0; file < known->file_count; file++) {
        if (known->files[file].form != RG_FORM_OWN)
            continue;
        count += warn_of_day(known, file, today, is_to_come, RG_FIELD_SINCE,
                             "is to come, so that nothing is expected until then");
        count += warn_of_day(known, file, today, is_far, RG_FIELD_UNTIL,
                             "is more than a year away; name a day on which somebody looks again");
    }
    return count;
}
