// Tables from files: what a file's lines become, and how far each may go.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/tables/claims/claim.h"
#include "harness/tables/own/file.h"
#include "harness/tables/papers/papers.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

static char path[64];

static const struct rg_table *read_text(const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_at_least(fputs(text, file), 0);
    assert_int_equal(fclose(file), 0);
    *logged = 0;
    return rg_own_read(path);
}

static int set_up(void **state)
{
    rg_log_listen(log_last, NULL);
    if (make_folder(state))
        return -1;
    snprintf(path, sizeof(path), "%s/own.table", folder);
    return 0;
}

static int tear_down(void **state)
{
    return remove(path) || remove_folder(state);
}

// --- what lines become ---

static void expect_text(const char *found, const char *due)
{
    if (due)
        assert_string_equal(found, due);
    else
        assert_null(found);
}

static void expect_variant(const struct rg_table *table, int number, const char *name,
                           const char *set, const char *fps)
{
    expect_text(table->variants[number].name, name);
    expect_text(table->variants[number].set, set);
    expect_text(table->variants[number].fps, fps);
}

// Parameters and printed values stand in the order of the first row; what a row has not is no
// number.
static void expect_rows(const struct rg_table *table)
{
    static const char *const columns[] = {"resolution_px", "rain_drops_s", "fps",
                                          "faces",         "fps_few",      NULL};
    static const double due[3][5] = {
        {16, 0.5, 800, 12, 700}, {64, 1.5, 500, 13, 600}, {128, 2, 400, NAN, NAN}};
    assert_int_equal(table->key_count, 2);
    assert_int_equal(table->row_count, 3);
    for (int c = 0; c < 6; c++)
        expect_text(table->columns[c], columns[c]);
    for (int row = 0; row < 3; row++)
        for (int c = 0; c < 5; c++) {
            const double value = table->rows[row].values[c];
            assert_true(isnan(due[row][c]) ? isnan(value) : value == due[row][c]);
        }
    assert_string_equal(table->rows[1].set,
                        "move=paper panes=mirror resolution_px=64 rain_drops_s=1.5");
    assert_equals(rg_table_published_fps(table, 1, 0), 500);
    assert_equals(rg_table_published_fps(table, 1, 1), 600);
    assert_true(isnan(rg_table_published_fps(table, 1, 2)));
}

static void lines_become_a_table(void **state)
{
    (void)state;
    const struct rg_table *table = read_text(
        "# A comment.\ntable mine flow 48x32\nabout rate by texels\nset move=paper panes=mirror\n"
        "hardware A card\nnote of a test\nquick drops=5\ntruth drops=9\nframes 7\n"
        "variant few drops=20\nvariant bare seed=2\n"
        "row resolution_px=16 rain_drops_s=0.5 | fps=800 faces=12 fps_few=700\n"
        "row rain_drops_s=1.5 resolution_px=64 | faces=13 fps_few=600 fps=500\n"
        "row resolution_px=128 rain_drops_s=2|fps=400\n");
    assert_string_equal(logged, "");
    assert_non_null(table);
    assert_ptr_equal(rg_table_find("mine"), table);
    const char *const texts[][2] = {
        {table->id, "mine"},         {table->technique, "flow"}, {table->about, "rate by texels"},
        {table->hardware, "A card"}, {table->note, "of a test"}, {table->quick, "drops=5"},
        {table->truth, "drops=9"},   {table->names, NULL},       {table->works[0].name, NULL},
        {rg_table_paper(table), ""}};
    for (size_t i = 0; i < sizeof(texts) / sizeof(texts[0]); i++)
        expect_text(texts[i][0], texts[i][1]);
    assert_int_equal(table->width, 48);
    assert_int_equal(table->height, 32);
    assert_int_equal(table->check_frames, 7);
    assert_true(table->is_own && table->has_choices && rg_table_is_published(table));
    expect_variant(table, 0, "full", "", "fps");
    expect_variant(table, 1, "few", "drops=20", "fps_few");
    expect_variant(table, 2, "bare", "seed=2", NULL);
    expect_variant(table, 3, NULL, NULL, NULL);
    expect_rows(table);
}

// Files of an axis name the rows.
static void axes_become_rows(void **state)
{
    (void)state;
    const struct rg_table *table = read_text(
        "table axes flow 8x8\nset panes=mirror\naxis model=none,bunny\naxis resolution_px=16,32\n");
    assert_non_null(table);
    assert_string_equal(table->names, "model");
    assert_int_equal(table->key_count, 1);
    assert_int_equal(table->row_count, 4);
    for (int row = 0; row < 4; row++) {
        assert_string_equal(table->rows[row].name, row < 2 ? "none" : "bunny");
        assert_equals(table->rows[row].values[0], row % 2 ? 32 : 16);
    }
    assert_string_equal(table->about, "");
    assert_string_equal(table->note, "");
    assert_null(table->hardware);
}

static const struct rg_claim *first_about(const char *table)
{
    const struct rg_claim *claim = rg_claims;
    while (claim->table && strcmp(claim->table, table) != 0)
        claim++;
    return claim;
}

// A claim of the table "claimed". Without words of its own it is about the first variant, and
// stands in the file.
static void expect_claim(const struct rg_claim *found, const struct rg_claim *due)
{
    assert_string_equal(found->table, "claimed");
    assert_string_equal(found->words, due->words);
    assert_string_equal(found->variant, due->variant ? due->variant : "full");
    assert_string_equal(found->where, due->where ? due->where : "own.table");
    expect_text(found->other, due->other);
    assert_int_equal(found->test, due->test);
    assert_int_equal(found->source, due->where ? RG_CLAIM_SAID : RG_CLAIM_PRINTED);
    assert_int_equal(found->first, due->first);
    assert_int_equal(found->last, due->last);
    assert_int_equal(found->knee, due->knee);
    assert_int_equal(found->until, due->until);
    assert_equals(found->least, due->least);
    assert_equals(found->most, due->most);
    assert_true(found->is_ours);
}

static const struct rg_claim due_claims[] = {
    {.words = "slower", .test = RG_CLAIM_FALLS, .first = 1, .last = 3},
    {.words = "a thousand",
     .test = RG_CLAIM_RATIO,
     .first = 2,
     .last = 3,
     .variant = "few",
     .least = 1.5,
     .where = "4.2"},
    {.words = "the second", .test = RG_CLAIM_SLOWEST, .first = 1, .last = 3, .knee = 2, .until = 2},
    {.words = "early", .test = RG_CLAIM_OPTIMUM, .first = 1, .last = 3, .knee = 1, .until = 2},
    {.words = "few are fast",
     .test = RG_CLAIM_FASTER,
     .first = 3,
     .last = 3,
     .variant = "few",
     .other = "full",
     .least = 0.5},
    {.words = "alike", .test = RG_CLAIM_TIMES, .first = 1, .last = 3, .least = 2, .most = 2}};

// A claim is about all rows unless it names some; one row stands for both ends.
static void lines_become_claims(void **state)
{
    (void)state;
    assert_non_null(
        read_text("table claimed flow 8x8\nvariant few drops=20\nrow seed=1\nrow seed=2\n"
                  "row seed=3\nclaim falls | slower\n"
                  "claim ratio rows=2-3 variant=few least=1.5 section=4.2 | \"a thousand\"\n"
                  "claim slowest knee=2 | the second\nclaim optimum knee=1-2 | early\n"
                  "claim faster rows=3 variant=few other=full least=0.5 | few are fast\n"
                  "claim times most=2 least=2 | alike\n"));
    const struct rg_claim *found = first_about("claimed");
    for (size_t i = 0; i < sizeof(due_claims) / sizeof(due_claims[0]); i++)
        expect_claim(found++, &due_claims[i]);
    assert_null(found->table);
}

// Files that are read one after the other are all known, behind the papers' tables and claims.
static void files_add_to_what_is_known(void **state)
{
    (void)state;
    int tables = 0, claims = 0;
    while (rg_tables[tables])
        tables++;
    while (rg_claims[claims].table)
        claims++;
    const struct rg_table *first = read_text("table one flow 8x8\nrow seed=1\nclaim falls | a\n");
    const struct rg_table *second = read_text("table two flow 8x8\nrow seed=1\nclaim falls | b\n");
    assert_true(first && second);
    assert_ptr_equal(rg_tables[tables], first);
    assert_ptr_equal(rg_tables[tables + 1], second);
    assert_null(rg_tables[tables + 2]);
    assert_string_equal(rg_claims[claims].table, "one");
    assert_string_equal(rg_claims[claims + 1].words, "b");
    assert_null(rg_claims[claims + 2].table);
    assert_non_null(rg_table_find("creus-5.4"));
    assert_non_null(first_about("creus-5.4")->table);
    assert_null(read_text("table one flow 8x8\nrow seed=1\n"));
}

// --- how far they may go ---

#define ZOOM "row zoom=1\n"
#define EIGHT                                                                                      \
    "turn_deg=1 rise_deg=1 zoom=1 spin_deg=1 light_turn_deg=1 light_rise_deg=1 outline_px=1 "      \
    "inner_px=1"
#define EIGHT_AXES                                                                                 \
    "axis turn_deg=1\naxis rise_deg=1\naxis zoom=1\naxis spin_deg=1\naxis light_turn_deg=1\n"      \
    "axis light_rise_deg=1\naxis outline_px=1\naxis inner_px=1\n"
#define TWICE(word, text)                                                                          \
    {                                                                                              \
        word " " text "\n" word " " text, "", 0, "", 3, word ": stands twice; take one out"        \
    }
#define CLAIM(text, says)                                                                          \
    {                                                                                              \
        "row zoom=1\nrow zoom=2\nclaim " text " | x", "", 0, "", 4, says                           \
    }
#define NAMED ": write small letters, digits and - _ ., at most 39, and none of a paper's tables"

// The text of a file: some lines, a part that is repeated, whose # is its number, and the rest. The
// refused line (0: the file), and the end of what is said of it; NULL: the file is taken.
static const struct {
    const char *begins, *repeated;
    int times;
    const char *ends;
    int line;
    const char *says;
} cases[] = {
    {"table ", "n", 39, " flow 8x8\nrow seed=1", 0, NULL},
    {"table ", "n", 40, " flow 8x8\nrow seed=1", 1, NAMED},
    {"table 9a-b_c. flow 8x8\nrow seed=1", "", 0, "", 0, NULL},
    {"table -a flow 8x8\nrow seed=1", "", 0, "", 1, "name '-a'" NAMED},
    {"table wide flow 16384x1\nrow seed=1", "", 0, "", 0, NULL},
    {"table wider flow 16385x1\nrow seed=1", "", 0, "", 1,
     "size '16385x1': write WIDTHxHEIGHT of 1 to 16384 pixels, as in 640x360"},
    {"frames 1\n" ZOOM, "", 0, "", 0, NULL},
    {"frames 100000\n" ZOOM, "", 0, "", 0, NULL},
    {"frames 100001\n" ZOOM, "", 0, "", 2, "frames '100001': write a whole number of 1 to 100000"},
    {ZOOM, "variant v#\n", 9, "", 0, NULL},
    {ZOOM, "variant v#\n", 10, "", 12, "more than 10 variants; split the file"},
    {EIGHT_AXES, "", 0, "", 0, NULL},
    {EIGHT_AXES "axis crease_deg=1", "", 0, "", 10, "more than 8 axes"},
    {"row " EIGHT, "", 0, "", 0, NULL},
    {"row " EIGHT " crease_deg=1", "", 0, "", 2,
     "row: sets 'crease_deg' beside eight others; leave some out"},
    {"row mesh=", "a", 95, "", 0, NULL},
    {"row mesh=", "a", 96, "", 2, "' has more than 95 letters"},
    {"", "row seed=#\n", 64, "", 0, NULL},
    {"", "row seed=#\n", 65, "", 66, "more than 64 rows; split the file"},
    {"row zoom=1 |", " p#=1", 9, "\nhardware x", 0, NULL},
    {"row zoom=1 |", " p#=1", 10, "\nhardware x", 0,
     "more than 10 parameters and printed values a row"},
    {"row zoom=1 |", " p#=1", 11, "\nhardware x", 2, "row: more than 10 printed values"},
    {"row zoom=1 | fps=inf", "", 0, "", 2, "fps=inf: is no number"},
    {ZOOM "set ", "zoom=1 ", 72, "zoom=01", 0, NULL}, // 511 letters
    {ZOOM "set ", "zoom=1 ", 72, "zoom=001", 3, "more than 511 letters; leave some settings out"},
    TWICE("about", "a"),
    TWICE("set", "zoom=1"),
    TWICE("hardware", "a"),
    TWICE("note", "a"),
    TWICE("quick", "zoom=1"),
    TWICE("truth", "zoom=1"),
    TWICE("frames", "7"),
    {ZOOM, "claim falls | c#\n", 31, "", 0, NULL},
    {ZOOM, "claim falls | c#\n", 32, "", 34, "claim: more than 31; leave some out"},
    {ZOOM "claim falls | ", "x", 120, "", 0, NULL},
    CLAIM("alike", "claim alike: needs a number; add most="),
    CLAIM("optimum", "claim optimum: needs a number; add knee="),
    CLAIM("crosses knee=1", "claim crosses: needs a number; add other="),
    CLAIM("falls most=2", "claim falls: has no use for most=; take it out"),
    CLAIM("falls knee=1", "claim falls: has no use for knee=; take it out"),
    CLAIM("falls other=full", "claim falls: has no use for other=; take it out"),
    CLAIM("falls rows=0-1", "rows=0-1: write it as FIRST-LAST, of rows 1-2; rows stand before "
                            "claims"),
    CLAIM("falls rows=2-1", "rows=2-1: write it as FIRST-LAST, of rows 1-2; rows stand before "
                            "claims"),
    CLAIM("slowest knee=3", "knee=3: write it as FIRST-LAST, of rows 1-2; rows stand before "
                            "claims"),
    CLAIM("slowest rows=2-2 knee=1", "claim slowest: its knee lies outside of its rows"),
    CLAIM("optimum rows=1-1 knee=1-2", "claim optimum: its knee lies outside of its rows"),
    CLAIM("ratio least=inf", "least=inf: is no number"),
    CLAIM("times least=3 most=2.5", "claim times: least=3 is more than most=2.5"),
};

// Writes a case's file. Unless the case has a head, the file gets one of its own.
static void write_case(size_t number, char *text, size_t size)
{
    const bool has_head = !strncmp(cases[number].begins, "table ", 6);
    char head[64] = "";
    if (!has_head)
        snprintf(head, sizeof(head), "table case-%zu cartoon 8x8\n", number);
    size_t used = (size_t)snprintf(text, size, "%s%s", head, cases[number].begins);
    for (int i = 1; i <= cases[number].times; i++)
        for (const char *c = cases[number].repeated; *c; c++)
            if (*c == '#')
                used += (size_t)snprintf(text + used, size - used, "%d", i);
            else
                text[used++] = *c;
    snprintf(text + used, size - used, "%s\n", cases[number].ends);
}

static void each_line_has_its_limit(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char text[4096], place[96];
        write_case(i, text, sizeof(text));
        const bool is_taken = read_text(text);
        if (is_taken != !cases[i].says)
            fail_msg("is %s: %s\n%s", is_taken ? "taken" : "refused", text, logged);
        if (is_taken)
            continue;
        snprintf(place, sizeof(place), "%s: ", path);
        if (cases[i].line)
            snprintf(place, sizeof(place), "%s:%d: ", path, cases[i].line);
        const size_t length = strlen(logged), end = strlen(cases[i].says);
        if (strncmp(logged, place, strlen(place)) != 0 || length < end ||
            strcmp(logged + length - end, cases[i].says) != 0)
            fail_msg("'%s' is told, not '%s...%s'", logged, place, cases[i].says);
    }
}

static void names_of_files_have_a_slash_or_end_so(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        bool is_file;
    } names[] = {{"a/b", true},     {"/", true},          {"x.table", true},
                 {".table", false}, {"x.tables", false},  {"x.table2", false},
                 {"table", false},  {"creus-5.4", false}, {"", false}};
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
        if (rg_own_is_file(names[i].name) != names[i].is_file)
            fail_msg("'%s' is %sa file", names[i].name, names[i].is_file ? "not " : "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_become_a_table),
        cmocka_unit_test(axes_become_rows),
        cmocka_unit_test(lines_become_claims),
        cmocka_unit_test(files_add_to_what_is_known),
        cmocka_unit_test(each_line_has_its_limit),
        cmocka_unit_test(names_of_files_have_a_slash_or_end_so),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
