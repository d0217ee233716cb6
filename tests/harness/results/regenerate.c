// Tables from their settings to their results, and the sessions and pictures that a command keeps.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/devices/measure/expected.h"
#include "harness/tables/runs/regenerate.h"
#include "harness/tables/measuring/measure.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

#define CHEAP                                                                                      \
    "view=pane panes=mirror environment=sky environment_px=16 reflection_px=16 resolution_px=64"

// --- a table ---

#define PANE "view=pane panes=mirror reflection_px=16 "

static const struct rg_table_row rows[] = {
    {PANE "resolution_px=64 drops=40", {6, 160}, "small"},
    {PANE "environment=/nonexistent.exr", {7, 100}, "broken"},
    {PANE "resolution_px=96 drops=10", {8, 50}, "few"},
    {PANE "resolution_px=96 drops=0", {9, 40}, "dry"},
};
static const struct rg_table table = {
    .id = "test",
    .technique = "flow",
    .about = "a test",
    .hardware = "paper",
    .names = "scene",
    .columns = {"faces", "fps"},
    .variants = {{"full", "environment_px=16 environment=sky", "fps"},
                 {"bare", "environment_px=16 pane_rain_mm_h=0", "fps"}},
    .truth = "drops=20",
    .width = 64,
    .height = 64,
    .row_count = 4,
    .rows = rows,
    .note = "a note",
};

static void keep_quiet(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)line;
    (*(int *)user)++;
}

// A table measured on cpu.
struct rig {
    struct rg_devices devices;
    struct rg_kept kept;
    struct rg_result result;
};

// The device's own functions, and the one that reads images instead of its own; NULL: its own.
static const struct rg_backend *honest;
static struct rg_backend changed;
static bool (*image_read)(struct rg_image *image, int layer, int level, void *texels);

static bool read_another_image(struct rg_image *image, int layer, int level, void *texels)
{
    const bool ok = honest->image_read(image, layer, level, texels);
    *(unsigned char *)texels ^= 1;
    return ok;
}

static const char *work; // that is measured; NULL: all
static bool is_short;    // samples are the fewest, for what is seen without them

// Returns the number of messages.
static int measure(struct rig *rig, const struct rg_table *of, int count)
{
    int messages = 0;
    const struct rg_table_part part = {.last_row = count - 1, .work = work};
    *rig = (struct rig){.devices = {.count = 1, .devices = {rg_device_open("cpu")}}};
    rig->kept.devices = &rig->devices;
    honest = rig->devices.devices[0]->backend;
    changed = *honest;
    changed.image_read = image_read ? image_read : honest->image_read;
    rig->devices.devices[0]->backend = &changed;
    rg_table_begin(&rig->result, of, &part, &rig->devices);
    rig->result.few_samples = is_short;
    rg_log_listen(keep_quiet, &messages);
    assert_true(rg_table_measure(&rig->result, of, &rig->kept, NULL, NULL, NULL));
    rg_log_listen(NULL, NULL);
    return messages;
}

static void finish(struct rig *rig)
{
    rig->devices.devices[0]->backend = honest;
    rg_result_free(&rig->result);
    assert_true(rg_kept_free(&rig->kept));
    assert_true(rg_device_close(rig->devices.devices[0]));
}

static const struct rg_record *record_at(const struct rig *rig, int row, int variant)
{
    return rg_result_at(&rig->result, (struct rg_place){.row = row, .variant = variant});
}

// A cell whose image differs from cpu:reference's is not timed.
static void test_another_image(void **state)
{
    (void)state;
    struct rig rig;
    image_read = read_another_image;
    measure(&rig, &table, 1);
    image_read = NULL;
    for (int variant = 0; variant < 2; variant++) {
        assert_int_equal(record_at(&rig, 0, variant)->outcome, RG_FAIL);
        assert_non_null(strstr(record_at(&rig, 0, variant)->detail, "(T0)"));
        assert_int_equal(record_at(&rig, 0, variant)->sample_count, 0);
    }
    finish(&rig);
}

// The number of frames before the image is compared, with and without a number in the table.
static void test_check_frames(void **state)
{
    (void)state;
    for (int frames = 0; frames <= 3; frames += 3) {
        const struct rg_table_part part = {.last_row = 0};
        struct rg_table aged = table;
        struct rg_devices none = {0};
        struct rg_result result = {0};
        aged.check_frames = frames;
        rg_table_begin(&result, &aged, &part, &none);
        assert_int_equal(result.check_frames, frames ? frames : RG_CHECK_FRAMES);
        rg_result_free(&result);
    }
}

// A row with a missing file does not end other rows.
static void test_table(void **state)
{
    (void)state;
    struct rig rig;
    assert_int_equal(measure(&rig, &table, 3), 1);
    assert_int_equal(rg_result_first_missing(&rig.result), 3);
    for (int row = 0; row < 3; row++) {
        for (int variant = 0; variant < 2; variant++) {
            const struct rg_record *record = record_at(&rig, row, variant);
            // The variant's sky replaces the row's file.
            const bool broken = row == 1 && variant == 1;
            assert_int_equal(record->outcome, broken ? RG_ERROR : RG_OK);
            assert_int_equal(record->truth_error.outcome, broken ? RG_ERROR : RG_OK);
            if (broken)
                continue;
            // The rain's own pixels differ by more than all together.
            assert_above(record->truth_error.flip_mean, 0);
            assert_above(record->truth_error.flip_mask_mean, record->truth_error.flip_mean);
            assert_above(record->truth_error.flip_mask_mean, 0.001);
            assert_between(record->truth_error.max_codes, 1, 255);
        }
    }
    const struct rg_record *broken = record_at(&rig, 1, 1);
    if (!strstr(broken->detail, "no image to check it by: /nonexistent.exr"))
        fail_msg("the file is not named: %s", broken->detail);
    assert_string_equal(broken->truth_error.detail, broken->detail);
    // Both assignments of a row are taken: the number of texels and that of drops.
    const int64_t small = record_at(&rig, 0, 1)->counters[0].value;
    const int64_t few = record_at(&rig, 2, 1)->counters[0].value;
    assert_equals(small, 40);
    assert_equals(few, 10);
    finish(&rig);
}

// A row has no drops: the variant without rain shows nothing and is not timed; the other variant is
// timed.
static void test_no_rain(void **state)
{
    (void)state;
    struct rig rig;
    measure(&rig, &table, 4);
    const struct rg_record *rainy = record_at(&rig, 3, 0), *dry = record_at(&rig, 3, 1);
    assert_int_equal(rainy->outcome, RG_OK);
    assert_at_least(rainy->sample_count, RG_LEAST_SAMPLES);
    assert_int_equal(dry->outcome, RG_NOTHING);
    assert_int_equal(dry->truth_error.outcome, RG_NOTHING);
    assert_int_equal(dry->sample_count, 0);
    assert_non_null(strstr(dry->detail, "without rain"));
    assert_string_equal(dry->truth_error.detail, dry->detail);
    finish(&rig);
}

// The table's `shown` sets again what its rows omit, and `truth` is set after it. Without both, the
// first row has other drops than its truth.
static void test_shown(void **state)
{
    (void)state;
    static const struct {
        const char *shown, *truth;
        bool is_equal;
    } cases[] = {{"drops=20", "drops=20", true},
                 {"drops=20 seed=5", "seed=5", true},
                 {"seed=5", "drops=20", false},
                 {NULL, "drops=40", true}}; // its own
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_table shows = table;
        struct rig rig;
        shows.variants[0] = table.variants[1];
        shows.variants[1].name = NULL;
        shows.shown = cases[i].shown;
        shows.truth = cases[i].truth;
        is_short = true;
        measure(&rig, &shows, 1);
        is_short = false;
        const struct rg_truth_error *error = &record_at(&rig, 0, 0)->truth_error;
        assert_int_equal(error->outcome, RG_OK);
        assert_int_equal(error->max_codes == 0, cases[i].is_equal);
        assert_int_equal(error->flip_mask_mean == 0, cases[i].is_equal);
        finish(&rig);
    }
}

// A cell is timed though its truth cannot be drawn, which its error tells.
static void test_no_truth(void **state)
{
    (void)state;
    struct rg_table lost = table;
    struct rig rig;
    lost.truth = "environment=/nonexistent.exr";
    lost.variants[1].name = NULL;
    is_short = true;
    measure(&rig, &lost, 1);
    is_short = false;
    const struct rg_record *record = record_at(&rig, 0, 0);
    assert_int_equal(record->outcome, RG_OK);
    assert_at_least(record->sample_count, RG_LEAST_SAMPLES);
    assert_int_equal(record->truth_error.outcome, RG_ERROR);
    assert_non_null(strstr(record->truth_error.detail, "/nonexistent.exr"));
    finish(&rig);
}

// A work that cpu:reference cannot do is checked by what it draws with other settings: here those
// of another picture, or of the same.
static void test_drawn_elsewhere(void **state)
{
    (void)state;
    static const char *const elsewhere[] = {"drops=20", "drops=40"};
    for (int same = 0; same < 2; same++) {
        struct rg_table asks = table;
        struct rig rig;
        asks.works[0] = (struct rg_table_work){
            .name = "queries", .set = "", .saves = "", .elsewhere = elsewhere[same]};
        asks.variants[0] = table.variants[1];
        asks.variants[1].name = NULL;
        work = "queries";
        is_short = true;
        measure(&rig, &asks, 1);
        work = NULL;
        is_short = false;
        assert_int_equal(record_at(&rig, 0, 0)->outcome, same ? RG_OK : RG_FAIL);
        finish(&rig);
    }
}

// --- the measured rows of a table ---

// No cell can be opened with these settings, so nothing takes time.
#define ROW                                                                                        \
    {                                                                                              \
        "resolution_px=nonsense", {0}, "environment"                                               \
    }
static const struct rg_table_row many[] = {ROW, ROW, ROW, ROW, ROW, ROW, ROW, ROW};
// A table of this name has claims that need row 7.
static const struct rg_table long_table = {
    .id = "feng-1",
    .technique = "flow",
    .about = "a test",
    .names = "texture",
    .columns = {"level"},
    .key_count = 1,
    .variants = {{"full", CHEAP, NULL}},
    .quick_rows = 2,
    .width = 16,
    .height = 16,
    .row_count = 8,
    .rows = many,
    .note = "a note",
};

// The rows that the result has, a digit each.
static int keep_rows(const struct rg_result *result, const void *user)
{
    char *had = *(char *const *)user;
    for (int row = result->first_row; row <= result->last_row; row++)
        if (rg_result_has(result, row))
            *had++ = (char)('1' + row);
    *had = 0;
    return 1;
}

// Asks for these rows, 0: for none, and expects `due`; NULL: nothing is measured or printed.
static void expect_rows(int first, int last, bool full, const char *due)
{
    const struct rg_table *const tables[] = {&long_table};
    struct rg_devices devices = {.count = 1, .devices = {rg_device_open("cpu")}};
    char had[RG_TABLE_ROWS + 1] = "", *found = had;
    const struct rg_regenerate_options options = {.first_row = first,
                                                  .last_row = last,
                                                  .full = full,
                                                  .fresh = true,
                                                  .folder = ".",
                                                  .print = keep_rows,
                                                  .user = &found};
    assert_int_equal(rg_tables_regenerate(tables, 1, &devices, &options),
                     due ? 1 : RG_EXIT_NOTHING);
    assert_string_equal(had, due ? due : "");
    assert_true(rg_device_close(devices.devices[0]));
}

// Quick mode takes the first rows and those that claims need, unless rows are named.
static void test_quick_rows(void **state)
{
    (void)state;
    expect_rows(0, 0, false, "127");
    expect_rows(3, 3, false, "3");
    expect_rows(2, 5, false, "2345");
    expect_rows(7, 12, true, "78"); // as far as the table has them
    expect_rows(9, 12, false, NULL);
    expect_rows(0, 0, true, "12345678");
}

// --- tables of textures, and sizes that a device cannot hold ---

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

static double told(const struct rg_record *record, const char *name)
{
    return *rg_named_number(record->facts, record->fact_count, name);
}

static void test_textures(void **state)
{
    (void)state;
    struct rig rig;
    measure(&rig, &texture_table, 4);
    const struct rg_record *whole = record_at(&rig, 0, 0);
    assert_int_equal(whole->outcome, RG_OK);
    assert_equals(told(whole, "width_px"), 16);
    assert_equals(told(whole, "height_px"), 16);
    assert_int_equal(record_at(&rig, 1, 0)->outcome, RG_FAIL);
    assert_string_equal(record_at(&rig, 1, 0)->detail, "the texture ends with level 1"); // 16 and 8
    assert_int_equal(record_at(&rig, 2, 0)->outcome, RG_ERROR);
    assert_string_equal(record_at(&rig, 2, 0)->detail, "flow has no texture 'carpet'");
    assert_int_equal(record_at(&rig, 3, 0)->outcome, RG_ERROR);
    finish(&rig);
}

static void test_unsupported(void **state)
{
    (void)state;
    struct rg_table wide = table;
    struct rig rig;
    wide.width = 1 << 20;
    measure(&rig, &wide, 1);
    const struct rg_record *record = record_at(&rig, 0, 0);
    assert_int_equal(record->outcome, RG_UNSUPPORTED);
    assert_non_null(strstr(record->detail, "1048576x64"));
    finish(&rig);
}

// --- the common objects of a table's cells ---

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
    void *settings = settings_of("flow", CHEAP, "drops=20"),
         *others = settings_of("flow", CHEAP, "drops=30");
    struct rg_subject subject = {rg_technique_find("flow"), settings, 32, 32};
    // Each device has one session, as long as the same subject is asked for.
    struct rg_session *first = rg_kept_open(&kept, cpu, &subject);
    const int64_t bytes = rg_device_work(cpu)->live_bytes;
    assert_ptr_equal(rg_kept_open(&kept, cpu, &subject), first);
    assert_ptr_not_equal(rg_kept_open(&kept, reference, &subject), first);
    subject.settings = others;
    assert_non_null(rg_kept_open(&kept, cpu, &subject));
    assert_equals(rg_device_work(cpu)->live_bytes, bytes);
    // A truth is drawn once.
    const struct rg_picture *truth = rg_kept_truth(&kept, &subject, 2);
    const int64_t runs = rg_device_work(cpu)->runs;
    assert_ptr_equal(rg_kept_truth(&kept, &subject, 2), truth);
    assert_equals(rg_device_work(cpu)->runs, runs);
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
    setenv("RG_LONG_S", "1e9", 1); // messages are counted, and a busy machine takes long
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_another_image),
        cmocka_unit_test(test_check_frames),
        cmocka_unit_test(test_table),
        cmocka_unit_test(test_no_rain),
        cmocka_unit_test(test_shown),
        cmocka_unit_test(test_no_truth),
        cmocka_unit_test(test_drawn_elsewhere),
        cmocka_unit_test(test_quick_rows),
        cmocka_unit_test(test_textures),
        cmocka_unit_test(test_unsupported),
        cmocka_unit_test(test_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
