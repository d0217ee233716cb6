#include "harness/tables/sheet/brief.h"

#include <math.h>
#include <string.h>

#include "harness/console/terminal.h"
#include "harness/console/sheet.h"
#include "harness/record/passport/driver.h"
#include "harness/tables/sheet/below.h"
#include "harness/tables/sheet/beside.h"
#include "harness/tables/sheet/curve.h"

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
    const struct rg_beside_layout layout = rg_beside_fit(result, of, rg_page_width(out), &sheet);
    name_table(result, of, title, sizeof(title));
    sheet.title = title;
    if (rg_has_colours(out))
        sheet.paint = rg_result_is_of_print(result, of.work) ? paint_of_print : paint_amiss;
    rg_sheet_print_md(&sheet, out);
    rg_sheet_free(&sheet);
    fprintf(out, "\n");
    if (layout.lacks_reference) {
        snprintf(title, sizeof(title),
                 "Without cpu:reference%s, for want of room; `raingauge table --wide` has all.",
                 layout.lacks_times ? " and how many times print it is" : "");
        rg_print_wrapped(out, "", title);
        fprintf(out, "\n");
    }
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
    rg_print_wrapped(
        out, "",
        result->is_of_textures ? "Sizes of textures in pixels, in print and on each device."
        : *result->hardware    ? "Frames a second in the paper (print) and on each device, whose "
                                 "rate is also told as a multiple of print."
                               : "Frames a second on each device.");
    fprintf(out, "\n");
    if (has_sides(result))
        print_drivers(result, out);
}

bool rg_brief_print(const struct rg_result *result, FILE *out)
{
    struct rg_place of = rg_result_start_row(result->first_row);
    bool ok = true;
    print_head(result, out);
    while (rg_result_next_in_row(result, &of))
        if (of.device == 0 && rg_beside_first(result, of))
            ok = print_table(result, of, out) && ok;
    rg_brief_below(result, out);
    return ok;
}

// --- for an article ---

static bool print_tex(const struct rg_result *result, struct rg_place of, FILE *out)
{
    static const struct rg_beside_layout as_printed = {.marks = RG_BESIDE_TEXTS,
                                                       .lacks_times = true};
    struct rg_sheet sheet;
    char title[3 * RG_TITLE_SIZE + 4 * RG_NAME_SIZE], kind[RG_TITLE_SIZE + 3 * RG_NAME_SIZE];
    rg_beside_make(result, of, &as_printed, &sheet);
    name_table(result, of, kind, sizeof(kind));
    snprintf(title, sizeof(title), "%s, %s. %s%s%s", result->table, kind,
             result->is_of_textures ? "Sizes of textures in pixels" : "Frames a second",
             *result->hardware ? "; in print on " : "", result->hardware);
    sheet.title = title;
    rg_sheet_print_tex(&sheet, out);
    rg_sheet_free(&sheet);
    return !sheet.incomplete;
}

bool rg_brief_print_tex(const struct rg_result *result, FILE *out)
{
    struct rg_place of = rg_result_start_row(result->first_row);
    bool ok = true;
    for (int tables = 0; rg_result_next_in_row(result, &of);) {
        if (of.device || !rg_beside_first(result, of))
            continue;
        fprintf(out, tables++ ? "\n" : "");
        ok = print_tex(result, of, out) && ok;
    }
    return ok;
}
