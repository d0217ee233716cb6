// The expected seconds of a plan's cells, by hand: from the record of a cell, or else from those
// near it, or else from how fast the machine is.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/tables/farm/make.h"
#include "harness/tables/measuring/cell.h"
#include "harness/tables/measuring/measure.h"
#include "harness/tables/table.h"
#include "tests/tools/expect.h"

enum { TABLES = 3, ROWS = 2, DEVICES = 3 };
#define assert_s(value, s) assert_below(fabs((value) - (s)), 1e-9)

static const struct rg_table_row rows[] = {{"drops=1", {1}, NULL}, {"drops=2", {2}, NULL}};
static struct rg_table tables[TABLES];
static const struct rg_table *const all[] = {&tables[0], &tables[1], &tables[2]};

static void make_tables(void)
{
    static const char *const ids[] = {"t-0", "t-1", "t-2"};
    for (int i = 0; i < TABLES; i++)
        tables[i] = (struct rg_table){.id = ids[i],
                                      .technique = "flow",
                                      .columns = {"drops"},
                                      .key_count = 1,
                                      .variants = {{"full", "", NULL}},
                                      .width = 64,
                                      .height = 64,
                                      .check_frames = 10,
                                      .row_count = ROWS,
                                      .rows = rows,
                                      .note = "a note"};
}

static void make_plan(struct rg_farm_plan *plan, const char *devices, int count)
{
    *plan = (struct rg_farm_plan){.commit = "a commit"};
    assert_true(rg_farm_name_devices(plan, devices));
    assert_true(rg_farm_make(plan, all, count));
}

// The first row of a table, with a cell on each of these devices; frames take so long on each.
static struct rg_result stored_of(int table, int count, const char *const names[],
                                  const double frames_ms[])
{
    struct rg_device devices[DEVICES] = {0};
    struct rg_devices opened = {.count = count};
    struct rg_result result = {0};
    for (int d = 0; d < count; d++) {
        rg_text_copy(devices[d].info.name, RG_NAME_SIZE, names[d]);
        opened.devices[d] = &devices[d];
    }
    rg_table_begin(&result, &tables[table], &(struct rg_table_part){.last_row = 0}, &opened);
    assert_true(rg_table_add_row(&result, &tables[table], 0));
    for (int d = 0; d < count; d++) {
        struct rg_record *record = rg_result_at(&result, (struct rg_place){.device = d});
        record->create_ms = 30;
        record->first_frame_ms = frames_ms[d] + 50;
        record->sample_count = 1;
        record->samples_ms[0] = frames_ms[d];
        rg_record_settle(record);
    }
    return result;
}

// Opening takes what creating does, and how much longer the first frame is.
static struct rg_cell_frames frames_of(double frame_ms)
{
    return (struct rg_cell_frames){80, frame_ms, frame_ms};
}

static double cell_ms(const struct rg_cell_frames *frames, bool full)
{
    return rg_cell_ms(&tables[0], frames, rg_table_options(full));
}

// Opening and ten frames.
static double image_ms(double frame_ms)
{
    return 80 + 10 * frame_ms;
}

// A row's images are drawn for all of its devices together: one without rain by cpu, one of the
// truth, if there is one, and the expected one by cpu:reference, unless that is timed itself.
static void a_known_cell_takes_its_frames_and_images(void **state)
{
    (void)state;
    static const char *const names[] = {"cpu", "cpu:reference", "g"};
    static const double frames_ms[] = {40, 400, 20};
    static const struct {
        const char *devices;
        const char *truth;
        int count;
        double images_ms; // of cpu and of cpu:reference
        double reference_ms;
    } cases[] = {{"cpu", NULL, 1, 1, 1},
                 {"cpu", "drops=9", 1, 2, 1},
                 {"cpu,g=cpu@G=1", "drops=9", 2, 2, 1},
                 {"cpu,cpu:reference", NULL, 2, 1, 0},
                 {"cpu,cpu:reference,g=cpu@G=1", "drops=9", 3, 2, 0}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_farm_plan plan;
        make_tables();
        tables[0].truth = cases[i].truth;
        struct rg_result result = stored_of(0, 3, names, frames_ms);
        const struct rg_stored stored = {.count = 1, .results = &result};
        make_plan(&plan, cases[i].devices, 1);
        const double images_ms =
            cases[i].images_ms * image_ms(40) + cases[i].reference_ms * image_ms(400);
        const struct rg_cell_frames frames = frames_of(40);
        assert_int_equal(rg_farm_expect(&plan, all, 1, &stored, 1), cases[i].count);
        assert_s(plan.cells[0].seconds,
                 (cell_ms(&frames, false) + images_ms / cases[i].count) / 1000);
        rg_farm_plan_free(&plan);
        rg_result_free(&result);
    }
}

// A cell that did not run takes its images alone. One of textures takes its opening alone; the
// least is a twentieth of a second.
static void a_cell_without_frames_takes_little(void **state)
{
    (void)state;
    static const char *const names[] = {"cpu", "g"};
    static const double frames_ms[] = {40, 20};
    struct rg_farm_plan plan;
    make_tables();
    struct rg_result result = stored_of(0, 2, names, frames_ms);
    const struct rg_stored stored = {.count = 1, .results = &result};
    struct rg_record *ended = rg_result_at(&result, (struct rg_place){.device = 1});
    rg_record_end(ended, RG_CRASH, "the driver ended");
    make_plan(&plan, "g=cpu@G=1", 1);
    assert_int_equal(rg_farm_expect(&plan, all, 1, &stored, 1), 1);
    assert_s(plan.cells[0].seconds, image_ms(40) / 1000);
    tables[0].is_of_textures = true;
    assert_int_equal(rg_farm_expect(&plan, all, 1, &stored, 1), 1);
    assert_s(plan.cells[0].seconds, 0.05);
    ended->outcome = RG_OK;
    ended->create_ms = 250;
    assert_int_equal(rg_farm_expect(&plan, all, 1, &stored, 1), 1);
    assert_s(plan.cells[0].seconds, 0.3);
    rg_farm_plan_free(&plan);
    rg_result_free(&result);
}

// Of the first table's first row there are records on two devices, of the second's on one.
static void an_unknown_cell_takes_what_those_near_it_do(void **state)
{
    (void)state;
    static const char *const names[] = {"cpu", "cpu:reference"};
    static const double frames_ms[] = {400, 800}, other_ms[] = {600};
    struct rg_farm_plan plan;
    make_tables();
    struct rg_result results[] = {stored_of(0, 2, names, frames_ms),
                                  stored_of(1, 1, names + 1, other_ms)};
    const struct rg_stored stored = {.count = 2, .results = results};
    make_plan(&plan, "cpu,cpu:reference,d=cpu@D=1", TABLES);
    assert_int_equal(rg_farm_expect(&plan, all, TABLES, &stored, 1), 3);
    const struct rg_farm_cell *cells = plan.cells; // by table, row and device
    const double a = cells[0].seconds, b = cells[1].seconds, c = cells[ROWS * DEVICES + 1].seconds;
    assert_below(a, b);
    assert_below(c, b);
    assert_below(a, c);
    const double due[TABLES][ROWS][DEVICES] = {
        {{a, b, (a + b) / 2}, {a, b, (a + b) / 2}},
        {{c, c, c}, {c, c, c}},
        {{a, (b + c) / 2, (a + b + c) / 3}, {a, (b + c) / 2, (a + b + c) / 3}}};
    for (int t = 0; t < TABLES; t++)
        for (int row = 0; row < ROWS; row++)
            for (int d = 0; d < DEVICES; d++) {
                const struct rg_farm_cell *cell = &cells[(t * ROWS + row) * DEVICES + d];
                assert_s(cell->seconds, due[t][row][d]);
                assert_int_equal(cell->is_known, !row && ((t == 0 && d < 2) || (t == 1 && d == 1)));
            }
    double sum = 0;
    for (int64_t g = 0; g < plan.group_count; g++)
        sum += plan.groups[g].seconds;
    assert_s(sum, 3 * (a + b) + 6 * c + 2 * a + b + c + 2 * (a + b + c) / 3);
    rg_farm_plan_free(&plan);
    for (int i = 0; i < 2; i++)
        rg_result_free(&results[i]);
}

// 300 calibration loads to open, and 200 for a frame.
static void without_records_the_machine_tells(void **state)
{
    (void)state;
    const struct rg_stored none = {.count = 0};
    for (int full = 0; full < 2; full++) {
        struct rg_farm_plan plan;
        make_tables();
        tables[1].is_of_textures = true;
        make_plan(&plan, "cpu", 2);
        plan.full = full;
        assert_int_equal(rg_farm_expect(&plan, all, 2, &none, 2), 0);
        const struct rg_cell_frames frames = {600, 400, 400};
        for (int row = 0; row < ROWS; row++) {
            assert_s(plan.cells[row].seconds, cell_ms(&frames, full) / 1000);
            assert_s(plan.cells[ROWS + row].seconds, 0.6);
            assert_false(plan.cells[row].is_known);
        }
        rg_farm_plan_free(&plan);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_known_cell_takes_its_frames_and_images),
        cmocka_unit_test(a_cell_without_frames_takes_little),
        cmocka_unit_test(an_unknown_cell_takes_what_those_near_it_do),
        cmocka_unit_test(without_records_the_machine_tells),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
