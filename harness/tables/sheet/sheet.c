#include "harness/tables/sheet/sheet.h"

#include <inttypes.h>
#include <stddef.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/devices/measure/timer_audit.h"

// A frame's work: items of runs, packed primitives, and shaded fragments.
enum { TALLIED = 3 };
static const struct {
    const char *name;
    size_t offset;
} tallied[TALLIED] = {{"items", offsetof(struct rg_tally, items)},
                      {"records", offsetof(struct rg_tally, records)},
                      {"fragments", offsetof(struct rg_tally, fragments)}};

// The index of each column; -1: not in this table.
struct columns {
    int row[RG_MAX_VALUES];       // keys that identify rows
    int published[RG_MAX_VALUES]; // printed values
    int told[RG_MAX_VALUES];      // the measured value for the printed one of the same index
    int counted[RG_MAX_COUNTED];
    int tallied[TALLIED];
    int work, variant, device, fps, mark, ms, ms_range, ratio, times, first, api, error, passes;
};

bool rg_is_frame_rate(const struct rg_named *published)
{
    return !strcmp(published->name, "fps");
}

// The first record, which has the names of all; NULL if there are no rows.
static const struct rg_record *first_of(const struct rg_result *result)
{
    struct rg_place at = rg_result_start(result);
    return rg_result_next(result, &at) ? rg_result_at(result, at) : NULL;
}

// The first record of a cell with counts; NULL if there is none.
static const struct rg_record *first_counted(const struct rg_result *result)
{
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);)
        if (rg_result_at(result, at)->counted_count)
            return rg_result_at(result, at);
    return NULL;
}

static bool any_tallied(const struct rg_result *result)
{
    bool any = false;
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);)
        any = any || rg_result_at(result, at)->has_tally;
    return any;
}

// The record of cpu:reference in a row, or NULL.
static const struct rg_record *reference_of(const struct rg_result *result, struct rg_place at)
{
    for (at.device = 0; at.device < result->device_count; at.device++)
        if (!strcmp(result->devices[at.device].name, "cpu:reference"))
            return rg_result_at(result, at);
    return NULL;
}

// --- the columns ---

static bool is_told(const struct rg_result *result, const char *name)
{
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        const struct rg_record *record = rg_result_at(result, at);
        if (rg_named_number(record->facts, record->fact_count, name))
            return true;
    }
    return false;
}

static void add_times(struct rg_sheet *sheet, struct columns *at, bool is_published)
{
    at->mark = rg_sheet_column(sheet, "noise");
    at->ms = rg_sheet_column(sheet, "ms");
    at->ms_range = rg_sheet_column(sheet, "ms, 95 %%");
    if (is_published)
        at->ratio = rg_sheet_column(sheet, "fps / published");
    at->times = rg_sheet_column(sheet, "x cpu:reference");
    at->first = rg_sheet_column(sheet, "first frame ms");
    at->api = rg_sheet_column(sheet, "API / wall clock");
}

// Adds columns for keys, then for printed values: the frame rate last.
static void add_row_columns(const struct rg_record *first, struct rg_sheet *sheet,
                            struct columns *at)
{
    for (int i = 0; first && i < first->row_count; i++)
        at->row[i] = rg_sheet_column(sheet, "%s", first->row[i].name);
    for (int is_rate = 0; first && is_rate < 2; is_rate++)
        for (int i = 0; i < first->published_count; i++)
            if (rg_is_frame_rate(&first->published[i]) == is_rate)
                at->published[i] = rg_sheet_column(sheet, "published %s", first->published[i].name);
}

static void add_columns(const struct rg_result *result, const struct rg_record *first,
                        struct rg_sheet *sheet, struct columns *at)
{
    const bool is_timed = !result->is_of_textures;
    add_row_columns(first, sheet, at);
    if (result->work_count)
        at->work = rg_sheet_column(sheet, "work");
    if (result->variant_count > 1)
        at->variant = rg_sheet_column(sheet, "variant");
    at->device = rg_sheet_column(sheet, "device");
    at->fps = rg_sheet_column(sheet, is_timed ? "fps" : "status");
    if (is_timed)
        add_times(sheet, at, *result->hardware);
    const struct rg_record *counted = first_counted(result);
    for (int i = 0; counted && i < counted->counted_count; i++)
        at->counted[i] = rg_sheet_column(sheet, "%s a frame", counted->counted[i].name);
    for (int i = 0; is_timed && any_tallied(result) && i < TALLIED; i++)
        at->tallied[i] = rg_sheet_column(sheet, "%s a frame", tallied[i].name);
    for (int i = 0; first && i < first->published_count; i++) {
        const char *name = first->published[i].name;
        if (!rg_is_frame_rate(&first->published[i]) && is_told(result, name))
            at->told[i] = rg_sheet_column(sheet, "%s", name);
    }
    if (*result->truth)
        at->error = rg_sheet_column(sheet, "error, FLIP");
    if (is_timed)
        at->passes = rg_sheet_column(sheet, "passes, synced");
}

// --- the cells ---

// The slowest pass that is not done; NULL when only passes below half a percent are left.
static const struct rg_pass_time *next_pass(const struct rg_record *record, bool *done)
{
    const struct rg_pass_time *largest = NULL;
    for (int i = 0; i < record->pass_count; i++)
        if (!done[i] && (!largest || record->passes[i].ms > largest->ms))
            largest = &record->passes[i];
    if (!largest || largest->ms < 0.005 * rg_record_passes_ms(record))
        return NULL;
    done[largest - record->passes] = true;
    return largest;
}

// A kernel's name without its prefix, the technique's name.
static const char *pass_name(const struct rg_record *record, const char *name)
{
    const size_t length = strlen(record->technique);
    const bool own = !strncmp(name, record->technique, length) && name[length] == '_';
    return own ? name + length + 1 : name;
}

// "light 70 %, given 12 %, other 18 %": the largest first, as many as fit.
static void print_passes(const struct rg_record *record, char text[RG_SHEET_CELL])
{
    enum { ROOM_FOR_OTHER = sizeof(", other 100 %"), MOST = 96 };
    const struct rg_pass_time *pass;
    const double sum = rg_record_passes_ms(record);
    bool done[RG_MAX_PASS_TIMES] = {false};
    double left = sum;
    size_t used = 0;
    while ((pass = next_pass(record, done))) {
        char entry[64];
        const int length = snprintf(entry, sizeof(entry), "%s%s %.0f %%", used ? ", " : "",
                                    pass_name(record, pass->name), 100 * pass->ms / sum);
        if (used + (size_t)length + ROOM_FOR_OTHER > MOST)
            break;
        used += (size_t)snprintf(text + used, MOST - used, "%s", entry);
        left -= pass->ms;
    }
    if (sum > 0 && left >= 0.005 * sum)
        snprintf(text + used, MOST - used, "%sother %.0f %%", used ? ", " : "", 100 * left / sum);
}

static void fill_times(const struct columns *at, char (*cells)[RG_SHEET_CELL],
                       const struct rg_record *record, const struct rg_record *reference)
{
    snprintf(cells[at->fps], RG_SHEET_CELL, "%.1f", rg_record_fps(record));
    rg_record_mark(record, cells[at->mark]);
    snprintf(cells[at->ms], RG_SHEET_CELL, "%.3f", record->frame_ms.median);
    if (isfinite(record->frame_ms.low))
        snprintf(cells[at->ms_range], RG_SHEET_CELL, "%.3f to %.3f", record->frame_ms.low,
                 record->frame_ms.high);
    snprintf(cells[at->first], RG_SHEET_CELL, "%.1f", record->first_frame_ms);
    const bool trusted = rg_timer_is_trusted(record->api_over_wall);
    snprintf(cells[at->api], RG_SHEET_CELL, "%.2f%s", record->api_over_wall,
             trusted ? "" : " untrusted");
    if (reference && reference->outcome == RG_OK)
        snprintf(cells[at->times], RG_SHEET_CELL, "%.1f",
                 rg_record_fps(record) / rg_record_fps(reference));
    print_passes(record, cells[at->passes]);
}

// The row's error against the truth, or why it is unknown.
static void fill_error(const struct rg_truth_error *error, char text[RG_SHEET_CELL])
{
    if (error->outcome == RG_OK)
        snprintf(text, RG_SHEET_CELL, "%.4f", error->flip_mask_mean);
    else
        snprintf(text, RG_SHEET_CELL, "%s", rg_outcome_name(error->outcome));
}

static void fill_named(char text[RG_SHEET_CELL], const struct rg_named *named)
{
    if (*named->text)
        snprintf(text, RG_SHEET_CELL, "%s", named->text);
    else
        snprintf(text, RG_SHEET_CELL, "%.10g", named->number);
}

// Fills in a cell's identification and printed values. Columns are those of the first record; no
// cell has more.
static void fill_names(const struct rg_result *result, const struct rg_record *first,
                       const struct columns *at, char (*cells)[RG_SHEET_CELL],
                       const struct rg_record *record)
{
    for (int i = 0; i < record->row_count && i < first->row_count; i++)
        fill_named(cells[at->row[i]], &record->row[i]);
    for (int i = 0; i < record->published_count && i < first->published_count; i++)
        fill_named(cells[at->published[i]], &record->published[i]);
    if (at->work >= 0)
        snprintf(cells[at->work], RG_SHEET_CELL, "%s", record->work);
    if (at->variant >= 0)
        snprintf(cells[at->variant], RG_SHEET_CELL, "%s", record->variant);
    snprintf(cells[at->device], RG_SHEET_CELL, "%s", record->device.name);
    if (*result->truth)
        fill_error(&record->truth_error, cells[at->error]);
    snprintf(cells[at->fps], RG_SHEET_CELL, "%s", rg_outcome_name(record->outcome));
}

static void fill_told(const struct rg_record *first, const struct columns *at,
                      char (*cells)[RG_SHEET_CELL], const struct rg_record *record)
{
    for (int i = 0; i < first->published_count; i++) {
        const double *told =
            rg_named_number(record->facts, record->fact_count, first->published[i].name);
        if (at->told[i] >= 0 && told)
            snprintf(cells[at->told[i]], RG_SHEET_CELL, "%.10g", *told);
    }
}

// Fills in the ratio to print: to one number, or a range.
static void fill_ratio(const struct rg_record *record, char text[RG_SHEET_CELL])
{
    double low, high;
    rg_record_published_range(record, &low, &high);
    const double fps = rg_record_fps(record);
    if (low < high)
        snprintf(text, RG_SHEET_CELL, "%.2f to %.2f", fps / high, fps / low);
    else if (!isnan(low)) // one variant may be printed, and another not
        snprintf(text, RG_SHEET_CELL, "%.2f", fps / low);
}

// A count of work; "" if the device cannot take it.
static void put_count(int64_t count, char cell[RG_SHEET_CELL])
{
    if (rg_is_counted(count))
        snprintf(cell, RG_SHEET_CELL, "%" PRId64, count);
}

static void add_row(const struct rg_result *result, const struct rg_record *first,
                    const struct columns *at, struct rg_sheet *sheet, struct rg_place place)
{
    const struct rg_record *record = rg_result_at(result, place);
    char(*cells)[RG_SHEET_CELL] = rg_sheet_row(sheet);
    if (!cells)
        return;
    fill_names(result, first, at, cells, record);
    if (record->outcome != RG_OK)
        return;
    fill_told(first, at, cells, record);
    if (result->is_of_textures)
        return;
    fill_times(at, cells, record, reference_of(result, place));
    for (int i = 0; i < record->counted_count && at->counted[i] >= 0; i++)
        snprintf(cells[at->counted[i]], RG_SHEET_CELL, "%" PRId64, record->counted[i].value);
    for (int i = 0; i < TALLIED && at->tallied[i] >= 0 && record->has_tally; i++)
        put_count(*(const int64_t *)((const char *)&record->tally + tallied[i].offset),
                  cells[at->tallied[i]]);
    // Only the printed work is compared with print; for "ours" nothing is printed.
    if (at->ratio >= 0 && rg_result_is_of_print(result, place.work))
        fill_ratio(record, cells[at->ratio]);
}

void rg_result_sheet(const struct rg_result *result, struct rg_sheet *sheet)
{
    const struct rg_record *first = first_of(result);
    const char *shown[RG_MAX_VALUES + 1];
    int shown_count = 0;
    struct columns at;
    memset(&at, -1, sizeof(at));
    *sheet = (struct rg_sheet){.title = result->table};
    add_columns(result, first, sheet, &at);
    for (struct rg_place place = rg_result_start(result); rg_result_next(result, &place);)
        add_row(result, first, &at, sheet, place);
    for (int i = 0; first && i < first->published_count; i++)
        if (at.told[i] >= 0)
            shown[shown_count++] = first->published[i].name;
    shown[shown_count] = NULL;
    rg_result_notes(result, shown, sheet);
}
