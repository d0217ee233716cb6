// The notes below a table.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/tables/sheet/costs.h"
#include "harness/tables/sheet/sheet.h"
#include "harness/tables/sheet/trend.h"

// ", no_geometry", ", ours, full": names the variant and work of a cell, if there are several.
static void name_kind(const struct rg_result *result, struct rg_place at, char *text, size_t size)
{
    size_t used = 0;
    *text = 0;
    if (result->work_count)
        used = (size_t)snprintf(text, size, ", %s", result->works[at.work].name);
    if (result->variant_count > 1 && used < size)
        snprintf(text + used, size - used, ", %s", result->variants[at.variant]);
}

// "glass with bunny", "texture_px 128, no_geometry".
static void name_cell(const struct rg_result *result, struct rg_place at, char *text, size_t size)
{
    rg_record_row_name(rg_result_at(result, at), text, size);
    const size_t used = strlen(text);
    name_kind(result, at, text + used, size - used);
}

// --- cells without a measurement ---

// Whether two cells were left out for the same reason.
static bool ended_alike(const struct rg_record *a, const struct rg_record *b)
{
    return a->outcome == b->outcome && !strcmp(a->detail, b->detail);
}

// The devices of a row left out for the same reason, from this one on: "gl, vulkan"; "" if an
// earlier one has it.
static void name_alike(const struct rg_result *result, struct rg_place at, char *text, size_t size)
{
    const struct rg_record *record = rg_result_at(result, at);
    const int device = at.device;
    size_t used = 0;
    *text = 0;
    for (at.device = 0; at.device < device; at.device++)
        if (ended_alike(record, rg_result_at(result, at)))
            return;
    for (; at.device < result->device_count && used < size; at.device++)
        if (ended_alike(record, rg_result_at(result, at)))
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                     result->devices[at.device].name);
}

static void note_outcome(const struct rg_result *result, struct rg_sheet *sheet, struct rg_place at)
{
    const struct rg_record *record = rg_result_at(result, at);
    char name[256], devices[512];
    name_cell(result, at, name, sizeof(name));
    name_alike(result, at, devices, sizeof(devices));
    if (record->outcome != RG_OK && *devices)
        rg_sheet_note(sheet, "%s on %s: %s", name, devices, record->detail);
    if (at.device == 0 && record->truth_error.outcome != RG_OK)
        rg_sheet_note(sheet, "%s: no error: %s", name, record->truth_error.detail);
}

// --- the trend ---

// Frame times grow where rates fall, so the exponent is the negative slope.
static void note_growth(const struct rg_result *result, struct rg_sheet *sheet, struct rg_place of,
                        const struct rg_trend *s)
{
    char interval[80] = "", kind[128];
    if (isfinite(s->slope_low))
        snprintf(interval, sizeof(interval), " (95 %%: %.2f to %.2f)", -s->slope_high,
                 -s->slope_low);
    name_kind(result, of, kind, sizeof(kind));
    rg_sheet_note(sheet, "Growth on %s%s: the time of a frame goes with %s to the power %.2f%s.",
                  result->devices[of.device].name, kind, s->axis->name, -s->slope, interval);
}

// "; it goes with size to the power -0.98 (95 %: -1.02 to -0.94), published -1.04 (0.08 either
// way)"
static void print_slopes(const char *axis, const struct rg_trend *s, char *text, size_t size)
{
    char interval[80] = "";
    if (isfinite(s->slope_low))
        snprintf(interval, sizeof(interval), " (95 %%: %.2f to %.2f)", s->slope_low, s->slope_high);
    snprintf(text, size, "; it goes with %s to the power %.2f%s, published %.2f (%.2f either way)",
             axis, s->slope, interval, s->published_slope, s->margin);
}

static void note_trend(const struct rg_result *result, struct rg_sheet *sheet, struct rg_place of)
{
    const struct rg_trend s = rg_trend_of(result, of);
    char slopes[200] = "", unsettled[64] = "", kind[128];
    if (s.verdict == RG_TREND_GROWTH)
        note_growth(result, sheet, of, &s);
    if (s.verdict >= RG_TREND_GROWTH)
        return;
    if (s.has_slope)
        print_slopes(s.axis->name, &s, slopes, sizeof(slopes));
    if (s.pairs_undecided)
        snprintf(unsettled, sizeof(unsettled), "; the samples do not settle %d", s.pairs_undecided);
    name_kind(result, of, kind, sizeof(kind));
    rg_sheet_note(sheet,
                  "Shape on %s%s: %s. fps %s the published order (%d of %d pairs of rows%s)%s.",
                  result->devices[of.device].name, kind, rg_trend_text(s.verdict),
                  s.pairs_in_order == s.pairs ? "keeps" : "does not keep", s.pairs_in_order,
                  s.pairs, unsettled, slopes);
}

// "12.8 to 30.4, by 58 %": the relative difference between the largest and the smallest.
static void name_spread(const struct rg_result *result, const struct rg_spread *s, const char *what,
                        int decimals, char *text, size_t size)
{
    const int used = snprintf(text, size, "%s%.*f to %.*f, by %.0f %%", what, decimals,
                              s->least_fps, decimals, s->most_fps, 100 * s->share);
    if (result->variant_count > 1 && used < (int)size)
        snprintf(text + used, size - (size_t)used, ", over the rows of a variant by up to %.0f %%",
                 100 * s->of_a_variant);
}

// Notes the spread over rows with names, for claims such as that frame rates vary with the scene. A
// work that saves something is not compared with print.
static void note_spread(const struct rg_result *result, struct rg_sheet *sheet, struct rg_place of)
{
    struct rg_spread found, due;
    char name[RG_NAME_SIZE + 4] = "", measured[128], printed[128] = "";
    if (of.variant || !rg_spread_of(result, of.work, of.device, &found, &due))
        return;
    if (result->work_count)
        snprintf(name, sizeof(name), ", %s", result->works[of.work].name);
    name_spread(result, &found, "", 1, measured, sizeof(measured));
    if (rg_result_is_of_print(result, of.work))
        name_spread(result, &due, "; published ", 2, printed, sizeof(printed));
    rg_sheet_note(sheet, "Spread of fps on %s%s: %s%s.", result->devices[of.device].name, name,
                  measured, printed);
}

// --- the inputs ---

// Whether all measured cells have the same facts, which `text` gets. Missing rows may have others.
static bool is_same_everywhere(const struct rg_result *result, const char *const *shown,
                               char text[RG_FACTS_TEXT])
{
    char other[RG_FACTS_TEXT];
    bool any = false;
    if (rg_result_first_missing(result) <= result->last_row)
        return false;
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        const struct rg_record *record = rg_result_at(result, at);
        if (record->outcome != RG_OK)
            continue;
        rg_named_text(record->facts, record->fact_count, shown, any ? other : text, RG_FACTS_TEXT);
        if (any && strcmp(other, text))
            return false;
        any = true;
    }
    return any;
}

// Notes each text once: for the table, or for consecutive cells of a row with the same text.
static void note_facts(const struct rg_result *result, const char *const *shown,
                       struct rg_sheet *sheet)
{
    char now[RG_FACTS_TEXT], before[RG_FACTS_TEXT] = "", name[256];
    if (is_same_everywhere(result, shown, now)) {
        if (*now)
            rg_sheet_note(sheet, "Inputs of every row: %s.", now);
        return;
    }
    int row = -1;
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at); row = at.row) {
        const struct rg_record *record = rg_result_at(result, at);
        if (at.row != row)
            *before = 0;
        rg_named_text(record->facts, record->fact_count, shown, now, sizeof(now));
        if (!*now || !strcmp(now, before))
            continue;
        name_cell(result, at, name, sizeof(name));
        rg_sheet_note(sheet, "Inputs of %s: %s.", name, now);
        memcpy(before, now, sizeof(now));
    }
}

// --- the method ---

void rg_result_marks(const struct rg_result *result, char *text, size_t size)
{
    int cells = 0, wide = 0, busy = 0;
    double noise = 0, taken = 0;
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        const struct rg_record *record = rg_result_at(result, at);
        if (record->outcome != RG_OK)
            continue;
        cells++;
        wide += rg_record_noise(record) > 0;
        busy += rg_record_disturbed(record) > 0;
        noise = fmax(noise, rg_record_noise(record));
        for (int i = 0; i < record->sample_count; i++)
            taken = fmax(taken, record->taken[i]);
    }
    size_t used = 0;
    *text = 0;
    if (wide)
        used = (size_t)snprintf(text, size,
                                "%d of %d cells have intervals wider than %g times (+-, ~; up to "
                                "%.0f %%).%s",
                                wide, cells, RG_WIDE_INTERVAL, 100 * noise, busy ? " " : "");
    if (busy && used < size)
        snprintf(text + used, size - used,
                 "In %d of %d others took over %.0f %% of the processors (busy, !; up to %.0f %%).",
                 busy, cells, 100 * RG_MOST_TAKEN, 100 * taken);
}

// Notes how the numbers were measured.
static void note_method(const struct rg_result *result, struct rg_sheet *sheet)
{
    char published[RG_TITLE_SIZE + 32] = "", medians_of[64];
    if (*result->hardware)
        snprintf(published, sizeof(published), "Published on %s. ", result->hardware);
    rg_result_medians_of(result, medians_of, sizeof(medians_of));
    if (!result->is_of_textures) {
        rg_sheet_note(sheet, "%sTimes are wall clock between full syncs, medians of %s (%s).",
                      published, medians_of, result->full ? "full" : "quick");
        char marks[RG_TITLE_SIZE];
        rg_result_marks(result, marks, sizeof(marks));
        if (*marks)
            rg_sheet_note(sheet, "Marks: %s", marks);
        if (rg_result_drift(result) > 0)
            rg_sheet_note(sheet,
                          "The machine's speed drifted by %.1f %% over the run, as a load "
                          "tells that is always the same.",
                          100 * rg_result_drift(result));
        rg_sheet_note(sheet, "Shares of the passes come from a run of its own that syncs after "
                             "every pass.");
    } else {
        rg_sheet_note(sheet, "Sizes are those of the images that the devices made.");
    }
    if (!result->full && *result->quick)
        rg_sheet_note(sheet, "Quick mode sets %s; --full leaves that as the paper has it.",
                      result->quick);
}

// The last of the consecutive missing rows from this one on.
static int end_of_gap(const struct rg_result *result, int row)
{
    const bool wanted = rg_result_wants(result, row);
    while (row < result->last_row && !rg_result_has(result, row + 1) &&
           rg_result_wants(result, row + 1) == wanted)
        row++;
    return row;
}

// Notes rows from an earlier run, and missing rows.
static void note_interruption(const struct rg_result *result, struct rg_sheet *sheet)
{
    if (result->resumed_rows)
        rg_sheet_note(sheet, "Of its rows, %d were measured by a run that was interrupted before.",
                      result->resumed_rows);
    for (int row = result->first_row; row <= result->last_row; row++) {
        if (rg_result_has(result, row))
            continue;
        const int last = end_of_gap(result, row);
        const char *why = rg_result_wants(result, row) ? "the run was interrupted"
                          : result->budget_s > 0       ? "left out by a budget"
                                                       : "left out by quick mode";
        if (row == last)
            rg_sheet_note(sheet, "Row %d is missing: %s.", row + 1, why);
        else
            rg_sheet_note(sheet, "Rows %d to %d are missing: %s.", row + 1, last + 1, why);
        row = last;
    }
}

static void note_works(const struct rg_result *result, struct rg_sheet *sheet)
{
    for (int i = 0; i < result->work_count; i++) {
        const struct rg_result_work *work = &result->works[i];
        if (*work->saves)
            rg_sheet_note(sheet, "Cells of work %s do less than what was printed: %s.", work->name,
                          work->saves);
        if (*work->reading)
            rg_sheet_note(sheet, "Cells of work %s read the paper so: %s.", work->name,
                          work->reading);
    }
    if (*result->changed)
        rg_sheet_note(sheet, "All cells have %s over their rows' own settings%s.", result->changed,
                      *result->hardware ? ", so that none does what was printed" : "");
}

void rg_result_notes(const struct rg_result *result, const char *const *shown,
                     struct rg_sheet *sheet)
{
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);)
        note_outcome(result, sheet, at);
    for (struct rg_place of = rg_result_start_row(result->first_row);
         rg_result_next_in_row(result, &of);)
        note_trend(result, sheet, of);
    for (struct rg_place of = rg_result_start_row(result->first_row);
         rg_result_next_in_row(result, &of);)
        note_spread(result, sheet, of);
    for (struct rg_place of = rg_result_start_row(result->first_row);
         rg_result_next_in_row(result, &of);)
        rg_note_costs(result, sheet, of);
    note_facts(result, shown, sheet);
    note_works(result, sheet);
    note_method(result, sheet);
    note_interruption(result, sheet);
    if (*result->truth)
        rg_sheet_note(sheet,
                      "The error is the image's mean FLIP over the rain mask, 0 to 1, against "
                      "the image with %s.",
                      result->truth);
    rg_sheet_note(sheet, "%s", result->note);
}
