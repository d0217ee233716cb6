#include "harness/tables/sheet/brief.h"

#include <math.h>
#include <string.h>

#include "core/techniques/technique.h"
#include "harness/console/colour.h"
#include "harness/console/sheet.h"
#include "harness/record/passport/driver.h"
#include "harness/tables/sheet/below.h"
#include "harness/tables/sheet/curve.h"
#include "harness/tables/sheet/digits.h"

// Optional columns; the last are dropped first when lines get too wide.
enum { DRAWN, ERROR, PACKED, SHADED, OPTIONAL };

// The index of each column; -1: not in this table.
struct columns {
    int row[RG_MAX_VALUES];
    int number, print, optional[OPTIONAL], device[RG_MAX_DEVICES];
};

static const struct rg_record *first_of(const struct rg_result *result, struct rg_place of)
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
    const struct rg_record *first = first_of(result, of);
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
    const struct rg_record *first = first_of(result, of);
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

static bool has_optional(const struct rg_result *result, const struct rg_record *first, int which)
{
    const double *drawn = rg_named_number(first->facts, first->fact_count, "particles");
    const double *due = rg_named_number(first->published, first->published_count, "particles");
    if (which == DRAWN)
        return drawn && due;
    return which == ERROR ? *result->truth != 0 : first->has_tally;
}

static void add_columns(const struct rg_result *result, struct rg_place of, int optional,
                        struct rg_sheet *sheet, struct columns *at)
{
    static const char *const names[OPTIONAL] = {"drawn", "error", "packed, k", "shaded, k"};
    const struct rg_record *first = first_of(result, of);
    memset(at, -1, sizeof(*at));
    add_row_columns(result, of, sheet, at);
    double low, high;
    rg_record_published_range(first, &low, &high);
    if (isfinite(low) || result->is_of_textures)
        at->print = rg_sheet_column(sheet, "print");
    for (int i = 0; i < optional; i++)
        if (!result->is_of_textures && has_optional(result, first, i))
            at->optional[i] = rg_sheet_column(sheet, "%s", names[i]);
    for (int d = 0; d < result->device_count; d++) {
        const char *name = result->devices[d].name;
        at->device[d] =
            rg_sheet_column(sheet, "%s", strcmp(name, "cpu:reference") ? name : "reference");
    }
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

static void fill_optional(const struct columns *at, char (*cells)[RG_SHEET_CELL],
                          const struct rg_record *record)
{
    const double *drawn = rg_named_number(record->facts, record->fact_count, "particles");
    const double *due = rg_named_number(record->published, record->published_count, "particles");
    if (at->optional[DRAWN] >= 0 && drawn && due)
        snprintf(cells[at->optional[DRAWN]], RG_SHEET_CELL, "%.2f", *drawn / *due);
    if (at->optional[ERROR] >= 0 && record->truth_error.outcome == RG_OK)
        snprintf(cells[at->optional[ERROR]], RG_SHEET_CELL, "%.3f",
                 record->truth_error.flip_mask_mean);
    if (at->optional[PACKED] >= 0 && record->has_tally)
        rg_digits_rate((double)record->tally.records / 1000, cells[at->optional[PACKED]],
                       RG_SHEET_CELL);
    if (at->optional[SHADED] >= 0 && record->has_tally)
        rg_digits_rate((double)record->tally.fragments / 1000, cells[at->optional[SHADED]],
                       RG_SHEET_CELL);
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

// A cell: "451 +-22% 1.1x". If the page has no room, the mark is short: "451~ 1.1x", or "451! 1.1x"
// if others disturbed it.
static void fill_device(const struct rg_result *result, struct rg_place at, bool is_short,
                        char text[RG_SHEET_CELL])
{
    const struct rg_record *record = rg_result_at(result, at);
    char rate[32], times[40], mark[RG_MARK_SIZE];
    if (record->outcome != RG_OK) {
        snprintf(text, RG_SHEET_CELL, "%s", rg_outcome_name(record->outcome));
        return;
    }
    rg_digits_rate(rg_record_fps(record), rate, sizeof(rate));
    print_times(result, at, times, sizeof(times));
    rg_record_mark(record, mark);
    if (is_short && *mark)
        snprintf(mark, sizeof(mark), rg_record_disturbed(record) ? "!" : "~");
    snprintf(text, RG_SHEET_CELL, *times ? "%s%s%s %5s" : "%s%s%s%s", rate,
             *mark && !is_short ? " " : "", mark, times);
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
                    bool is_short, struct rg_sheet *sheet)
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
    fill_optional(at, cells, record);
    for (; of.device < result->device_count; of.device++) {
        if (result->is_of_textures)
            fill_texture(rg_result_at(result, of), cells[at->device[of.device]]);
        else
            fill_device(result, of, is_short, cells[at->device[of.device]]);
    }
}

// --- a table ---

// Colours failures and other work.
static const char *paint_amiss(const char *cell)
{
    enum rg_outcome outcome;
    if (strstr(cell, "other"))
        return RG_YELLOW;
    if (!rg_outcome_find(cell, &outcome) || outcome == RG_OK)
        return NULL;
    return outcome == RG_UNSUPPORTED ? RG_YELLOW : RG_RED;
}

// The same, and cells that reach print.
static const char *paint_of_print(const char *cell)
{
    const char *times = strrchr(cell, ' ');
    if (paint_amiss(cell))
        return paint_amiss(cell);
    if (!times || cell[strlen(cell) - 1] != 'x')
        return NULL;
    return times[1] == '0' ? NULL : RG_GREEN;
}

// Makes the sheet with as many optional columns as the page has room for.
static void make_sheet(const struct rg_result *result, struct rg_place of, int optional,
                       bool is_short, struct rg_sheet *sheet)
{
    const struct rg_place first = of;
    struct columns at;
    *sheet = (struct rg_sheet){.title = result->table, .level = 3, .width_step = 1};
    add_columns(result, of, optional, sheet, &at);
    for (of.row = result->first_row; of.row <= result->last_row; of.row++)
        if (rg_result_has(result, of.row))
            add_row(result, of, &at, is_short, sheet);
    if (rg_sheet_width(sheet) > RG_PAGE_WIDTH && optional > 0 && !sheet->incomplete) {
        rg_sheet_free(sheet);
        make_sheet(result, first, optional - 1, is_short, sheet);
    }
}

// The kind of a table's cells: "paper, no_geometry: two textures a light (section 4.4.2)".
static void name_table(const struct rg_result *result, struct rg_place of, char *text, size_t size)
{
    const struct rg_result_work *work = &result->works[of.work];
    const bool names_variant = result->variant_count > 1 || !result->work_count;
    snprintf(text, size, "%s%s%s%s%s", result->work_count ? work->name : "",
             result->work_count && names_variant ? ", " : "",
             names_variant ? result->variants[of.variant] : "", *work->reading ? ": " : "",
             *work->reading ? work->reading
             : *work->saves ? ", times paper"
                            : "");
}

static bool print_table(const struct rg_result *result, struct rg_place of, FILE *out)
{
    struct rg_sheet sheet;
    char title[RG_TITLE_SIZE + 3 * RG_NAME_SIZE];
    make_sheet(result, of, OPTIONAL, false, &sheet);
    if (rg_sheet_width(&sheet) > RG_PAGE_WIDTH && !sheet.incomplete) {
        rg_sheet_free(&sheet);
        make_sheet(result, of, OPTIONAL, true, &sheet);
    }
    name_table(result, of, title, sizeof(title));
    sheet.title = title;
    if (rg_has_colours(out))
        sheet.paint = rg_result_is_of_print(result, of.work) ? paint_of_print : paint_amiss;
    rg_sheet_print_md(&sheet, out);
    rg_sheet_free(&sheet);
    fprintf(out, "\n");
    if (!result->is_of_textures)
        rg_curves_print(result, of, out);
    return !sheet.incomplete;
}

// Whether two devices are of one API, or one has settings of its own, so that the page must show
// their drivers.
static bool has_sides(const struct rg_result *result)
{
    bool any = false;
    for (int i = 0; result->device_count > 1 && i < result->device_count; i++) {
        const char *full = result->devices[i].full;
        any = any || strchr(full, '@');
        for (int j = 0; j < i; j++) {
            const size_t length = strcspn(full, ":@");
            any = any || (strncmp(full, "cpu", 3) != 0 &&
                          length == strcspn(result->devices[j].full, ":@") &&
                          !strncmp(full, result->devices[j].full, length));
        }
    }
    return any;
}

static void print_drivers(const struct rg_result *result, FILE *out)
{
    char line[RG_DRIVER_LINE];
    for (int i = 0; i < result->device_count; i++) {
        rg_driver_line(&result->devices[i], line);
        fprintf(out, "- %s\n", line);
    }
    fprintf(out, "\n");
}

static void print_head(const struct rg_result *result, FILE *out)
{
    fprintf(out, "## %s\n\n", result->table);
    if (result->is_of_textures)
        fprintf(out, "Sizes of textures in pixels, in print and on each device.\n\n");
    else if (*result->hardware)
        fprintf(out, "Frames a second, in print and on each device, and how many times print that "
                     "is.\n\n");
    else
        fprintf(out, "Frames a second on each device.\n\n");
    if (has_sides(result))
        print_drivers(result, out);
}

bool rg_brief_print(const struct rg_result *result, FILE *out)
{
    struct rg_place of = rg_result_start_row(result->first_row);
    bool ok = true;
    print_head(result, out);
    while (rg_result_next_in_row(result, &of))
        if (of.device == 0 && first_of(result, of))
            ok = print_table(result, of, out) && ok;
    rg_brief_below(result, out);
    return ok;
}
