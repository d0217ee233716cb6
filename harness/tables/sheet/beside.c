#include "harness/tables/sheet/beside.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/techniques/technique.h"
#include "harness/console/terminal.h"
#include "harness/tables/sheet/digits.h"

// Optional columns; the last are dropped first when lines get too wide.
enum { DRAWN, ERROR, PACKED, SHADED, OPTIONAL };
enum { FEWEST_PACKED = 100 };

// The index of each column; -1: not in this table.
struct columns {
    int row[RG_MAX_VALUES];
    int number, print, optional[OPTIONAL], device[RG_MAX_DEVICES];
};

const struct rg_record *rg_beside_first(const struct rg_result *result, struct rg_place of)
{
    for (of.row = result->first_row; of.row <= result->last_row; of.row++)
        if (rg_result_has(result, of.row))
            return rg_result_at(result, of);
    return NULL;
}

// --- the columns ---

static bool is_same_number(const struct rg_named *a, const struct rg_named *b)
{
    return *a->text || *b->text ? !strcmp(a->text, b->text) : a->number == b->number;
}

// Whether the first value is unique in each row, as a name is.
static bool first_value_tells_all(const struct rg_result *result, struct rg_place of)
{
    struct rg_place other = of;
    for (of.row = result->first_row; of.row <= result->last_row; of.row++)
        for (other.row = result->first_row; other.row < of.row; other.row++)
            if (rg_result_has(result, of.row) && rg_result_has(result, other.row) &&
                is_same_number(&rg_result_at(result, of)->row[0],
                               &rg_result_at(result, other)->row[0]))
                return false;
    return true;
}

// Whether a value identifies rows. In a paper's table, choices repeat what the row's name says; in
// a sweep, rows of one name have different choices.
static bool tells_rows_apart(const struct rg_result *result, struct rg_place of, int value)
{
    const struct rg_record *first = rg_beside_first(result, of);
    bool differs = false;
    if (value && *first->row[0].text && *first->row[value].text &&
        first_value_tells_all(result, of))
        return false;
    for (of.row = result->first_row; of.row <= result->last_row; of.row++)
        differs =
            differs || (rg_result_has(result, of.row) &&
                        !is_same_number(&rg_result_at(result, of)->row[value], &first->row[value]));
    return differs || (!value && (*first->row[0].text || result->first_row == result->last_row));
}

// The unit of a parameter; NULL: it is not a parameter.
static const char *unit_of(const struct rg_result *result, const char *name)
{
    const struct rg_technique *technique = rg_technique_find(result->technique);
    const struct rg_param *param = technique ? rg_params_find(technique->params, name) : NULL;
    return param ? param->unit : NULL;
}

static void add_row_columns(const struct rg_result *result, struct rg_place of,
                            struct rg_sheet *sheet, struct columns *at)
{
    const struct rg_record *first = rg_beside_first(result, of);
    bool any = false;
    for (int i = 0; i < first->row_count; i++) {
        char heading[RG_SHEET_CELL];
        if (!tells_rows_apart(result, of, i))
            continue;
        rg_digits_heading(first->row[i].name, unit_of(result, first->row[i].name), heading,
                          sizeof(heading));
        at->row[i] = rg_sheet_column(sheet, "%s", heading);
        any = true;
    }
    if (!any)
        at->number = rg_sheet_column(sheet, "row");
}

// A count of a row's work, which is one for all devices: native ones cannot take it.
static int64_t counted(const struct rg_result *result, struct rg_place of, int which)
{
    int64_t most = -1;
    for (of.device = 0; of.device < result->device_count; of.device++) {
        const struct rg_record *record = rg_result_at(result, of);
        const int64_t count = which == PACKED ? record->tally.records : record->tally.fragments;
        if (record->has_tally && count > most)
            most = count;
    }
    return most;
}

static bool has_optional(const struct rg_result *result, struct rg_place of, int which)
{
    const struct rg_record *first = rg_beside_first(result, of);
    const double *drawn = rg_named_number(first->facts, first->fact_count, "particles");
    const double *due = rg_named_number(first->published, first->published_count, "particles");
    if (which == DRAWN)
        return drawn && due;
    if (which == ERROR)
        return *result->truth != 0;
    for (of.row = result->first_row; !rg_result_has(result, of.row);)
        of.row++;
    const int64_t count = counted(result, of, which);
    // A few items that fill the view tell nothing.
    return which == PACKED ? count >= FEWEST_PACKED : rg_is_counted(count);
}

static bool is_reference(const struct rg_result *result, int device)
{
    return !strcmp(result->devices[device].name, "cpu:reference");
}

static void add_columns(const struct rg_result *result, struct rg_place of,
                        const struct rg_beside_layout *layout, struct rg_sheet *sheet,
                        struct columns *at)
{
    static const char *const names[OPTIONAL] = {"drawn", "error", "packed, k", "shaded, k"};
    const struct rg_record *first = rg_beside_first(result, of);
    memset(at, -1, sizeof(*at));
    add_row_columns(result, of, sheet, at);
    double low, high;
    rg_record_published_range(first, &low, &high);
    if (isfinite(low) || result->is_of_textures)
        at->print = rg_sheet_column(sheet, "print");
    for (int i = 0; i < layout->optional; i++)
        if (!result->is_of_textures && has_optional(result, of, i))
            at->optional[i] = rg_sheet_column(sheet, "%s", names[i]);
    for (int d = 0; d < result->device_count; d++)
        if (!layout->lacks_reference || !is_reference(result, d))
            at->device[d] = rg_sheet_column(
                sheet, "%s", is_reference(result, d) ? "reference" : result->devices[d].name);
}

// --- the cells ---

static void fill_row(const struct columns *at, char (*cells)[RG_SHEET_CELL],
                     const struct rg_record *record, int row)
{
    for (int i = 0; i < record->row_count; i++) {
        if (at->row[i] < 0)
            continue;
        if (*record->row[i].text)
            snprintf(cells[at->row[i]], RG_SHEET_CELL, "%s", record->row[i].text);
        else
            snprintf(cells[at->row[i]], RG_SHEET_CELL, "%.10g", record->row[i].number);
    }
    if (at->number >= 0)
        snprintf(cells[at->number], RG_SHEET_CELL, "%d", row + 1);
}

static void fill_print(char text[RG_SHEET_CELL], const struct rg_record *record)
{
    double low, high;
    rg_record_published_range(record, &low, &high);
    if (!isfinite(low))
        return;
    char from[32], to[32];
    rg_digits_rate(low, from, sizeof(from));
    rg_digits_rate(high, to, sizeof(to));
    if (low < high)
        snprintf(text, RG_SHEET_CELL, "%s-%s", from, to);
    else
        snprintf(text, RG_SHEET_CELL, "%s", from);
}

static void fill_optional(const struct rg_result *result, struct rg_place of,
                          const struct columns *at, char (*cells)[RG_SHEET_CELL])
{
    const struct rg_record *record = rg_result_at(result, of);
    const double *drawn = rg_named_number(record->facts, record->fact_count, "particles");
    const double *due = rg_named_number(record->published, record->published_count, "particles");
    if (at->optional[DRAWN] >= 0 && drawn && due)
        snprintf(cells[at->optional[DRAWN]], RG_SHEET_CELL, "%.2f", *drawn / *due);
    if (at->optional[ERROR] >= 0 && record->truth_error.outcome == RG_OK)
        snprintf(cells[at->optional[ERROR]], RG_SHEET_CELL, "%.3f",
                 record->truth_error.flip_mask_mean);
    for (int i = PACKED; i <= SHADED; i++) {
        const int64_t count = counted(result, of, i);
        if (at->optional[i] >= 0 && rg_is_counted(count))
            rg_digits_rate((double)count / 1000, cells[at->optional[i]], RG_SHEET_CELL);
    }
}

// The ratio of a cell's rate to print, or, for a work that saves something, to the printed work; ""
// if unknown.
static void print_times(const struct rg_result *result, struct rg_place at, char *text, size_t size)
{
    const struct rg_record *record = rg_result_at(result, at);
    const int printed = rg_result_printed_work(result);
    double low = NAN, high;
    *text = 0;
    if (rg_result_is_of_print(result, at.work) && rg_record_is_other_work(record, NULL)) {
        snprintf(text, size, "other");
        return;
    }
    if (rg_result_is_of_print(result, at.work)) {
        rg_record_published_range(record, &low, &high);
        low = sqrt(low * high); // the middle of a range
    } else if (*result->works[at.work].saves && printed >= 0) {
        struct rg_place other = at;
        other.work = printed;
        const struct rg_record *paper = rg_result_at(result, other);
        low = paper->outcome == RG_OK ? rg_record_fps(paper) : (double)NAN;
    }
    if (!isfinite(low))
        return;
    char ratio[32];
    rg_digits_ratio(rg_record_fps(record) / low, ratio, sizeof(ratio));
    snprintf(text, size, "%sx", ratio);
}

static void print_mark(const struct rg_record *record, enum rg_beside_marks marks, char *text,
                       size_t size)
{
    char mark[RG_MARK_SIZE], low[32], high[32];
    const struct rg_interval *ms = &record->frame_ms;
    rg_record_mark(record, mark);
    if (marks == RG_BESIDE_LETTERS)
        snprintf(text, size, "%s", !*mark ? "" : rg_record_disturbed(record) ? "!" : "~");
    else if (marks == RG_BESIDE_TEXTS || !(ms->low > 0 && isfinite(ms->high)))
        snprintf(text, size, "%s%s", *mark ? " " : "", mark);
    else {
        rg_digits_rate(1000 / ms->high, low, sizeof(low));
        rg_digits_rate(1000 / ms->low, high, sizeof(high));
        snprintf(text, size, " [%s, %s]%s", low, high, rg_record_disturbed(record) ? " busy" : "");
    }
}

// A cell: "451 +-22%  1.1x". With less room it is "451~ 1.1x" or, where others disturbed it,
// "451! 1.1x"; with more it has its interval.
static void fill_device(const struct rg_result *result, struct rg_place at,
                        const struct rg_beside_layout *layout, char text[RG_SHEET_CELL])
{
    const struct rg_record *record = rg_result_at(result, at);
    char rate[32], times[40], mark[RG_MARK_SIZE + 80];
    if (record->outcome != RG_OK) {
        snprintf(text, RG_SHEET_CELL, "%s", rg_outcome_name(record->outcome));
        return;
    }
    rg_digits_rate(rg_record_fps(record), rate, sizeof(rate));
    print_times(result, at, times, sizeof(times));
    print_mark(record, layout->marks, mark, sizeof(mark));
    snprintf(text, RG_SHEET_CELL, *times && !layout->lacks_times ? "%s%s %5s" : "%s%s", rate, mark,
             times);
}

// The width and height of a texture: "32 x 3606".
static void fill_size(char text[RG_SHEET_CELL], const struct rg_named *named, int count)
{
    const double *width = rg_named_number(named, count, "width_px");
    const double *height = rg_named_number(named, count, "height_px");
    if (width && height)
        snprintf(text, RG_SHEET_CELL, "%.10gx%.10g", *width, *height);
}

static void fill_texture(const struct rg_record *record, char text[RG_SHEET_CELL])
{
    snprintf(text, RG_SHEET_CELL, "%s", rg_outcome_name(record->outcome));
    if (record->outcome == RG_OK)
        fill_size(text, record->facts, record->fact_count);
}

static void add_row(const struct rg_result *result, struct rg_place of, const struct columns *at,
                    const struct rg_beside_layout *layout, struct rg_sheet *sheet)
{
    const struct rg_record *record = rg_result_at(result, of);
    char(*cells)[RG_SHEET_CELL] = rg_sheet_row(sheet);
    if (!cells)
        return;
    fill_row(at, cells, record, of.row);
    if (at->print >= 0 && result->is_of_textures)
        fill_size(cells[at->print], record->published, record->published_count);
    else if (at->print >= 0)
        fill_print(cells[at->print], record);
    fill_optional(result, of, at, cells);
    for (; of.device < result->device_count; of.device++) {
        if (at->device[of.device] < 0)
            continue;
        if (result->is_of_textures)
            fill_texture(rg_result_at(result, of), cells[at->device[of.device]]);
        else
            fill_device(result, of, layout, cells[at->device[of.device]]);
    }
}

// --- a sheet ---

void rg_beside_make(const struct rg_result *result, struct rg_place of,
                    const struct rg_beside_layout *layout, struct rg_sheet *sheet)
{
    struct columns at;
    *sheet = (struct rg_sheet){.title = result->table, .level = 3, .width_step = 1};
    add_columns(result, of, layout, sheet, &at);
    for (of.row = result->first_row; of.row <= result->last_row; of.row++)
        if (rg_result_has(result, of.row))
            add_row(result, of, &at, layout, sheet);
}

// The next layout that takes less room, in which the columns that are least needed go first; only
// terminals have those after short marks. False after the last one.
static bool take_less(struct rg_beside_layout *layout, bool is_file)
{
    if (layout->marks == RG_BESIDE_INTERVALS)
        layout->marks = RG_BESIDE_TEXTS;
    else if (layout->optional)
        layout->optional--;
    else if (layout->marks == RG_BESIDE_TEXTS)
        *layout = (struct rg_beside_layout){OPTIONAL, RG_BESIDE_LETTERS, false, false};
    else if (!layout->lacks_reference && !is_file)
        layout->lacks_reference = true;
    else if (!layout->lacks_times && !is_file)
        layout->lacks_times = true;
    else
        return false;
    return true;
}

// Makes the sheet that holds most in the width. Wider pages than files have intervals.
struct rg_beside_layout rg_beside_fit(const struct rg_result *result, struct rg_place of, int width,
                                      struct rg_sheet *sheet)
{
    const bool is_file = width == RG_PAGE_WIDTH;
    struct rg_beside_layout layout = {
        OPTIONAL, width > RG_PAGE_WIDTH ? RG_BESIDE_INTERVALS : RG_BESIDE_TEXTS, false, false};
    rg_beside_make(result, of, &layout, sheet);
    while (rg_sheet_width(sheet) > width && !sheet->incomplete && take_less(&layout, is_file)) {
        rg_sheet_free(sheet);
        rg_beside_make(result, of, &layout, sheet);
    }
    return layout;
}
