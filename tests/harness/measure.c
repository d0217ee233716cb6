// Cells: by what a device's image is judged, what a cell keeps of its instance, where a pass's time
// goes, and a table from its settings to its machine form.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "harness/frames/frame.h"
#include "harness/record/facts.h"
#include "harness/tables/table.h"

#define CHEAP                                                                                      \
    "view=pane panes=mirror environment=sky environment_px=16 reflection_px=16 resolution_px=64"

enum { SIZE_PX = 128 };

static void *settings_of(const char *assignments)
{
    const struct rg_technique *flow = rg_technique_find("flow");
    void *defaults = rg_settings_create(flow);
    void *settings = rg_settings_copy(flow, defaults, assignments);
    assert_non_null(settings);
    free(defaults);
    return settings;
}

// --- tier T1 goes by the rain mask ---

// So many pixels on which it rains become two codes brighter in red.
static void brighten(struct rg_picture *picture, const struct rg_picture *dry, int pixels)
{
    for (int i = 0; i < SIZE_PX * SIZE_PX && pixels > 0; i++) {
        float *texel = picture->texels + (size_t)i * 4;
        const double red = texel[0], encoded = 1.055 * pow(red, 1 / 2.4) - 0.055;
        if (fabs(red - dry->texels[(size_t)i * 4]) < 0.1 || encoded < 0.1 || encoded > 0.9)
            continue;
        const double code = floor(encoded * 255 + 0.5) + 2;
        texel[0] = (float)pow((code / 255 + 0.055) / 1.055, 2.4);
        pixels--;
    }
    assert_int_equal(pixels, 0);
}

static enum rg_outcome judge(struct rg_device *device, const void *settings,
                             const struct rg_expected *expected, char *detail, size_t size)
{
    struct rg_cell cell = {.technique = rg_technique_find("flow"),
                           .settings = settings,
                           .device = device,
                           .width = SIZE_PX,
                           .height = SIZE_PX,
                           .check_frames = RG_CHECK_FRAMES};
    if (rg_cell_open(&cell))
        rg_cell_check(&cell, expected);
    snprintf(detail, size, "%s", cell.detail);
    rg_cell_free(&cell);
    return cell.status;
}

// What cpu:reference shows of a technique, with the background.
static void expect(struct rg_expected *expected, const struct rg_technique *technique,
                   const void *settings)
{
    struct rg_device *device = rg_device_open("cpu:reference");
    struct rg_instance *instance =
        rg_frame_run(technique, settings, device, SIZE_PX, SIZE_PX, RG_CHECK_FRAMES);
    *expected = (struct rg_expected){0};
    assert_true(rg_expected_read(expected, instance));
    rg_instance_close(instance);
    assert_true(rg_frame_draw_dry(technique, settings, device, SIZE_PX, SIZE_PX, RG_CHECK_FRAMES,
                                  &expected->dry));
    assert_true(rg_device_close(device));
}

static void test_t1_by_the_mask(void **state)
{
    (void)state;
    enum { PIXELS = 12 }; // below 0.1 % of the picture, above 0.1 % of where it rains
    char detail[256];
    void *settings = settings_of(CHEAP " drops=90");
    struct rg_device *device = rg_device_open("cpu");
    struct rg_expected expected;
    expect(&expected, rg_technique_find("flow"), settings);
    assert_int_equal(judge(device, settings, &expected, detail, sizeof(detail)), RG_OK);
    brighten(&expected.picture, &expected.dry, PIXELS);
    ((char *)expected.texels)[0] ^= 1; // what the device draws is no longer identical
    assert_int_equal(judge(device, settings, &expected, detail, sizeof(detail)), RG_FAIL);
    assert_non_null(strstr(detail, "(T0)"));
    device->info.software = false;
    assert_int_equal(judge(device, settings, &expected, detail, sizeof(detail)), RG_FAIL);
    if (!strstr(detail, "of the mask is above 1/255"))
        fail_msg("failed for another reason: %s", detail);
    rg_picture_destroy(&expected.dry); // without a background the whole picture is the mask
    assert_int_equal(judge(device, settings, &expected, detail, sizeof(detail)), RG_OK);
    rg_expected_free(&expected);
    assert_true(rg_device_close(device));
    free(settings);
}

// --- a technique that tells facts and runs many passes: flow, with more said of it ---

static bool open_talker(struct rg_instance *instance)
{
    const bool ok = rg_technique_find("flow")->open(instance);
    rg_tell(instance, "panes", 6);
    return ok;
}

// 40 passes more, each named twice a frame. The last takes a millisecond each time.
static bool step_talker(struct rg_instance *instance)
{
    static char names[40][16];
    for (int i = 0; i < 80; i++) {
        snprintf(names[i % 40], sizeof(names[0]), "pass %d", i % 40);
        if (i % 40 == 39)
            nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
        if (instance->after_stage)
            instance->after_stage(&(struct rg_opened_stage){.row.kernel = names[i % 40]},
                                  instance->user);
    }
    for (struct rg_fact *f = instance->facts; f < instance->facts + instance->fact_count; f++)
        f->number += 1;
    return rg_technique_find("flow")->step(instance);
}

static void test_what_a_cell_keeps(void **state)
{
    (void)state;
    struct rg_technique talker = *rg_technique_find("flow");
    talker.open = open_talker;
    talker.step = step_talker;
    void *settings = settings_of(CHEAP);
    struct rg_device *device = rg_device_open("cpu");
    struct rg_expected expected;
    expect(&expected, &talker, settings);
    struct rg_cell cell = {.technique = &talker,
                           .settings = settings,
                           .device = device,
                           .width = SIZE_PX,
                           .height = SIZE_PX,
                           .check_frames = RG_CHECK_FRAMES};
    const struct rg_measure_options options = {
        .most_samples = 3, .least_samples = 3, .sample_ms = 1, .warm_up_ms = 1};
    assert_true(rg_cell_open(&cell) && rg_cell_check(&cell, &expected) &&
                rg_cell_warm_up(&cell, &options));
    rg_cells_measure(&cell, 1, &options);
    assert_int_equal(cell.status, RG_OK);
    assert_int_equal(cell.fact_count, 3); // behind flow's own, the vertices and faces of its pane
    assert_string_equal(cell.facts[2].name, "panes");
    assert_true(cell.facts[2].number == 6 + RG_CHECK_FRAMES);
    // Every name once; flow's own passes came too late for a name of their own.
    assert_int_equal(cell.pass_count, RG_MAX_CELL_PASSES);
    for (int i = 0; i < RG_MAX_CELL_PASSES - 1; i++) {
        char name[16];
        snprintf(name, sizeof(name), "pass %d", i);
        assert_string_equal(cell.passes[i].name, name);
    }
    const struct rg_cell_pass *other = &cell.passes[RG_MAX_CELL_PASSES - 1];
    assert_string_equal(other->name, "other");
    assert_true(other->ms >= 2); // the last pass is in it, both times
    rg_cell_free(&cell);
    rg_expected_free(&expected);
    assert_true(rg_device_close(device));
    free(settings);
}

// --- how many samples a cell takes ---

static bool step_slowly(struct rg_instance *instance)
{
    nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
    return rg_technique_find("flow")->step(instance);
}

// As many as the time for them allows, within bounds: slow cells and fast ones in one run.
static void test_samples(void **state)
{
    (void)state;
    const struct rg_technique *flow = rg_technique_find("flow");
    struct rg_technique slow = *flow;
    slow.step = step_slowly;
    const struct rg_measure_options options = {
        .most_samples = 40, .least_samples = 2, .sample_ms = 1, .cell_ms = 200, .warm_up_ms = 1};
    void *settings = settings_of(CHEAP);
    struct rg_device *device = rg_device_open("cpu");
    struct rg_cell cells[2];
    for (int i = 0; i < 2; i++) {
        cells[i] = (struct rg_cell){.technique = i ? &slow : flow,
                                    .settings = settings,
                                    .device = device,
                                    .width = 16,
                                    .height = 16,
                                    .check_frames = 1};
        assert_true(rg_cell_open(&cells[i]) && rg_cell_warm_up(&cells[i], &options));
    }
    rg_cells_measure(cells, 2, &options);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(cells[i].status, RG_OK);
        assert_int_equal(cells[i].sample_count, cells[i].wanted_samples);
        assert_in_range(cells[i].sample_count, 2, 40);
        assert_in_range(cells[i].pass_frames, 2, 10);
        rg_cell_free(&cells[i]);
    }
    assert_true(cells[1].sample_count <= 5); // of 40 ms, with the frame before it
    assert_true(rg_device_close(device));
    free(settings);
}

// --- a table ---

#define PANE "view=pane panes=mirror reflection_px=16 "

static const struct rg_table_row rows[] = {
    {PANE "resolution_px=64 drops=40", {6, 160}, "small"},
    {PANE "environment=/nonexistent.exr", {7, 100}, "broken"},
    {PANE "resolution_px=96 drops=0", {8, 50}, "dry"},
};
static const struct rg_table table = {
    .id = "test",
    .technique = "flow",
    .about = "a test",
    .hardware = "paper",
    .names = "scene",
    .columns = {"faces", "fps"},
    .variants = {{"full", "environment_px=16 environment=sky", "fps"},
                 {"bare", "environment_px=16 rain_drops_s=0", "fps"}},
    .truth = "drops=20",
    .width = 64,
    .height = 64,
    .row_count = 3,
    .rows = rows,
    .note = "a note",
};

static void keep_quiet(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)line;
    (*(int *)user)++;
}

// A row whose file is missing takes no other row with it.
static void test_table(void **state)
{
    (void)state;
    int messages = 0;
    struct rg_devices devices = {.count = 1};
    devices.devices[0] = rg_device_open("cpu");
    struct rg_table_run run = {.table = &table, .devices = &devices, .last_row = 2};
    struct rg_kept kept = {.devices = &devices};
    rg_log_listen(keep_quiet, &messages);
    assert_true(rg_table_measure(&run, &kept, NULL));
    rg_log_listen(NULL, NULL);
    assert_int_equal(messages, 1);
    assert_int_equal(run.cell_count, 6);
    for (int row = 0; row < 3; row++) {
        for (int variant = 0; variant < 2; variant++) {
            const struct rg_cell *cell = rg_table_cell(&run, row, variant, 0);
            const struct rg_table_group *group = rg_table_group(&run, row, variant);
            // The variant's sky goes over the row's file.
            const bool broken = row == 1 && variant == 1;
            assert_int_equal(cell->status, broken ? RG_ERROR : RG_OK);
            assert_int_equal(group->error_status, broken ? RG_ERROR : RG_OK);
            assert_true(broken || group->error.flip_mask_mean > 0.001);
        }
    }
    const struct rg_cell *broken = rg_table_cell(&run, 1, 1, 0);
    if (!strstr(broken->detail, "/nonexistent.exr"))
        fail_msg("the file is not named: %s", broken->detail);
    // Both assignments of a row are taken, the number of texels and that of drops.
    const int64_t small = rg_table_cell(&run, 0, 1, 0)->counters[0].value;
    const int64_t dry = rg_table_cell(&run, 2, 1, 0)->counters[0].value;
    assert_true(small == 40 && dry == 0);
    rg_table_run_free(&run);
    assert_true(rg_kept_free(&kept));
    assert_true(rg_device_close(devices.devices[0]));
}

// --- tables of textures, and what a device cannot hold ---

static const struct rg_table_row levels[] = {
    {"", {0, 16, 16}, "environment"},
    {"", {9, 1, 1}, "environment"},
    {"", {0, 16, 16}, "carpet"},
    {"resolution_px=nonsense", {0, 16, 16}, "environment"},
};
static const struct rg_table texture_table = {
    .id = "textures",
    .technique = "flow",
    .about = "a test",
    .hardware = "paper",
    .names = "texture",
    .columns = {"level", "width_px", "height_px"},
    .key_count = 1,
    .variants = {{"full", CHEAP, NULL}},
    .is_of_textures = true,
    .width = 64,
    .height = 64,
    .row_count = 4,
    .rows = levels,
    .note = "a note",
};

static void run_table(struct rg_table_run *run, struct rg_kept *kept, struct rg_journal *journal)
{
    int messages = 0;
    rg_log_listen(keep_quiet, &messages);
    assert_true(rg_table_measure(run, kept, journal));
    rg_log_listen(NULL, NULL);
}

static void test_textures(void **state)
{
    (void)state;
    struct rg_devices devices = {.count = 1, .devices = {rg_device_open("cpu")}};
    struct rg_kept kept = {.devices = &devices};
    struct rg_table_run run = {.table = &texture_table, .devices = &devices, .last_row = 3};
    run_table(&run, &kept, NULL);
    const struct rg_cell *whole = rg_table_cell(&run, 0, 0, 0);
    assert_int_equal(whole->status, RG_OK);
    assert_true(*rg_facts_number(whole->facts, whole->fact_count, "width_px") == 16);
    assert_true(*rg_facts_number(whole->facts, whole->fact_count, "height_px") == 16);
    assert_int_equal(rg_table_cell(&run, 1, 0, 0)->status, RG_FAIL); // no such level
    assert_int_equal(rg_table_cell(&run, 2, 0, 0)->status, RG_ERROR);
    assert_int_equal(rg_table_cell(&run, 3, 0, 0)->status, RG_ERROR);
    rg_table_run_free(&run);
    assert_true(rg_kept_free(&kept));
    assert_true(rg_device_close(devices.devices[0]));
}

static void test_unsupported(void **state)
{
    (void)state;
    struct rg_table wide = table;
    wide.width = 1 << 20;
    struct rg_devices devices = {.count = 1, .devices = {rg_device_open("cpu")}};
    struct rg_kept kept = {.devices = &devices};
    struct rg_table_run run = {.table = &wide, .devices = &devices};
    run_table(&run, &kept, NULL);
    const struct rg_cell *cell = rg_table_cell(&run, 0, 0, 0);
    assert_int_equal(cell->status, RG_UNSUPPORTED);
    assert_non_null(strstr(cell->detail, "1048576x64"));
    rg_table_run_free(&run);
    assert_true(rg_kept_free(&kept));
    assert_true(rg_device_close(devices.devices[0]));
}

// --- what the cells of a table share ---

static void test_kept(void **state)
{
    (void)state;
    struct rg_devices devices = {.count = 1, .devices = {rg_device_open("cpu")}};
    struct rg_kept kept = {.devices = &devices};
    struct rg_device *cpu = devices.devices[0];
    assert_ptr_equal(rg_kept_device(&kept, "cpu"), cpu);
    struct rg_device *reference = rg_kept_device(&kept, "cpu:reference");
    assert_non_null(reference);
    assert_ptr_equal(rg_kept_device(&kept, "cpu:reference"), reference);
    void *settings = settings_of(CHEAP " drops=20"), *others = settings_of(CHEAP " drops=30");
    struct rg_subject subject = {rg_technique_find("flow"), settings, 32, 32};
    // One instance a device, for as long as the same is asked for.
    struct rg_instance *first = rg_kept_open(&kept, cpu, &subject);
    const int64_t bytes = rg_device_work(cpu)->live_bytes;
    assert_ptr_equal(rg_kept_open(&kept, cpu, &subject), first);
    assert_ptr_not_equal(rg_kept_open(&kept, reference, &subject), first);
    subject.settings = others;
    assert_non_null(rg_kept_open(&kept, cpu, &subject));
    assert_true(rg_device_work(cpu)->live_bytes == bytes);
    // A truth is drawn once.
    const struct rg_picture *truth = rg_kept_truth(&kept, &subject, 2);
    const int64_t runs = rg_device_work(cpu)->runs;
    assert_ptr_equal(rg_kept_truth(&kept, &subject, 2), truth);
    assert_true(rg_device_work(cpu)->runs == runs);
    assert_ptr_not_equal(rg_kept_truth(&kept, &subject, 3), truth);
    subject.settings = settings;
    assert_ptr_not_equal(rg_kept_truth(&kept, &subject, 2), truth);
    free(others);
    free(settings);
    assert_true(rg_kept_free(&kept));
    assert_true(rg_device_close(cpu));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_t1_by_the_mask), cmocka_unit_test(test_what_a_cell_keeps),
        cmocka_unit_test(test_samples),        cmocka_unit_test(test_table),
        cmocka_unit_test(test_textures),       cmocka_unit_test(test_unsupported),
        cmocka_unit_test(test_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
