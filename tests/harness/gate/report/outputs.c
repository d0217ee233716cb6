// Which reports of a gate go where, and what they may not replace.
#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/commands/comparing/outputs.h"
#include "harness/compare/gate/text/date.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"
#include "tests/tools/process/printed.h"

static int begin(void **state)
{
    unsetenv("GITHUB_STEP_SUMMARY");
    rg_log_listen(log_last, NULL);
    log_forget();
    return make_folder(state) || chdir(folder);
}

static int end(void **state)
{
    rg_log_listen(NULL, NULL);
    return chdir("/") || remove_whole_folder(state);
}

// --- googletest's flags ---

static void gtest_names_a_file(void **state)
{
    (void)state;
    static const struct {
        const char *output, *path;
    } rows[] = {{NULL, ""},
                {"", ""},
                {"xml", "test_detail.xml"},
                {"xml:a.xml", "a.xml"},
                {"xml:x/y/", "x/y/raingauge.xml"},
                {"xml:/", "/raingauge.xml"},
                {"xml:", NULL},
                {"json:a", NULL},
                {"xmls", NULL}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char path[PATH_MAX] = "unset";
        const struct rg_gtest_asked asked = {.output = (char *)rows[i].output};
        logged_lines = 0;
        assert_int_equal(rg_gtest_output(&asked, path), rows[i].path != NULL);
        assert_int_equal(logged_lines, !rows[i].path);
        assert_string_equal(path, rows[i].path ? rows[i].path : "");
    }
    struct stat found;
    assert_true(!stat("x/y", &found) && S_ISDIR(found.st_mode));
    assert_string_equal(logged, "--gtest_output xmls: write it as xml:FILE; --json prints JSON");
}

// A variable stands for a flag that is not given.
static void gtest_has_variables(void **state)
{
    (void)state;
    struct rg_gtest_asked asked = {.filter = NULL};
    setenv("GTEST_FILTER", "a*", 1);
    setenv("GTEST_OUTPUT", "", 1);
    rg_gtest_inherit(&asked);
    assert_string_equal(asked.filter, "a*");
    assert_null(asked.output);
    setenv("GTEST_OUTPUT", "xml", 1);
    asked.filter = (char *)"b*";
    rg_gtest_inherit(&asked);
    assert_string_equal(asked.filter, "b*");
    assert_string_equal(asked.output, "xml");
    unsetenv("GTEST_FILTER");
    unsetenv("GTEST_OUTPUT");
}

// --- which reports ---

// The kinds of output that are written, each with its file.
static const char *written(const struct rg_gate_outputs *outputs)
{
    static const char *const names[RG_REPORT_FORM_COUNT] = {
        [RG_AS_JUNIT] = "junit",    [RG_AS_BMF] = "bmf",   [RG_AS_JSON] = "json",
        [RG_AS_GTEST] = "gtest",    [RG_AS_TEXT] = "text", [RG_AS_GITHUB] = "github",
        [RG_AS_SUMMARY] = "summary"};
    static char text[512];
    *text = 0;
    for (int i = 0; i < RG_REPORT_FORM_COUNT; i++) {
        const char *file = outputs->files[i];
        if (outputs->are_written[i])
            snprintf(text + strlen(text), sizeof(text) - strlen(text), "%s%s%s%s",
                     *text ? ", " : "", names[i], file ? " " : "", file ? file : "");
    }
    return text;
}

struct asked {
    const char *junit, *bmf;
    bool json, github;
    const char *filter, *output, *summary, *folder;
    bool is_sharded;
};

static bool settle(const struct asked *row, struct rg_gate_outputs *outputs)
{
    struct rg_reports_asked reports = {{0}, {0}};
    const struct rg_gtest_asked gtest = {.filter = (char *)row->filter,
                                         .output = (char *)row->output};
    reports.files[RG_AS_JUNIT] = (char *)row->junit;
    reports.files[RG_AS_BMF] = (char *)row->bmf;
    reports.flags[RG_AS_JSON] = row->json;
    reports.flags[RG_AS_GITHUB] = row->github;
    unsetenv("GITHUB_STEP_SUMMARY");
    if (row->summary)
        setenv("GITHUB_STEP_SUMMARY", row->summary, 1);
    *outputs = (struct rg_gate_outputs){.today = 0};
    return rg_gate_outputs_settle(&reports, row->folder, &gtest, row->is_sharded, outputs);
}

// People's text is printed unless another form is, in googletest's words for its runners; files
// come besides.
static void reports_go_where_they_are_asked(void **state)
{
    (void)state;
    static const struct {
        struct asked asked;
        const char *written, *pictures;
    } rows[] = {
        {{.junit = NULL}, "text", ""},
        {{.json = true}, "json", ""},
        {{.github = true}, "text, github", ""},
        {{.github = true, .summary = "sum.md"}, "text, github, summary sum.md", ""},
        {{.github = true, .summary = ""}, "text, github", ""},
        {{.summary = "sum.md"}, "text", ""},
        {{.filter = "*"}, "gtest", ""},
        {{.is_sharded = true}, "gtest", ""},
        {{.output = "xml:a.xml"}, "junit a.xml, gtest", "a-pictures"},
        {{.output = "xml:a.xml", .junit = "b.xml"}, "junit b.xml, gtest", "b-pictures"},
        {{.junit = "b.xml", .bmf = "c.json"}, "junit b.xml, bmf c.json, text", "b-pictures"},
        {{.junit = "b.xml", .json = true}, "junit b.xml, json", "b-pictures"},
        {{.junit = "b.xml", .folder = "out"}, "junit b.xml, text", "out"},
        {{.junit = "b.txt"}, "junit b.txt, text", "b.txt-pictures"},
        {{.junit = "x.xml/b"}, "junit x.xml/b, text", "x.xml/b-pictures"},
        {{.junit = "./b.xml"}, "junit ./b.xml, text", "./b-pictures"},
        {{.junit = "b.1.xml"}, "junit b.1.xml, text", "b.1-pictures"},
        {{.folder = "out"}, "text", "out"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate_outputs outputs;
        assert_true(settle(&rows[i].asked, &outputs));
        assert_string_equal(written(&outputs), rows[i].written);
        assert_string_equal(outputs.pictures, rows[i].pictures);
        assert_int_equal(outputs.is_folder_asked, rows[i].asked.folder != NULL);
    }
    assert_int_equal(logged_lines, 0);
}

static void paths_have_room_for_pictures(void **state)
{
    (void)state;
    static char path[PATH_MAX];
    struct rg_gate_outputs outputs;
    const size_t most = PATH_MAX - sizeof("-pictures") - 1;
    memset(path, 'x', most);
    assert_true(settle(&(struct asked){.junit = path}, &outputs));
    assert_int_equal(strlen(outputs.pictures), most + strlen("-pictures"));
    assert_true(settle(&(struct asked){.folder = path}, &outputs));
    assert_int_equal(logged_lines, 0);
    path[most] = 'x';
    assert_false(settle(&(struct asked){.junit = path}, &outputs));
    assert_false(settle(&(struct asked){.folder = path}, &outputs));
    assert_int_equal(logged_lines, 2);
}

// --- what stays ---

// Neither a report nor what is kept in the folder replaces an input.
static void inputs_stay(void **state)
{
    (void)state;
    static const struct asked asked = {
        .junit = "b.xml", .bmf = "c.json", .github = true, .summary = "sum.md", .folder = "out"};
    static const struct {
        const char *input;
        bool is_spared;
    } rows[] = {{NULL, true},
                {"a.txt", true},
                {"b.xml", false},
                {"./b.xml", false},
                {"c.json", false},
                {"sum.md", false},
                {"out/a.txt", true},
                {"out/gate.journal", false},
                {"out/launches.csv", false},
                {"gate.journal", true}};
    struct rg_gate_outputs outputs;
    assert_int_equal(mkdir("out", 0777), 0);
    assert_true(settle(&asked, &outputs));
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        logged_lines = 0;
        if (rg_gate_outputs_spare(&outputs, rows[i].input) != rows[i].is_spared)
            fail_msg("%s", rows[i].input);
        assert_int_equal(logged_lines, !rows[i].is_spared);
    }
    assert_false(rg_gate_outputs_spare(&outputs, "./b.xml"));
    assert_string_equal(logged, "b.xml: would be overwritten with a report, and is named as "
                                "'./b.xml' as well; name another file for the report");
}

// Each report has a file of its own, which can be written.
static void reports_can_be_written(void **state)
{
    (void)state;
    static const struct {
        struct asked asked;
        bool can_be;
    } rows[] = {
        {{.junit = "b.xml", .bmf = "c.json", .github = true, .summary = "sum.md"}, true},
        {{.junit = "b.xml", .bmf = "./b.xml"}, false},
        {{.junit = "b.xml", .github = true, .summary = "b.xml"}, false},
        {{.junit = "none/b.xml"}, false},
        {{.bmf = "none/c.json"}, false},
        {{.github = true, .summary = "none/sum.md"}, false},
        {{.bmf = "out/gate.journal", .folder = "out"}, false},
        {{.bmf = "out/c.json", .folder = "out"}, true},
        {{.folder = "none/out"}, false},
        {{.folder = "new"}, true},
    };
    assert_int_equal(mkdir("out", 0777), 0);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate_outputs outputs;
        logged_lines = 0;
        assert_true(settle(&rows[i].asked, &outputs));
        if (rg_gate_outputs_can_be_written(&outputs) != rows[i].can_be)
            fail_msg("row %zu: %s", i, logged);
        assert_int_equal(logged_lines, !rows[i].can_be);
    }
}

// --- expectations that are not true ---

#define FIXED "fail a\n  outcome fail\n  reason r\n  since 2026-01-01\n  until 2026-12-31\n"

static void write_text(const char *name, const char *text)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static const char *text_in(const char *name)
{
    static char text[1024];
    FILE *file = fopen(name, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof(text) - 1, file)] = 0;
    fclose(file);
    return text;
}

// Prints a gate in which "a" passed and "b" failed, beside two files which expect that of "a" and
// nothing. `meanwhile`: the first file's text after it was read; NULL: as it was.
static bool print(bool updates, bool is_part, const char *meanwhile, const char **printed)
{
    struct rg_known_result results[] = {{"a", "gl", "M", RG_OK, 0, 0, false},
                                        {"b", "gl", "M", RG_FAIL, 3, 1, false}};
    const struct rg_gate gate = {.results = results, .result_count = 2};
    struct rg_gate_outputs outputs;
    struct rg_known known = {.count = 0};
    assert_true(settle(&(struct asked){.junit = NULL}, &outputs));
    outputs.updates = updates;
    outputs.is_part = is_part;
    assert_true(rg_date_read("2026-06-01", &outputs.today));
    write_text("first.txt", FIXED);
    write_text("second.txt", "");
    assert_true(rg_known_add(&known, "first.txt", RG_FORM_OWN));
    assert_true(rg_known_add(&known, "second.txt", RG_FORM_OWN));
    if (meanwhile)
        write_text("first.txt", meanwhile);
    log_forget();
    printed_begin();
    const bool ok = rg_gate_outputs_print(&outputs, &known, &gate);
    *printed = printed_end();
    rg_known_free(&known);
    return ok;
}

// Files that are not true of a run are told, and written anew on request; new failures stand in the
// first of them, and what somebody wrote meanwhile stays.
static void expectations_are_mended_on_request(void **state)
{
    (void)state;
    static const char told[] = "first.txt: is not true of this run; --update writes it anew\n";
    const char *printed;
    assert_true(print(false, false, NULL, &printed));
    assert_non_null(strstr(printed, told));
    assert_null(strstr(printed, "second.txt"));
    assert_string_equal(text_in("first.txt"), FIXED);
    assert_true(print(true, true, NULL, &printed)); // a shard does not know of others' cells
    assert_null(strstr(printed, told));
    assert_string_equal(text_in("first.txt"), FIXED);
    assert_true(print(true, false, NULL, &printed));
    assert_string_equal(logged, "first.txt: written anew; `git diff` shows what changed");
    assert_null(strstr(text_in("first.txt"), "fail a\n"));
    assert_non_null(strstr(text_in("first.txt"), "fail b"));
    assert_string_equal(text_in("second.txt"), "");
    assert_false(print(true, false, FIXED "# more\n", &printed));
    assert_string_equal(logged,
                        "first.txt: was changed while the gate ran, and stays; run it again");
    assert_string_equal(text_in("first.txt"), FIXED "# more\n");
}

#define LISTENING(test) cmocka_unit_test_setup_teardown(test, begin, end)

int main(void)
{
    const struct CMUnitTest tests[] = {
        LISTENING(gtest_names_a_file),
        LISTENING(gtest_has_variables),
        LISTENING(reports_go_where_they_are_asked),
        LISTENING(paths_have_room_for_pictures),
        LISTENING(inputs_stay),
        LISTENING(reports_can_be_written),
        LISTENING(expectations_are_mended_on_request),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
