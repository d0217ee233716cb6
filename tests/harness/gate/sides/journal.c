// A gate's journal keeps launches as they were taken, and gives up those that are of another gate
// or of other code.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/compare/gate/sides/journal.h"
#include "harness/record/disk/seal.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

static void path_of(const char *name, char path[256])
{
    snprintf(path, 256, "%s/%s", folder, name);
}

static void forget(void)
{
    char path[256];
    path_of(RG_GATE_JOURNAL, path);
    unlink(path);
    path_of(RG_GATE_LAUNCHES, path);
    unlink(path);
}

static int tear_down(void **state)
{
    forget();
    return remove_folder(state);
}

static bool is_there(const char *name)
{
    char path[256];
    path_of(name, path);
    return !access(path, F_OK);
}

// Opens the journal of a gate whose key is a number.
static struct rg_gate_journal *reopen(int key, bool fresh)
{
    log_forget();
    struct rg_gate_journal *journal = rg_gate_journal_open(folder, json_integer(key), fresh);
    assert_non_null(journal);
    return journal;
}

static const struct rg_quads quads[] = {
    {-0.125, 4.5, 4.25, false}, {0.25, 0.001, 1e9, true}, {1.5, 0, 7.5, false}};
// The rows of two cells, by their launches.
static const struct {
    const char *name;
    int launch;
} kept[] = {{"rain.gl", 0}, {"rain.gl", 7}, {"flow.gl", 7}};

// A journal with three launches that was left by an interruption.
static void leave(void)
{
    forget();
    struct rg_gate_journal *journal = reopen(1, true);
    for (int i = 0; i < 3; i++) {
        rg_gate_journal_expect(journal, kept[i].name, "code");
        rg_gate_journal_add(journal, kept[i].name, kept[i].launch, &quads[i]);
    }
    assert_true(rg_gate_journal_close(journal, false));
    assert_true(is_there(RG_GATE_JOURNAL));
}

static int count_found(const struct rg_gate_journal *journal)
{
    struct rg_quads found;
    int count = 0;
    for (int i = 0; i < 3; i++)
        count += rg_gate_journal_find(journal, kept[i].name, kept[i].launch, &found);
    return count;
}

static void launches_are_found_as_they_were_taken(void **state)
{
    (void)state;
    leave();
    struct rg_gate_journal *journal = reopen(1, false);
    struct rg_quads found;
    assert_int_equal(logged_lines, 1);
    assert_non_null(strstr(logged, ": has times of 3 launches of a gate that was interrupted"));
    for (int i = 0; i < 3; i++) {
        assert_true(rg_gate_journal_find(journal, kept[i].name, kept[i].launch, &found));
        assert_true(found.log == quads[i].log && found.a_ms == quads[i].a_ms &&
                    found.b_ms == quads[i].b_ms && found.is_disturbed == quads[i].is_disturbed);
    }
    assert_false(rg_gate_journal_find(journal, "flow.gl", 0, &found));
    assert_false(rg_gate_journal_find(journal, "rain.gl", 1, &found));
    assert_false(rg_gate_journal_find(journal, "rain", 0, &found));
    assert_true(rg_gate_journal_close(journal, false));
}

static void a_journal_of_another_gate_is_not_gone_on_with(void **state)
{
    (void)state;
    leave();
    struct rg_gate_journal *journal = reopen(2, false);
    assert_non_null(
        strstr(logged, ": is of another build, machine, choice of devices or of cells"));
    assert_int_equal(count_found(journal), 0);
    assert_int_equal(logged_lines, 1);
    assert_true(rg_gate_journal_close(journal, false));
    journal = reopen(1, false); // nothing was added, so that nothing was written over
    assert_int_equal(count_found(journal), 3);
    assert_true(rg_gate_journal_close(journal, false));
    journal = reopen(1, true);
    assert_int_equal(count_found(journal) + logged_lines, 0);
    assert_true(rg_gate_journal_close(journal, false));
}

// Only the row whose code is another is timed anew.
static void launches_of_other_code_are_dropped(void **state)
{
    (void)state;
    leave();
    struct rg_gate_journal *journal = reopen(1, false);
    logged_lines = 0;
    rg_gate_journal_expect(journal, "flow.gl", "code");
    assert_true(logged_lines == 0 && count_found(journal) == 3);
    rg_gate_journal_expect(journal, "rain.gl", "other");
    assert_int_equal(logged_lines, 1);
    assert_non_null(strstr(
        logged, "gate.journal: what is kept of rain.gl was timed with other code; its times are"));
    assert_int_equal(count_found(journal), 1);
    rg_gate_journal_expect(journal, "new.gl", "other"); // nothing is kept of it
    assert_int_equal(logged_lines, 1);
    rg_gate_journal_add(journal, "rain.gl", 0, &quads[0]);
    assert_true(rg_gate_journal_close(journal, false));
    journal = reopen(1, false);
    logged_lines = 0;
    rg_gate_journal_expect(journal, "rain.gl", "other");
    assert_true(logged_lines == 0 && count_found(journal) == 2);
    assert_true(rg_gate_journal_close(journal, false));
}

// --- the end ---

static const char csv[] = "case,launch,log_ratio,a_ms,b_ms,disturbed\n"
                          "\"rain.gl\",0,-0.125,4.5,4.25,0\n"
                          "\"rain.gl\",7,0.25,0.001,1e+09,1\n"
                          "\"flow.gl\",7,,,7.5,0\n"
                          "\"a \"\"b\"\".gl\",3,0.333333333,1.5,2.5,0\n";

static void a_gate_that_is_done_leaves_its_launches(void **state)
{
    (void)state;
    char text[1024] = "", path[256];
    leave();
    struct rg_gate_journal *journal = reopen(1, false);
    rg_gate_journal_add(journal, "a \"b\".gl", 3, &(struct rg_quads){1 / 3.0, 1.5, 2.5, false});
    char *made = rg_gate_journal_csv(journal);
    assert_string_equal(made, csv);
    free(made);
    assert_true(rg_gate_journal_close(journal, true));
    assert_false(is_there(RG_GATE_JOURNAL));
    path_of(RG_GATE_LAUNCHES, path);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof(text) - 1, file)] = 0;
    fclose(file);
    assert_string_equal(text, csv);
    journal = reopen(1, false); // without launches, it removes those of an earlier gate
    made = rg_gate_journal_csv(journal);
    assert_string_equal(made, "");
    free(made);
    assert_true(rg_gate_journal_close(journal, true));
    assert_false(is_there(RG_GATE_LAUNCHES));
    assert_true(rg_gate_journal_close(NULL, true));
}

// Each launch is saved at once, so that it survives a kill. A journal that cannot be written is
// told once.
static void each_launch_is_saved(void **state)
{
    (void)state;
    forget();
    struct rg_gate_journal *journal = reopen(1, true), *other;
    rg_gate_journal_save(journal);
    assert_false(is_there(RG_GATE_JOURNAL)); // there is nothing to save yet
    for (int i = 0; i < 3; i++) {
        rg_gate_journal_add(journal, kept[i].name, kept[i].launch, &quads[i]);
        rg_gate_journal_save(journal);
        other = reopen(1, false);
        assert_int_equal(count_found(other), i + 1);
        assert_true(rg_gate_journal_close(other, false));
    }
    assert_true(rg_gate_journal_close(journal, true));
    forget();
    journal = rg_gate_journal_open("/nonexistent/out", json_integer(1), true);
    logged_lines = 0;
    for (int i = 0; i < 3; i++) {
        rg_gate_journal_add(journal, kept[i].name, kept[i].launch, &quads[i]);
        rg_gate_journal_save(journal);
        assert_int_equal(logged_lines, 1);
    }
    assert_false(rg_gate_journal_close(journal, true));
}

// --- journals that are none ---

// Writes a journal of these parts, sealed as raingauge does it.
static void write_journal(const char *format, const char *codes, const char *rows)
{
    char text[512], path[256];
    snprintf(text, sizeof(text), "{\"format\": %s, \"key\": 1, %s\"rows\": %s}", format, codes,
             rows);
    json_t *document = json_loads(text, 0, NULL);
    assert_non_null(document);
    assert_true(rg_seal(document));
    path_of(RG_GATE_JOURNAL, path);
    assert_int_equal(json_dump_file(document, path, 0), 0);
    json_decref(document);
}

#define CODES       "\"codes\": {}, "
#define ROW(launch) "{\"a\": [[4, 0.5, 1, 2, true], " launch "]}"

static void what_is_no_journal_is_told_and_left_out(void **state)
{
    (void)state;
    static const struct {
        const char *format, *codes, *rows, *said;
    } rows[] = {
        {"2", CODES, ROW("[0, -2, 0, 0.5, false]"), ": has times of 2 launches of a gate"},
        {"2", CODES, "{\"a\": [[4, 0.5, 1, 2, true]]}", ": has times of 1 launch of a gate"},
        {"3", CODES, ROW("[0, -2, 0, 0.5, false]"),
         ": has format 3 of a gate's journal, and this is 2; the gate begins anew"},
        {"2", CODES, ROW("[0, -2, 0, 0, false]"), ": is damaged or no journal"},
        {"2", CODES, ROW("[0, -2, -1, 0.5, false]"), ": is damaged or no journal"},
        {"2", CODES, ROW("[-1, -2, 0, 0.5, false]"), ": is damaged or no journal"},
        {"2", CODES, ROW("[0, -2, 0, 0.5]"), ": is damaged or no journal"},
        {"2", CODES, ROW("[0, -2, 0, 0.5, false, 1]"), ": is damaged or no journal"},
        {"2", CODES, "[]", ": is damaged or no journal"},
        {"2", "", ROW("[0, -2, 0, 0.5, false]"), ": is damaged or no journal"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_quads found;
        write_journal(rows[i].format, rows[i].codes, rows[i].rows);
        struct rg_gate_journal *journal = reopen(1, false);
        if (logged_lines != 1 || !strstr(logged, rows[i].said))
            fail_msg("row %zu: %s", i, logged);
        assert_int_equal(rg_gate_journal_find(journal, "a", 4, &found), i < 2);
        assert_true(rg_gate_journal_close(journal, false));
    }
}

// A changed number, which no checksum is made of anew.
static void a_damaged_journal_is_told_and_left_out(void **state)
{
    (void)state;
    char text[2048] = "", path[256];
    leave();
    path_of(RG_GATE_JOURNAL, path);
    FILE *file = fopen(path, "r+");
    assert_non_null(file);
    text[fread(text, 1, sizeof(text) - 1, file)] = 0;
    char *at = strstr(text, "4.25");
    assert_non_null(at);
    at[3] = '6';
    rewind(file);
    fputs(text, file);
    fclose(file);
    struct rg_gate_journal *journal = reopen(1, false);
    assert_non_null(strstr(logged, ": is damaged or no journal; the gate begins anew"));
    assert_int_equal(count_found(journal), 0);
    assert_true(rg_gate_journal_close(journal, false));
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(launches_are_found_as_they_were_taken),
        cmocka_unit_test(a_journal_of_another_gate_is_not_gone_on_with),
        cmocka_unit_test(launches_of_other_code_are_dropped),
        cmocka_unit_test(a_gate_that_is_done_leaves_its_launches),
        cmocka_unit_test(each_launch_is_saved),
        cmocka_unit_test(what_is_no_journal_is_told_and_left_out),
        cmocka_unit_test(a_damaged_journal_is_told_and_left_out),
    };
    return cmocka_run_group_tests(tests, make_folder, tear_down);
}
