// A measured table as a sheet of text, for people.
#include <stdio.h>
#include <string.h>

#include "harness/measure/timer_audit.h"
#include "harness/record/facts.h"
#include "harness/tables/table.h"

// Where each thing stands; -1: not in this table.
struct columns {
    int name, keys, published_extras, published_fps, variant, device, fps, ms, ms_range, ratio,
        times, first, api, error, passes;
    int told[RG_TABLE_VALUES]; // measured beside an extra column of the same index
};

// The cell of cpu:reference in this row, or NULL.
static const struct rg_cell *reference_of(const struct rg_table_run *run, int row, int variant)
{
    for (int d = 0; d < run->devices->count; d++)
        if (!strcmp(run->devices->devices[d]->info.name, "cpu:reference"))
            return rg_table_cell(run, row, variant, d);
    return NULL;
}

// --- the columns ---

static bool is_told(const struct rg_table_run *run, const char *name)
{
    for (int i = 0; i < run->cell_count; i++)
        if (rg_facts_number(run->cells[i].facts, run->cells[i].fact_count, name))
            return true;
    return false;
}

static void add_times(struct rg_sheet *sheet, struct columns *at, bool is_published)
{
    at->ms = rg_sheet_column(sheet, "ms");
    at->ms_range = rg_sheet_column(sheet, "ms, 95 %%");
    at->ratio = is_published ? rg_sheet_column(sheet, "fps / published") : -1;
    at->times = rg_sheet_column(sheet, "x cpu:reference");
    at->first = rg_sheet_column(sheet, "first frame ms");
    at->api = rg_sheet_column(sheet, "API / wall clock");
}

static void add_columns(const struct rg_table_run *run, struct rg_sheet *sheet, struct columns *at)
{
    const struct rg_table *table = run->table;
    const bool is_published = rg_table_is_published(table), is_timed = !table->is_of_textures;
    at->name = table->names ? rg_sheet_column(sheet, "%s", table->names) : -1;
    at->keys = sheet->column_count;
    for (int c = 0; c < table->key_count; c++)
        rg_sheet_column(sheet, "%s", table->columns[c]);
    at->published_extras = sheet->column_count;
    for (int c = 0; table->columns[c]; c++)
        if (rg_table_is_extra(table, c))
            rg_sheet_column(sheet, "published %s", table->columns[c]);
    at->published_fps = is_published && is_timed ? rg_sheet_column(sheet, "published fps") : -1;
    at->variant = rg_table_variant_count(table) > 1 ? rg_sheet_column(sheet, "variant") : -1;
    at->device = rg_sheet_column(sheet, "device");
    at->fps = rg_sheet_column(sheet, is_timed ? "fps" : "status");
    if (is_timed)
        add_times(sheet, at, is_published);
    for (int c = 0; table->columns[c]; c++)
        at->told[c] = rg_table_is_extra(table, c) && is_told(run, table->columns[c])
                          ? rg_sheet_column(sheet, "%s", table->columns[c])
                          : -1;
    at->error = table->truth ? rg_sheet_column(sheet, "error, FLIP") : -1;
    at->passes = is_timed ? rg_sheet_column(sheet, "passes, synced") : -1;
}

// --- the cells ---

// The pass that takes longest among those that are not done; NULL when only those below half a
// percent are left.
static const struct rg_cell_pass *next_pass(const struct rg_cell *cell, bool *done)
{
    const struct rg_cell_pass *largest = NULL;
    for (int i = 0; i < cell->pass_count; i++)
        if (!done[i] && (!largest || cell->passes[i].ms > largest->ms))
            largest = &cell->passes[i];
    if (!largest || largest->ms < 0.005 * rg_cell_passes_ms(cell))
        return NULL;
    done[largest - cell->passes] = true;
    return largest;
}

// A kernel's name without the technique's, which begins it.
static const char *pass_name(const struct rg_cell *cell, const char *name)
{
    const size_t length = strlen(cell->technique->name);
    const bool own = !strncmp(name, cell->technique->name, length) && name[length] == '_';
    return own ? name + length + 1 : name;
}

// "light 70 %, given 12 %, other 18 %": the largest first, as many as fit.
static void print_passes(const struct rg_cell *cell, char text[RG_SHEET_CELL])
{
    enum { ROOM_FOR_OTHER = sizeof(", other 100 %") };
    const struct rg_cell_pass *pass;
    const double sum = rg_cell_passes_ms(cell);
    bool done[RG_MAX_CELL_PASSES] = {false};
    double left = sum;
    size_t used = 0;
    while ((pass = next_pass(cell, done))) {
        char entry[64];
        const int length = snprintf(entry, sizeof(entry), "%s%s %.0f %%", used ? ", " : "",
                                    pass_name(cell, pass->name), 100 * pass->ms / sum);
        if (used + (size_t)length + ROOM_FOR_OTHER > RG_SHEET_CELL)
            break;
        used += (size_t)snprintf(text + used, RG_SHEET_CELL - used, "%s", entry);
        left -= pass->ms;
    }
    if (sum > 0 && left >= 0.005 * sum)
        snprintf(text + used, RG_SHEET_CELL - used, "%sother %.0f %%", used ? ", " : "",
                 100 * left / sum);
}

static void fill_times(const struct columns *at, char (*cells)[RG_SHEET_CELL],
                       const struct rg_cell *cell, double published)
{
    snprintf(cells[at->fps], RG_SHEET_CELL, "%.1f", rg_cell_fps(cell));
    snprintf(cells[at->ms], RG_SHEET_CELL, "%.3f", cell->frame_ms.median);
    snprintf(cells[at->ms_range], RG_SHEET_CELL, "%.3f to %.3f", cell->frame_ms.low,
             cell->frame_ms.high);
    if (at->ratio >= 0)
        snprintf(cells[at->ratio], RG_SHEET_CELL, "%.2f", rg_cell_fps(cell) / published);
    snprintf(cells[at->first], RG_SHEET_CELL, "%.1f", cell->first_frame_ms);
    const bool trusted = rg_timer_is_trusted(cell->api_over_wall);
    snprintf(cells[at->api], RG_SHEET_CELL, "%.2f%s", cell->api_over_wall,
             trusted ? "" : " untrusted");
    print_passes(cell, cells[at->passes]);
}

static void fill_told(const struct rg_table_run *run, const struct columns *at,
                      char (*cells)[RG_SHEET_CELL], const struct rg_cell *cell)
{
    for (int c = 0; run->table->columns[c]; c++) {
        const double *told = rg_facts_number(cell->facts, cell->fact_count, run->table->columns[c]);
        if (at->told[c] >= 0 && told)
            snprintf(cells[at->told[c]], RG_SHEET_CELL, "%.10g", *told);
    }
}

// How far the row is from the truth, or why that is unknown.
static void fill_error(const struct rg_table_group *group, char text[RG_SHEET_CELL])
{
    if (group->error_status == RG_OK)
        snprintf(text, RG_SHEET_CELL, "%.4f", group->error.flip_mask_mean);
    else
        snprintf(text, RG_SHEET_CELL, "%s", rg_outcome_name(group->error_status));
}

static void fill_published(const struct rg_table_run *run, const struct columns *at,
                           char (*cells)[RG_SHEET_CELL], int row, int variant)
{
    const struct rg_table *table = run->table;
    const struct rg_table_row *printed = &table->rows[row];
    int extra = at->published_extras;
    if (at->name >= 0)
        snprintf(cells[at->name], RG_SHEET_CELL, "%s", printed->name);
    for (int c = 0; c < table->key_count; c++)
        snprintf(cells[at->keys + c], RG_SHEET_CELL, "%.10g", printed->values[c]);
    for (int c = 0; table->columns[c]; c++)
        if (rg_table_is_extra(table, c))
            snprintf(cells[extra++], RG_SHEET_CELL, "%.10g", printed->values[c]);
    if (at->published_fps >= 0)
        snprintf(cells[at->published_fps], RG_SHEET_CELL, "%.10g",
                 rg_table_published_fps(table, row, variant));
    if (at->variant >= 0)
        snprintf(cells[at->variant], RG_SHEET_CELL, "%s", table->variants[variant].name);
}

static void add_row(const struct rg_table_run *run, const struct columns *at,
                    struct rg_sheet *sheet, int row, int variant, int device)
{
    const struct rg_cell *cell = rg_table_cell(run, row, variant, device);
    const struct rg_cell *reference = reference_of(run, row, variant);
    const struct rg_table_group *group = rg_table_group(run, row, variant);
    char(*cells)[RG_SHEET_CELL] = rg_sheet_row(sheet);
    if (!cells)
        return;
    fill_published(run, at, cells, row, variant);
    snprintf(cells[at->device], RG_SHEET_CELL, "%s", cell->device->info.name);
    if (at->error >= 0)
        fill_error(group, cells[at->error]);
    snprintf(cells[at->fps], RG_SHEET_CELL, "%s", rg_outcome_name(cell->status));
    if (cell->status != RG_OK)
        return;
    fill_told(run, at, cells, cell);
    if (run->table->is_of_textures)
        return;
    fill_times(at, cells, cell, rg_table_published_fps(run->table, row, variant));
    if (reference && reference->status == RG_OK)
        snprintf(cells[at->times], RG_SHEET_CELL, "%.1f",
                 rg_cell_fps(cell) / rg_cell_fps(reference));
}

// --- the notes ---

// "glass with bunny", "texture_px 128", with the variant where there are several.
static void name_group(const struct rg_table_run *run, int row, int variant, char *text,
                       size_t size)
{
    rg_table_row_name(run->table, row, text, size);
    const size_t used = strlen(text);
    if (rg_table_variant_count(run->table) > 1)
        snprintf(text + used, size - used, ", %s", run->table->variants[variant].name);
}

// Whether two cells were left out for the same reason.
static bool is_same_status(const struct rg_cell *a, const struct rg_cell *b)
{
    return a->status == b->status && !strcmp(a->detail, b->detail);
}

// The devices of a row that were left out for the same reason as this one, from it on: "gl,
// vulkan"; "" when one before it was.
static void name_alike(const struct rg_table_run *run, int row, int variant, int device, char *text,
                       size_t size)
{
    const struct rg_cell *cell = rg_table_cell(run, row, variant, device);
    size_t used = 0;
    *text = 0;
    for (int d = 0; d < device; d++)
        if (is_same_status(cell, rg_table_cell(run, row, variant, d)))
            return;
    for (int d = device; d < run->devices->count && used < size; d++)
        if (is_same_status(cell, rg_table_cell(run, row, variant, d)))
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                     run->devices->devices[d]->info.name);
}

static void note_status(const struct rg_table_run *run, struct rg_sheet *sheet, int row,
                        int variant, int device)
{
    const struct rg_cell *cell = rg_table_cell(run, row, variant, device);
    const struct rg_table_group *group = rg_table_group(run, row, variant);
    char name[256], devices[512];
    name_group(run, row, variant, name, sizeof(name));
    name_alike(run, row, variant, device, devices, sizeof(devices));
    if (cell->status != RG_OK && *devices)
        rg_sheet_note(sheet, "%s on %s: %s", name, devices, cell->detail);
    if (device == 0 && group->error_status != RG_OK)
        rg_sheet_note(sheet, "%s: no error: %s", name, group->error_detail);
}

static void note_trend(const struct rg_table_run *run, struct rg_sheet *sheet, int variant,
                       int device)
{
    const struct rg_trend s = rg_table_trend(run, variant, device);
    const bool several = rg_table_variant_count(run->table) > 1;
    char slopes[160] = "";
    if (s.verdict == RG_TREND_UNKNOWN)
        return;
    if (s.has_slope)
        snprintf(slopes, sizeof(slopes), "; it goes with %s to the power %.2f, published %.2f",
                 run->table->columns[0], s.slope, s.published_slope);
    rg_sheet_note(
        sheet, "Shape on %s%s%s: %s. fps %s the published order (%d of %d pairs of rows)%s.",
        run->devices->devices[device]->info.name, several ? ", " : "",
        several ? run->table->variants[variant].name : "", rg_trend_text(s.verdict),
        s.pairs_in_order == s.pairs ? "keeps" : "does not keep", s.pairs_in_order, s.pairs, slopes);
}

// What a cell tells of its inputs that has no column.
static void print_facts(const struct rg_table_run *run, const struct columns *at, int cell,
                        char *text, size_t size)
{
    const char *shown[RG_TABLE_VALUES + 1];
    int count = 0;
    for (int c = 0; run->table->columns[c]; c++)
        if (at->told[c] >= 0)
            shown[count++] = run->table->columns[c];
    shown[count] = NULL;
    rg_facts_text(run->cells[cell].facts, run->cells[cell].fact_count, shown, text, size);
}

// Whether all measured cells tell the same, which is `text` then.
static bool is_same_everywhere(const struct rg_table_run *run, const struct columns *at,
                               char text[RG_FACTS_TEXT])
{
    char other[RG_FACTS_TEXT];
    bool any = false;
    for (int i = 0; i < run->cell_count; i++) {
        if (run->cells[i].status != RG_OK)
            continue;
        print_facts(run, at, i, any ? other : text, RG_FACTS_TEXT);
        if (any && strcmp(other, text))
            return false;
        any = true;
    }
    return any;
}

// Each text once: for the table, or for a row's cells that follow each other and tell it.
static void note_facts(const struct rg_table_run *run, const struct columns *at,
                       struct rg_sheet *sheet)
{
    char now[RG_FACTS_TEXT], before[RG_FACTS_TEXT] = "", name[256];
    if (is_same_everywhere(run, at, now)) {
        if (*now)
            rg_sheet_note(sheet, "Inputs of every row: %s.", now);
        return;
    }
    const int variants = rg_table_variant_count(run->table), devices = run->devices->count;
    for (int i = 0; i < run->cell_count; i++) {
        if (i % (variants * devices) == 0)
            *before = 0;
        print_facts(run, at, i, now, sizeof(now));
        if (!*now || !strcmp(now, before))
            continue;
        name_group(run, run->first_row + i / devices / variants, i / devices % variants, name,
                   sizeof(name));
        rg_sheet_note(sheet, "Inputs of %s: %s.", name, now);
        memcpy(before, now, sizeof(now));
    }
}

// How the numbers were come by.
static void note_method(const struct rg_table_run *run, struct rg_sheet *sheet)
{
    const struct rg_table *table = run->table;
    char published[160] = "", samples[48];
    int least, most;
    if (rg_table_is_published(table))
        snprintf(published, sizeof(published), "Published on %s. ", table->hardware);
    rg_table_samples(run, &least, &most);
    snprintf(samples, sizeof(samples), "%d", most);
    if (least < most)
        snprintf(samples, sizeof(samples), "%d to %d", least, most);
    if (!table->is_of_textures) {
        rg_sheet_note(sheet,
                      "%sTimes are wall clock between full syncs, medians of %s samples (%s).",
                      published, samples, run->full ? "full" : "quick");
        rg_sheet_note(sheet, "Shares of the passes come from a run of its own that syncs after "
                             "every pass.");
    } else {
        rg_sheet_note(sheet, "Sizes are those of the images that the devices made.");
    }
    if (!run->full && table->quick)
        rg_sheet_note(sheet, "Quick mode sets %s; --full leaves that as the paper has it.",
                      table->quick);
}

// What is not of this run, or not there.
static void note_interruption(const struct rg_table_run *run, struct rg_sheet *sheet)
{
    const int missing = rg_table_first_missing(run);
    if (run->resumed_rows)
        rg_sheet_note(sheet, "Of its rows, %d were measured by a run that was interrupted before.",
                      run->resumed_rows);
    if (missing <= run->last_row)
        rg_sheet_note(sheet, "Rows %d to %d are missing: the run was interrupted.", missing + 1,
                      run->last_row + 1);
}

void rg_table_sheet(const struct rg_table_run *run, struct rg_sheet *sheet)
{
    *sheet = (struct rg_sheet){.title = run->table->id};
    struct columns at;
    add_columns(run, sheet, &at);
    const int variants = rg_table_variant_count(run->table), devices = run->devices->count;
    const int end = rg_table_first_missing(run);
    for (int row = run->first_row; row < end; row++)
        for (int i = 0; i < variants * devices; i++)
            add_row(run, &at, sheet, row, i / devices, i % devices);
    for (int row = run->first_row; row < end; row++)
        for (int i = 0; i < variants * devices; i++)
            note_status(run, sheet, row, i / devices, i % devices);
    for (int i = 0; i < variants * devices; i++)
        note_trend(run, sheet, i / devices, i % devices);
    note_facts(run, &at, sheet);
    note_method(run, sheet);
    note_interruption(run, sheet);
    if (run->table->truth)
        rg_sheet_note(sheet,
                      "The error is the image's mean FLIP over the rain mask, 0 to 1, against "
                      "the image with %s.",
                      run->table->truth);
    rg_sheet_note(sheet, "%s", run->table->note);
}
