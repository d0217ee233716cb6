// Changes between two baselines, a line a cell, and the cells that a baseline must have before a
// gate compares with it.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "tests/harness/gate/baseline/made.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

// --- changes ---

static void assert_changes(const struct rg_baseline *then, const struct rg_baseline *now,
                           const char *due)
{
    char *text = NULL;
    size_t size, lines = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    const int count = rg_baseline_print_changes(then, now, out);
    fclose(out);
    for (const char *c = text; *c; c++)
        lines += *c == '\n';
    assert_string_equal(text, due);
    assert_int_equal(count, lines);
    free(text);
}

// One thing that is otherwise in what a row's cell left.
static void edit_row(int what, struct rg_baseline_row *row)
{
    switch (what) {
    case 0:
        snprintf(row->settings, RG_DIGEST_SIZE, SHA_A);
        break;
    case 1:
        row->outcome = RG_TIMEOUT;
        snprintf(row->why, sizeof(row->why), "it hung");
        break;
    case 2:
        row->outcome = RG_FAIL;
        break;
    case 3:
        snprintf(row->picture, RG_DIGEST_SIZE, SHA_A);
        snprintf(row->states[1].digest, RG_DIGEST_SIZE, SHA_A);
        break;
    case 4:
        snprintf(row->states[1].name, sizeof(row->states[1].name), "new");
        break;
    case 5:
        row->counters.counters[0].value = 99;
        break;
    case 6:
        snprintf(row->counters.counters[1].name, RG_NAME_SIZE, "new");
        break;
    case 7:
        row->work.items = 30;
        row->work.texels_fetched = 8;
        break;
    default:
        break;
    }
}

enum { TIMED = 8, MOVED = 12, NAMED, DRAWN, TIMED_NOW, LOST }; // what follows those of a row's cell

// One thing that is otherwise in the row of rain on vulkan, or in the whole.
static void edit(int what, struct rg_baseline *now)
{
    static const double ms[] = {0, 6, 2, 3.05, 6}; // the fourth is within what runs differ by
    struct rg_baseline_row *row = &now->rows[2];
    json_t *fixed = json_object_get(json_array_get(json_object_get(now->passport, "devices"), 0),
                                    "fixed_functions");
    edit_row(what, row);
    if (what == TIMED)
        row->launches.count = 0;
    else if (what > TIMED && what <= MOVED)
        row->launches = made_launches(ms[what - TIMED]);
    if (what == MOVED) // times of another key are not compared
        json_object_set_new(now->devices[1].parts, "driver", json_string("Mesa 26"));
    if (what == NAMED)
        snprintf(row->cell, sizeof(row->cell), "snow");
    if (what == LOST)
        row->state_count--;
    if (what == TIMED_NOW)
        now->rows[3].launches = made_launches(3);
    if (what != DRAWN)
        return;
    json_object_set_new(fixed, "linear", json_string(SHA_B));
    json_object_set_new(fixed, "stencil", json_string(SHA_B));
    json_object_del(fixed, "nearest");
}

static const char *const told[] = {
    "~ rain.vulkan: other settings\n",
    "~ rain.vulkan: timeout and not ok: it hung\n",
    "~ rain.vulkan: fail and not ok\n",
    "~ rain.vulkan: another picture, another state 'dry'\n",
    "~ rain.vulkan: a new state 'new', no state 'dry'\n",
    "~ rain.vulkan: 'drops' 99 and not 52\n",
    "~ rain.vulkan: a new counter 'new', no counter 'rays'\n",
    "~ rain.vulkan: 30 items a frame and not 3, 8 texels_fetched a frame and not -1\n",
    "~ rain.vulkan: not timed any more\n",
    "~ rain.vulkan: 6.07 ms a frame and not 3.03\n",
    "~ rain.vulkan: 2.02 ms a frame and not 3.03\n",
    "",
    "~ vulkan: another key: driver Mesa 26 and not Mesa 25\n",
    "+ snow.vulkan: new\n- rain.vulkan: gone\n",
    ("~ fixed function 'linear' of gl: another digest\n+ fixed function 'stencil' of gl: new\n"
     "- fixed function 'nearest' of gl: gone\n"),
    "~ flow.vulkan: timed now\n",
    "~ rain.vulkan: no state 'dry'\n",
    "",
};

static void each_change_is_told(void **state)
{
    (void)state;
    for (int i = 0; i < (int)(sizeof(told) / sizeof(told[0])); i++) {
        struct rg_baseline then = made_baseline(), now = made_baseline();
        edit(i, &now);
        assert_changes(&then, &now, told[i]);
        rg_baseline_free(&then);
        rg_baseline_free(&now);
    }
}

// A device that was not there before has no key that has changed.
static void a_new_device_has_new_rows_alone(void **state)
{
    (void)state;
    struct rg_baseline then = made_baseline(), now = made_baseline();
    json_decref(then.devices[1].parts);
    then.device_count = 1;
    then.count = 2;
    assert_changes(&then, &now, "+ rain.vulkan: new\n+ flow.vulkan: new\n");
    assert_changes(&now, &then, "- rain.vulkan: gone\n- flow.vulkan: gone\n");
    rg_baseline_free(&then);
    rg_baseline_free(&now);
}

// --- whether it fits ---

static const char text_of_cells[] = "rain raster 16x16 1\n\nflow raster 16x16 2 seed=7\n";

static void made_of(struct rg_gate_cells *cells, struct rg_baseline *baseline)
{
    assert_true(rg_gate_cells_of("c.txt", text_of_cells, strlen(text_of_cells), cells));
    *baseline = made_baseline();
    for (int i = 0; i < 4; i++)
        rg_digest_of_cell(&cells->cells[i % 2], baseline->rows[i].settings);
}

static const struct {
    const char *devices; // asked for
    int edit;
    const char *said; // "": it fits
} fits[] = {
    {NULL, 0, ""},
    {"all", 0, ""},
    {"vulkan,gl", 0, ""},
    {"gl,opencl", 0, "--device opencl: b.json has no such device; add it with"},
    {NULL, 1, "b.json: its cell 'snow' is not in c.txt; take it out with"},
    {NULL, 2, "b.json: its cell 'flow' has settings of digest " SHA_A ", and that of c.txt:3"},
    {NULL, 3, "b.json: has no cell 'flow' of c.txt:3; add it with"},
    {NULL, 4,
     "b.json: its device 'vk@A=1' sets variables, which may start programs and "
     "drivers, so that the command line has to name it; add --device gl,vk@A=1"},
    {"all", 4, "b.json: its device 'vk@A=1' sets variables"},
    {"gl", 4, ""},
    {"gl,vk@A=1", 4, ""},
    {NULL, 5,
     "b.json: its device 'vk@A=1;B=2' sets variables, which may start programs and "
     "drivers, so that the command line has to name it; add --device 'gl,vk@A=1;B=2'"},
};

static void a_baseline_fits_its_own_cells_and_devices(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(fits) / sizeof(fits[0]); i++) {
        struct rg_gate_cells cells;
        struct rg_baseline baseline;
        made_of(&cells, &baseline);
        if (fits[i].edit == 1)
            snprintf(baseline.rows[2].cell, RG_GATE_NAME_SIZE, "snow");
        if (fits[i].edit == 2)
            snprintf(baseline.rows[3].settings, RG_DIGEST_SIZE, SHA_A);
        if (fits[i].edit == 3)
            baseline.count = 3;
        for (int k = 2; k < 4 && fits[i].edit > 3; k++) {
            const char *name = fits[i].edit == 4 ? "vk@A=1" : "vk@A=1;B=2";
            snprintf(baseline.rows[k].device, RG_DEVICE_NAME_SIZE, "%s", name);
            snprintf(baseline.devices[1].name, RG_DEVICE_NAME_SIZE, "%s", name);
        }
        log_forget();
        const bool does = rg_baseline_fits(&baseline, "b.json", &cells, "c.txt", fits[i].devices);
        if (does != !*fits[i].said || logged_lines != !does ||
            strncmp(logged, fits[i].said, strlen(fits[i].said)) != 0)
            fail_msg("row %zu: %s", i, logged);
        rg_baseline_free(&baseline);
        rg_gate_cells_free(&cells);
    }
}

static void a_device_is_asked_for_by_its_whole_name(void **state)
{
    (void)state;
    static const struct {
        const char *devices, *device;
        bool asks;
    } rows[] = {{NULL, "gl", true},      {"all", "gl", true},
                {"gl", "gl", true},      {"cpu,gl", "gl", true},
                {"cpu", "gl", false},    {"gl@X=1", "gl", false},
                {"gl", "gl@X=1", false}, {"cpu,gl@X=1,vulkan", "gl@X=1", true}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        assert_int_equal(rg_baseline_asks(rows[i].devices, rows[i].device), rows[i].asks);
}

// --- rows and times ---

static void rows_devices_and_states_are_found_by_all_of_their_names(void **state)
{
    (void)state;
    struct rg_baseline made = made_baseline();
    for (int i = 0; i < 4; i++)
        assert_ptr_equal(rg_baseline_find(&made, i % 2 ? "flow" : "rain", i / 2 ? "vulkan" : "gl"),
                         &made.rows[i]);
    assert_null(rg_baseline_find(&made, "rain", "cpu"));
    assert_null(rg_baseline_find(&made, "snow", "gl"));
    assert_ptr_equal(rg_baseline_device(&made, "vulkan"), &made.devices[1]);
    assert_null(rg_baseline_device(&made, "cpu"));
    assert_ptr_equal(rg_baseline_state(&made.rows[1], "dry"), made.rows[1].states[1].digest);
    assert_null(rg_baseline_state(&made.rows[1], "other"));
    rg_baseline_free(&made);
}

static void launches_have_a_median_and_a_scatter(void **state)
{
    (void)state;
    const struct rg_launches odd = {3, {4, 1, 2}}, even = {4, {8, 1, 2, 4}}, none = {0, {0}};
    assert_equals(rg_launches_median(&odd), 2);
    assert_equals(rg_launches_median(&even), 3);
    assert_true(isnan(rg_launches_median(&none)));
    assert_equals(odd.ms[0], 4); // they keep their order
    const struct rg_gate_sample sample = rg_baseline_sample(&odd);
    assert_int_equal(sample.count, 3);
    assert_true(sample.logs[0] == log(4) && sample.logs[1] == 0 && sample.logs[2] == log(2));
    // Half of the launches are a tenth above the others: the median deviation is half of that.
    struct rg_launches two = {.count = 24};
    for (int i = 0; i < two.count; i++)
        two.ms[i] = i % 4 == 1 || i % 4 == 2 ? 1.1 : 1;
    const double due = expm1(1.4826 * log(1.1) / 2);
    assert_at_most(fabs(rg_baseline_scatter(&two) - due), 1e-9);
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_change_is_told),
        cmocka_unit_test(a_new_device_has_new_rows_alone),
        cmocka_unit_test(a_baseline_fits_its_own_cells_and_devices),
        cmocka_unit_test(a_device_is_asked_for_by_its_whole_name),
        cmocka_unit_test(rows_devices_and_states_are_found_by_all_of_their_names),
        cmocka_unit_test(launches_have_a_median_and_a_scatter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
