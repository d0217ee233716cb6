#include "tests/harness/results/forms/rig.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

static const struct rg_table_row scenes[] = {
    {"", {6, 160}, "mirror"},
    {"", {100000, 120}, "dragon"},
    {"", {99999, 120}, "buddha"},
    {"", {50801, 146}, "planck"},
};

const struct rg_table sheet_names_table = {
    .id = "names",
    .technique = "flow",
    .hardware = "paper",
    .names = "scene",
    .columns = {"faces", "fps"},
    .variants = {{"full", "", "fps"}},
    .row_count = 4,
    .rows = scenes,
    .note = "a note",
};

const struct rg_table sheet_styles_table = {
    .id = "styles",
    .technique = "flow",
    .hardware = "paper",
    .names = "scene",
    .columns = {"fps", "fps_no_geometry"},
    .variants = {{"full", "", "fps"}, {"no_geometry", "geometry=off", "fps_no_geometry"}},
    .works = {{"paper", "blocks=all", ""}, {"ours", "", "less is drawn"}},
    .row_count = 2,
    .rows = (const struct rg_table_row[]){{"", {100, 200}, "mirror"}, {"", {80, 190}, "dragon"}},
    .note = "a note",
};

static const struct rg_table_row radii[] = {
    {"", {5, 1, 70303, 400, 800}, NULL},
    {"", {10, 1, 198818, 200, 400}, NULL},
    {"", {20, 1, 784812, 100, 400}, NULL},
};

const struct rg_table sheet_axis_table = {
    .id = "axis",
    .technique = "flow",
    .hardware = "paper",
    .columns = {"radius_m", "camera", "particles", "fps", "fps_no_geometry"},
    .key_count = 2,
    .variants = {{"full", "", "fps"}, {"no_geometry", "geometry=off", "fps_no_geometry"}},
    .truth = "radius_m=0",
    .row_count = 3,
    .rows = radii,
    .note = "a note",
};

struct rg_device sheet_device = {.info = {.name = "cpu", .software = true}};

static struct rg_device other_devices[] = {{.info = {.name = "cpu:reference", .software = true}},
                                           {.info = {.name = "gl"}},
                                           {.info = {.name = "vulkan"}}};

static void measure(struct rig *rig, const struct rg_table *table, const double *fps, int samples)
{
    const struct rg_table_part part = {.last_row = table->row_count - 1};
    rig->result = (struct rg_result){0};
    rg_table_begin(&rig->result, table, &part, &rig->devices);
    for (int row = 0; row < table->row_count; row++)
        assert_true(rg_table_add_row(&rig->result, table, row));
    for (struct rg_place at = rg_result_start(&rig->result); rg_result_next(&rig->result, &at);) {
        struct rg_record *record = rg_result_at(&rig->result, at);
        const double ms = 1000 / *fps;
        record->outcome = *fps++ > 0 ? RG_OK : RG_FAIL;
        snprintf(record->detail, sizeof(record->detail), "differs");
        record->frame_ms.median = ms; // also of a cell that failed
        record->sample_count = record->outcome == RG_OK ? samples : 0;
        for (int i = 0; i < record->sample_count; i++)
            record->samples_ms[i] = ms * (1 + 1e-4 * (i - samples / 2));
        rg_record_settle(record);
    }
}

void sheet_measure_few(struct rig *rig, const struct rg_table *table, const double *fps,
                       int samples)
{
    rig->devices = (struct rg_devices){.count = 1, .devices = {&sheet_device}};
    measure(rig, table, fps, samples);
}

void sheet_measure(struct rig *rig, const struct rg_table *table, const double *fps)
{
    sheet_measure_few(rig, table, fps, 11);
}

void sheet_measure_on(struct rig *rig, const struct rg_table *table, const double *fps, int devices)
{
    rig->devices = (struct rg_devices){
        .count = devices,
        .devices = {&sheet_device, &other_devices[0], &other_devices[1], &other_devices[2]}};
    measure(rig, table, fps, 11);
}

// The record of a row and variant.
struct rg_record *sheet_record_at(const struct rig *rig, int row, int variant)
{
    return rg_result_at(&rig->result, (struct rg_place){.row = row, .variant = variant});
}

void sheet_tell(struct rg_record *record, const char *name, double number)
{
    rg_named_set_number(&record->facts[record->fact_count++], name, number);
}

void sheet_add_pass(struct rg_record *record, const char *name, double ms)
{
    struct rg_pass_time *pass = &record->passes[record->pass_count++];
    pass->ms = ms;
    rg_text_copy(pass->name, sizeof(pass->name), name);
}

struct rg_trend sheet_trend_of(const struct rg_table *table, int variant, const double *fps)
{
    struct rig rig;
    sheet_measure(&rig, table, fps);
    const struct rg_trend trend = rg_trend_of(&rig.result, (struct rg_place){.variant = variant});
    rg_result_free(&rig.result);
    return trend;
}

const char *sheet_text_at(const struct rg_sheet *sheet, int row, const char *column)
{
    for (int c = 0; c < sheet->column_count; c++)
        if (!strcmp(sheet->columns[c], column))
            return sheet->cells[row][c];
    return NULL;
}

void sheet_expect_text(const struct rg_sheet *sheet, int row, const char *column, const char *text)
{
    const char *found = sheet_text_at(sheet, row, column);
    if (!found || strcmp(found, text))
        fail_msg("row %d, %s: '%s', not '%s'", row, column, found ? found : "no column", text);
}

bool sheet_has_note(const struct rg_sheet *sheet, const char *text)
{
    for (int n = 0; n < sheet->note_count; n++)
        if (strstr(sheet->notes[n], text))
            return true;
    return false;
}
