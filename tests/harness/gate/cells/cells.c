// Cells of a gate are read from text, and an error names its line.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "core/base/text/place.h"
#include "harness/compare/gate/cells/cells.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

static bool read_text(const char *text, struct rg_gate_cells *cells)
{
    log_forget();
    return rg_gate_cells_of("my.txt", text, strlen(text), cells);
}

static double seed_of(const struct rg_gate_cell *cell)
{
    char text[64];
    rg_params_text(rg_params_find(cell->subject.technique->params, "seed"), cell->subject.settings,
                   text, sizeof(text));
    return atof(text);
}

static void cells_have_what_their_lines_say(void **state)
{
    (void)state;
    struct rg_gate_cells cells;
    assert_true(read_text("# mine\r\n\r\n a/b raster 128x96 10 seed=7\tbillboards=5\r\n"
                          "\tc.d-e_f raster 1x16384 0",
                          &cells));
    assert_int_equal(cells.count, 2);
    const struct rg_gate_cell *a = &cells.cells[0], *b = a + 1;
    assert_string_equal(a->name, "a/b");
    assert_string_equal(a->subject.technique->name, "raster");
    assert_int_equal(a->subject.width * 1000 + a->subject.height, 128096);
    assert_int_equal(a->frames, 10);
    assert_int_equal(a->line, 3);
    assert_string_equal(a->assignments, "seed=7 billboards=5");
    assert_equals(seed_of(a), 7);
    assert_string_equal(b->name, "c.d-e_f");
    assert_int_equal(b->subject.height, 16384);
    assert_int_equal(b->frames, 0);
    assert_string_equal(b->assignments, "");
    assert_equals(seed_of(b), 1);
    rg_gate_cells_free(&cells);
}

// Each is refused in one line that begins with the place.
static void what_is_wrong_is_said_with_its_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *said;
    } rows[] = {
        {"", "my.txt: no cell"},
        {"# nothing\n", "my.txt: no cell"},
        {"\na raster 8x8", "my.txt:2: a line of fewer than four words"},
        {"a* raster 8x8 1", "my.txt:1: name 'a*'"},
        {"-a raster 8x8 1", "my.txt:1: name '-a'"},
        {"\n\na rastr 8x8 1", "my.txt:3: technique 'rastr': unknown"},
        {"a raster 8x 1", "my.txt:1: size '8x'"},
        {"a raster 0x8 1", "my.txt:1: size '0x8'"},
        {"a raster 8x16385 1", "my.txt:1: size '8x16385'"},
        {"a raster 99999999999999999999x8 1", "my.txt:1: size"},
        {"a raster 8x8x8 1", "my.txt:1: size"},
        {"a raster 8x8 -1", "my.txt:1: frames '-1'"},
        {"a raster 8x8 100001", "my.txt:1: frames"},
        {"a raster 8x8 1e3", "my.txt:1: frames"},
        {"a raster 8x8 1 sed=1", "my.txt:1: parameter 'sed': raster has none"},
        {"a raster 8x8 1 seed=x", "my.txt:1: parameter 'seed': 'x' is no whole number"},
        {"a raster 8x8 1 seed", "my.txt:1: parameter 'seed': write it as"},
        {"a raster 8x8 1 seed=1 billboards=2 \tseed=1", "my.txt:1: parameter 'seed' stands twice"},
        {"a raster 8x8 1\nb raster 8x8 1\na raster 8x8 1", "my.txt:3: name 'a': line 1 has it"},
        {"a raster 8x8 1\na\x01 raster 8x8 1", "my.txt:2: control character 0x01 in column 2"},
        {"a raster 8x8 1\rb", "my.txt:1: control character 0x0d"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate_cells cells;
        assert_false(read_text(rows[i].text, &cells));
        rg_gate_cells_free(&cells);
        assert_int_equal(logged_lines, 1);
        if (strncmp(logged, rows[i].said, strlen(rows[i].said)) != 0)
            fail_msg("'%s' said: %s", rows[i].text, logged);
    }
    rg_error("elsewhere"); // later errors do not name the place
    assert_string_equal(logged, "elsewhere");
}

// Reads a raster's cell whose name has `length` bytes.
static bool read_named(size_t length)
{
    char *text = malloc(length + 32);
    assert_non_null(text);
    memset(text, 'n', length);
    memcpy(text + length, " raster 8x8 1", 14);
    struct rg_gate_cells cells;
    const bool ok = read_text(text, &cells);
    rg_gate_cells_free(&cells);
    free(text);
    return ok;
}

static void names_have_an_end(void **state)
{
    (void)state;
    assert_true(read_named(RG_GATE_NAME_SIZE - 1));
    assert_false(read_named(RG_GATE_NAME_SIZE));
    assert_false(read_named(10240));
    assert_int_equal(logged_lines, 1);
}

// Reads so many cells, each of as many frames as one may have.
static bool read_many(int count)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    for (int i = 0; i < count; i++)
        fprintf(out, "c%d raster 8x8 100000\n", i);
    assert_int_equal(fclose(out), 0);
    struct rg_gate_cells cells;
    const bool ok = read_text(text, &cells);
    if (ok)
        assert_ptr_equal(rg_gate_cells_find(&cells, "c1"), &cells.cells[1]);
    rg_gate_cells_free(&cells);
    free(text);
    return ok;
}

static void cells_and_frames_have_an_end(void **state)
{
    (void)state;
    assert_true(read_many(RG_GATE_CELLS));
    assert_false(read_many(RG_GATE_CELLS + 1));
    assert_string_equal(logged, "my.txt:4097: more than 4096 cells; split the file");
}

// A parameter whose name begins another's stands there once.
static void a_key_that_begins_another_is_not_that_one(void **state)
{
    (void)state;
    struct rg_gate_cells cells;
    assert_true(read_text("a drops 8x8 1 environment=sky environment_px=16", &cells));
    rg_gate_cells_free(&cells);
    assert_true(read_text("a drops 8x8 1 environment_px=16 environment=sky", &cells));
    rg_gate_cells_free(&cells);
}

static void fixed_functions_are_cells_too(void **state)
{
    (void)state;
    assert_string_equal(rg_gate_fixed_cell(0), "fixed/nearest");
    assert_string_equal(rg_gate_fixed_cell(2), "fixed/mip-nearest");
    assert_string_equal(rg_gate_fixed_cell(5), "fixed/LOD-bias-and-clamp");
    assert_string_equal(rg_gate_fixed_cell(0), "fixed/nearest"); // the first is still there
}

static void a_file_that_is_not_there_is_said(void **state)
{
    (void)state;
    struct rg_gate_cells cells;
    assert_false(rg_gate_cells_read("/nowhere/cells.txt", &cells));
    rg_gate_cells_free(&cells);
    assert_non_null(strstr(logged, "/nowhere/cells.txt: No such file"));
    assert_false(rg_gate_cells_read("/dev/null", &cells));
    rg_gate_cells_free(&cells);
    assert_non_null(strstr(logged, "/dev/null: is not a regular file"));
}

// Every technique has a cell, and each is small.
static void the_built_in_cells_are_of_all_techniques(void **state)
{
    (void)state;
    struct rg_gate_cells cells;
    assert_true(rg_gate_cells_read(NULL, &cells));
    for (int i = 0; rg_techniques[i]; i++) {
        int count = 0;
        for (int64_t c = 0; c < cells.count; c++)
            count += cells.cells[c].subject.technique == rg_techniques[i];
        if (count < 1 || count > 2)
            fail_msg("%s has %d cells", rg_techniques[i]->name, count);
    }
    for (int64_t c = 0; c < cells.count; c++)
        assert_true(cells.cells[c].subject.width <= 128 && cells.cells[c].frames >= 1);
    rg_gate_cells_free(&cells);
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_have_what_their_lines_say),
        cmocka_unit_test(what_is_wrong_is_said_with_its_line),
        cmocka_unit_test(names_have_an_end),
        cmocka_unit_test(cells_and_frames_have_an_end),
        cmocka_unit_test(a_key_that_begins_another_is_not_that_one),
        cmocka_unit_test(fixed_functions_are_cells_too),
        cmocka_unit_test(a_file_that_is_not_there_is_said),
        cmocka_unit_test(the_built_in_cells_are_of_all_techniques),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
