// Brief tables: the text of their cells, their width, and the lines below them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <pty.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/record/schema/schema.h"
#include "harness/console/terminal.h"
#include "harness/tables/sheet/below.h"
#include "harness/tables/sheet/brief.h"
#include "harness/tables/sheet/digits.h"
#include "tests/tools/expect.h"

enum { ROWS = 4 };

// A table of Creus, which has claims, with two works and five devices. A device's frame rates are
// the printed ones times its own factor; work `ours` takes half the time.
static const double factors[] = {2, 0.5, 0.123, 1, 0.04};

static void fill(struct rg_result *result, struct rg_place at)
{
    struct rg_record *record = rg_result_at(result, at);
    const double published = 80.0 / (1 << at.row);
    const double fps = published * factors[at.device] * (at.work ? 2 : 1);
    record->device = result->devices[at.device];
    rg_named_set_number(&record->row[record->row_count++], "culling_radius_m", 5 << at.row);
    rg_named_set_number(&record->published[record->published_count++], "fps", published);
    rg_named_set_number(&record->published[record->published_count++], "particles", 1000);
    rg_named_set_number(&record->facts[record->fact_count++], "particles",
                        at.row == 2 ? 1300 : 990);
    for (int i = 0; i < 6; i++)
        record->samples_ms[record->sample_count++] = 1000 / fps * (1 + 1e-4 * i);
    record->has_tally = true;
    record->tally.records = 20000 + at.row;
    record->tally.fragments = 3456789;
    if (at.row == 3 && at.device == 4)
        rg_record_end(record, RG_FAIL, "its image differs");
    rg_record_settle(record);
}

static void make_of(struct rg_result *result, int devices)
{
    static const char *const names[] = {"cpu", "cpu:reference", "gl", "vulkan", "opencl"};
    *result = (struct rg_result){.width = 1280, .height = 720, .last_row = ROWS - 1};
    snprintf(result->table, sizeof(result->table), "creus-5.4");
    snprintf(result->hardware, sizeof(result->hardware), "an old machine");
    snprintf(result->variants[result->variant_count++], RG_NAME_SIZE, "full");
    snprintf(result->works[0].name, RG_NAME_SIZE, "paper");
    snprintf(result->works[0].reading, RG_TITLE_SIZE, "two textures a light");
    snprintf(result->works[1].name, RG_NAME_SIZE, "ours");
    snprintf(result->works[1].saves, RG_TITLE_SIZE, "less is drawn");
    result->work_count = 2;
    for (; result->device_count < devices; result->device_count++)
        snprintf(result->devices[result->device_count].name,
                 sizeof(result->devices[result->device_count].name), "%s",
                 names[result->device_count]);
    memset(result->note, 'a', RG_NOTE_SIZE - 1);
    for (int i = 9; i < RG_NOTE_SIZE - 1; i += 10)
        result->note[i] = ' ';
    for (int row = 0; row < ROWS; row++)
        assert_true(rg_result_add_row(result, row));
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);)
        fill(result, at);
}

static void make(struct rg_result *result)
{
    make_of(result, 5);
}

// The printed table, until the next one is printed.
static const char *print(const struct rg_result *result)
{
    static char text[1 << 16];
    FILE *out = fmemopen(text, sizeof(text), "w");
    assert_non_null(out);
    assert_true(rg_brief_print(result, out));
    assert_int_equal(fclose(out), 0);
    return text;
}

// The same on a terminal of so many columns, without colours.
static const char *print_on(const struct rg_result *result, unsigned short columns)
{
    static char text[1 << 16];
    const struct winsize size = {.ws_row = 24, .ws_col = columns};
    size_t used = 0;
    int terminal, status;
    const pid_t child = forkpty(&terminal, NULL, NULL, &size);
    assert_at_least(child, 0);
    if (child == 0) {
        setenv("NO_COLOR", "1", 1);
        _exit(!rg_brief_print(result, stdout) || fflush(stdout));
    }
    for (ssize_t got = 1; got > 0; used += got > 0 ? (size_t)got : 0)
        got = read(terminal, text + used, sizeof(text) - 1 - used);
    text[used] = 0;
    close(terminal);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    return text;
}

// The characters of the longest line; of UTF-8 the bytes that begin one, and no line's end.
static int width_of(const char *text)
{
    int width = 0, widest = 0;
    for (const char *c = text; *c; c++) {
        width = *c == '\n' ? 0 : width + ((*c & 0xc0) != 0x80 && *c != '\r');
        widest = width > widest ? width : widest;
    }
    return widest;
}

static void expect(const char *text, const char *part)
{
    if (!strstr(text, part))
        fail_msg("'%s' is not in\n%s", part, text);
}

static void cells_are_beside_print(void **state)
{
    (void)state;
    struct rg_result result;
    make(&result);
    const char *text = print(&result);
    expect(text, "### paper: two textures a light\n");
    expect(text, "| culling radius, m | print | drawn |        cpu |  reference |");
    expect(text, "|                 5 |  80.0 |  0.99 |  160  2.0x | 40.0 0.50x | 9.84 0.12x |");
    // A row that draws too many particles, and a cell with another image.
    expect(text, "|                20 |  20.0 |  1.30 | 40.0 other | 10.0 other |");
    expect(text, "|       fail |");
    // Work that saves something is compared with the printed work.
    expect(text, "### ours, times paper\n");
    expect(text, "|  320  2.0x | 80.0  2.0x | 19.7  2.0x |  160  2.0x | 6.40  2.0x |");
    assert_null(strstr(text, "\033"));
    rg_result_free(&result);
}

// The first device is a native one, whose driver alone knows what it draws; the others count.
static void counts_are_of_devices_that_can_count(void **state)
{
    (void)state;
    struct rg_result result;
    make_of(&result, 2);
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);)
        if (at.device == 0)
            rg_result_at(&result, at)->tally.records = rg_result_at(&result, at)->tally.fragments =
                -1;
    const char *text = print(&result);
    expect(text, "| packed, k | shaded, k |");
    expect(text, "|      20.0 |      3457 |");
    rg_result_free(&result);
}

// Noise and other processes' load are marked at the number: as text if the page has room, else as
// one character.
static void uncertain_numbers_are_marked(void **state)
{
    (void)state;
    for (int devices = 2; devices <= 5; devices += 3) {
        struct rg_result result;
        make_of(&result, devices);
        assert_null(strstr(print(&result), "(+-, ~;"));
        for (int d = 0; d < devices; d++)
            rg_result_at(&result, (struct rg_place){.device = d})->frame_ms.high *= 1.44;
        rg_result_at(&result, (struct rg_place){.row = 1})->taken[2] = 0.48;
        const char *text = print(&result);
        expect(text, devices == 2 ? "| 160 +-20%  2.0x | 40.0 +-20% 0.50x |"
                                  : "|  160~  2.0x | 40.0~ 0.50x |");
        expect(text, devices == 2 ? "| 80.0 busy  2.0x |" : "| 80.0!  2.0x |");
        expect(text, "up to 20 %");
        expect(text, "up to 48 %");
        rg_result_free(&result);
    }
}

static void curves_are_those_of_print(void **state)
{
    (void)state;
    struct rg_result result;
    make(&result);
    const char *text = print(&result);
    expect(text,
           "Curves from 5 to 40: print \u2588\u2586\u2583\u2581, cpu \u2588\u2586\u2583\u2581, ");
    expect(text, "opencl \u2588\u2585\u2581.\n");
    rg_result_free(&result);
}

static void lines_are_short(void **state)
{
    (void)state;
    struct rg_result result;
    make(&result);
    assert_between(width_of(print(&result)), 90, RG_PAGE_WIDTH);
    rg_result_free(&result);
}

// A narrow terminal gets fewer columns, and is told of it; a wide one gets the intervals.
static void tables_fit_terminals(void **state)
{
    (void)state;
    struct rg_result result;
    make(&result);
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);) {
        struct rg_interval *ms = &rg_result_at(&result, at)->frame_ms;
        ms->low = ms->median / 1.25;
        ms->high = ms->median * 1.25;
    }
    const char *text = print_on(&result, 100);
    assert_between(width_of(text), 80, 100);
    expect(text, " 160~  2.0x |");
    text = print_on(&result, 90);
    assert_between(width_of(text), 70, 90);
    expect(text, "Without cpu:reference, for want of room; `raingauge table --wide` has all.");
    expect(text, " 160~  2.0x |");
    assert_null(strstr(text, "reference |"));
    for (unsigned short columns = 70; columns <= 80; columns += 10) {
        text = print_on(&result, columns);
        assert_between(width_of(text), columns - 20, columns);
        expect(text, "Without cpu:reference and how many times print it is, for ");
        assert_null(strstr(text, "2.0x"));
    }
    text = print_on(&result, 240);
    assert_between(width_of(text), RG_PAGE_WIDTH + 1, 240);
    expect(text, " 160 [128, 200]  2.0x |");
    rg_result_free(&result);
}

// For an article: a table for each work, of what print has and no more.
static void articles_have_what_print_has(void **state)
{
    (void)state;
    struct rg_result result;
    static char text[1 << 16];
    make(&result);
    rg_result_at(&result, (struct rg_place){.device = 1})->frame_ms.high *= 1.44;
    FILE *out = fmemopen(text, sizeof(text), "w");
    assert_non_null(out);
    assert_true(rg_brief_print_tex(&result, out));
    assert_int_equal(fclose(out), 0);
    expect(text,
           "\\caption{creus-5.4, paper: two textures a light. Frames a second; in print on an "
           "old machine}\n");
    expect(text, "\\begin{tabular}{@{}rrrrrrr@{}}\n\\toprule\nculling radius, m & print & cpu & "
                 "reference & gl & vulkan & opencl ");
    expect(text, "5 & 80.0 & 160 & 40.0 $\\pm$20\\% & 9.84 & 80.0 & 3.20 \\\\\n");
    expect(text, "\\caption{creus-5.4, ours, times paper.");
    expect(text, "& fail \\\\\n\\bottomrule\n");
    rg_result_free(&result);
}

static void claims_and_five_lines_stand_below(void **state)
{
    (void)state;
    struct rg_result result;
    make(&result);
    const char *text = print(&result);
    const char *claim = strstr(text, "- \"Small values achieve faster framerates\" (5.2.2): ");
    assert_non_null(claim);
    const char *notes = strstr(claim, "\n\n");
    assert_non_null(notes);
    int lines = 0;
    for (const char *c = notes + 2; *c; c++)
        lines += *c == '\n';
    assert_int_equal(lines, 5);
    expect(notes, "- 2 cells have no number; the first, on opencl: its image differs\n");
    expect(notes, "- Other work: rows 3 draw");
    expect(notes, "\n  ... (`raingauge table --wide`, csv and json have all of it)\n");
    rg_result_free(&result);
}

// Each of two axes of choices has its column.
static void choices_tell_rows_apart(void **state)
{
    (void)state;
    static const char *const times[] = {"day", "day", "night", "night"};
    struct rg_result result;
    make(&result);
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);) {
        struct rg_record *record = rg_result_at(&result, at);
        rg_named_set_text(&record->row[0], "time", times[at.row]);
        rg_named_set_text(&record->row[1], "geometry", at.row % 2 ? "off" : "on");
        record->row_count = 2;
    }
    expect(print(&result), "|  time | geometry |");
    expect(print(&result), "| night |      off |");
    rg_result_free(&result);
}

static void changed_settings_have_no_ratio(void **state)
{
    (void)state;
    struct rg_result result;
    make(&result);
    snprintf(result.changed, sizeof(result.changed), "seed=2");
    const char *text = print(&result);
    expect(text, "|  160 |      40.0 | 9.84 |   80.0 |   3.20 |");
    expect(text, "All cells have seed=2: not what was printed.");
    expect(text, "\"Small values achieve faster framerates\" (5.2.2): other work on all devices\n");
    rg_result_free(&result);
}

static void numbers_have_two_or_three_digits(void **state)
{
    (void)state;
    static const struct {
        double number;
        const char *rate, *ratio;
    } cases[] = {{0.0123, "0.012", "0.01"},  {0.0994, "0.099", "0.10"}, {0.4567, "0.46", "0.46"},
                 {0.0996, "0.10", "0.10"},   {0.994, "0.99", "0.99"},   {9.94, "9.94", "9.9"},
                 {99.94, "99.9", "100"},     {9.96, "9.96", "10"},      {0.00049, "0.000", "0.00"},
                 {0.996, "1.00", "1.0"},     {1.27, "1.27", "1.3"},     {9.994, "9.99", "10"},
                 {9.996, "10.0", "10"},      {27.44, "27.4", "27"},     {99.96, "100", "100"},
                 {12345.6, "12346", "12346"}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char text[32];
        rg_digits_rate(cases[i].number, text, sizeof(text));
        assert_string_equal(text, cases[i].rate);
        rg_digits_ratio(cases[i].number, text, sizeof(text));
        assert_string_equal(text, cases[i].ratio);
    }
}

static void headings_have_units(void **state)
{
    (void)state;
    static const char *const cases[][3] = {{"culling_radius_m", NULL, "culling radius, m"},
                                           {"cell_mm", NULL, "cell, mm"},
                                           {"texture_px", NULL, "texture, px"},
                                           {"particles_per_s", NULL, "particles, 1/s"},
                                           {"lights", NULL, "lights"},
                                           {"s", NULL, "s"},
                                           {"drops_m2_s", "1/(m2 s)", "drops, 1/(m2 s)"},
                                           {"fall_speed_m_s", "m/s", "fall speed, m/s"},
                                           {"rain_drops_s", "1/s", "rain drops, 1/s"},
                                           {"drag_1_m", "1/m", "drag, 1/m"},
                                           {"spin_deg", "deg/frame", "spin, deg/frame"},
                                           {"spin_yaw_deg_s", "deg/s", "spin yaw, deg/s"},
                                           {"memory_mb", "MB", "memory, MB"},
                                           {"move_threshold", "height", "move threshold, height"},
                                           {"rays_px", "1", "rays px"},
                                           {"model", "file", "model"}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char text[64];
        rg_digits_heading(cases[i][0], cases[i][1], text, sizeof(text));
        assert_string_equal(text, cases[i][2]);
        for (size_t size = 1; size < sizeof(text); size += 7) { // less room cuts it
            char cut[64];
            snprintf(cut, size, "%s", cases[i][2]);
            rg_digits_heading(cases[i][0], cases[i][1], text, size);
            assert_string_equal(text, cut);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_are_beside_print),
        cmocka_unit_test(counts_are_of_devices_that_can_count),
        cmocka_unit_test(uncertain_numbers_are_marked),
        cmocka_unit_test(curves_are_those_of_print),
        cmocka_unit_test(lines_are_short),
        cmocka_unit_test(tables_fit_terminals),
        cmocka_unit_test(articles_have_what_print_has),
        cmocka_unit_test(claims_and_five_lines_stand_below),
        cmocka_unit_test(choices_tell_rows_apart),
        cmocka_unit_test(changed_settings_have_no_ratio),
        cmocka_unit_test(numbers_have_two_or_three_digits),
        cmocka_unit_test(headings_have_units),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
