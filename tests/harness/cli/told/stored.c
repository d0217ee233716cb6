// Results that are stored are printed and written in the parts that are asked for.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/record/schema/schema.h"
#include "harness/tables/print.h"
#include "tests/harness/cli/asked.h"
#include "tests/harness/record/made.h"
#include "tests/tools/expect.h"

// Writes results into a file, one after the other: rows 2 to 4 of two works and variants, without
// row 3.
static void store(const char *path, int count, const char *cpu)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int i = 0; i < count; i++) {
        struct rg_result made = make_result();
        json_object_set_new(made.passport, "machine", json_pack("{ss}", "cpu", cpu));
        json_t *document = rg_result_json(&made);
        json_dumpf(document, file, RG_JSON_FLAGS);
        json_decref(document);
        rg_result_free(&made);
    }
    assert_int_equal(fclose(file), 0);
}

// Prints a part of the result by itself.
static char *printed_part(int first, int last, const char *work, const char *variant, int form)
{
    struct rg_result made = make_result();
    assert_true(!first || rg_result_keep_rows(&made, first - 1, last - 1));
    assert_true(!work || rg_result_keep_work(&made, work));
    assert_true(!variant || rg_result_keep_variant(&made, variant));
    made.is_part = first || work || variant;
    char *text = print_result(&made, form);
    rg_result_free(&made);
    return text;
}

static void parts_are_printed(void **state)
{
    (void)state;
    static const struct {
        const char *line;
        int first, last;
        const char *work, *variant;
        int form;
    } rows[] = {
        {"table --from a.json", 0, 0, NULL, NULL, RG_RESULT_MD},
        {"table --from a.json --format csv", 0, 0, NULL, NULL, RG_RESULT_CSV},
        {"table --from a.json --format tex", 0, 0, NULL, NULL, RG_RESULT_TEX},
        {"table --from a.json --wide", 0, 0, NULL, NULL, RG_RESULT_WIDE},
        {"table --from a.json --json", 0, 0, NULL, NULL, RG_RESULT_JSON},
        {"table --from a.json --rows 4-9 --format csv", 4, 9, NULL, NULL, RG_RESULT_CSV},
        {"table --from a.json --rows 2-3 --format csv", 2, 3, NULL, NULL, RG_RESULT_CSV},
        {"table --from a.json --rows 2 --format csv", 2, 2, NULL, NULL, RG_RESULT_CSV},
        {"table --from a.json --work ours --format csv", 0, 0, "ours", NULL, RG_RESULT_CSV},
        {"table --from a.json --variant bare", 0, 0, NULL, "bare", RG_RESULT_MD},
        {"table --from a.json --variant full --work paper --rows 4-4 --wide", 4, 4, "paper", "full",
         RG_RESULT_WIDE},
    };
    store("a.json", 1, "Toy");
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char *due =
            printed_part(rows[i].first, rows[i].last, rows[i].work, rows[i].variant, rows[i].form);
        asked_run(rows[i].line);
        if (rows[i].form != RG_RESULT_JSON)
            assert_string_equal(asked_printed, due);
        else
            assert_non_null(strstr(asked_printed, "\"table\": \"test-1.2\""));
        assert_string_equal(asked_seen, "memory 0; "); // no device is opened
        free(due);
    }
}

// Of several tables those that are named are printed.
static void tables_are_chosen(void **state)
{
    (void)state;
    store("a.json", 1, "Toy");
    struct rg_result other = make_result();
    snprintf(other.table, sizeof(other.table), "other");
    json_object_set_new(other.passport, "machine", json_pack("{ss}", "cpu", "Toy"));
    json_t *document = rg_result_json(&other);
    FILE *file = fopen("a.json", "a");
    json_dumpf(document, file, RG_JSON_FLAGS);
    assert_int_equal(fclose(file), 0);
    char *due = print_result(&other, RG_RESULT_TEX);
    asked_run("table other --from a.json --format tex");
    assert_string_equal(asked_printed, due);
    free(due);
    json_decref(document);
    rg_result_free(&other);
}

// An empty line stands between two tables, and none before the first.
static void tables_stand_apart(void **state)
{
    (void)state;
    store("a.json", 2, "Toy");
    char *one = printed_part(0, 0, NULL, NULL, RG_RESULT_CSV), *due = NULL;
    size_t size;
    FILE *out = open_memstream(&due, &size);
    fprintf(out, "%s\n%s", one, one);
    fclose(out);
    asked_run("table --from a.json --format csv");
    assert_string_equal(asked_printed, due);
    free(one);
    free(due);
}

static void what_is_not_there_is_refused(void **state)
{
    (void)state;
    static const char *const lines[] = {
        "table --from a.json --rows 5-9", "table ye-1 --from a.json",
        "table --from a.json --work queries", "table --from a.json --variant none"};
    store("a.json", 1, "Toy");
    for (int i = 0; i < 4; i++) {
        asked_expect(lines[i], "memory 0; ", RG_EXIT_USAGE);
        assert_string_equal(asked_printed, "");
        assert_string_equal(asked_logged,
                            "a.json: holds nothing of the tables, rows and works that are asked "
                            "for; without them `raingauge table --from` prints what it holds");
    }
    asked_expect("table --claims --from a.json", "memory 0; ", RG_EXIT_FAIL);
    asked_expect("claims --from a.json", "memory 0; ", RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "a.json: holds no table of these about which a paper claims "
                                      "something; name another folder");
    asked_expect("table --kept a.json --from a.json", "memory 0; ", RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "--kept: is about claims; add --claims, or leave it out");
}

static bool is_there(const char *path)
{
    struct stat found;
    return stat(path, &found) == 0;
}

// Tables of two machines are printed below their names, and are not written into one folder.
static void machines_stand_apart(void **state)
{
    (void)state;
    assert_int_equal(mkdir("in", 0777), 0);
    store("in/a.json", 1, "Toy");
    store("in/b.json", 1, "Other");
    asked_run("table --from in --format csv");
    assert_null(strstr(asked_printed, "# A"));
    asked_run("table --from in");
    assert_int_equal(strncmp(asked_printed, "# A: Toy, 0 cores, key ", 23), 0);
    const char *second = strstr(asked_printed, "\n# B: Other, 0 cores, key ");
    assert_non_null(second);
    assert_int_equal(second[-1], '\n');
    asked_run("table --from in --format tex");
    assert_int_equal(strncmp(asked_printed, "% A: Toy, 0 cores, key ", 23), 0);
    asked_run("table --from in -o in/out");
    assert_string_equal(asked_logged, "");
    assert_true(is_there("in/out") && !is_there("in/out/test-1.2.json"));
    asked_expect("table --from in -o in", "memory 0; ", RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "in: holds what --from reads, which would be replaced; name "
                                      "another folder with -o, or leave it out");
}

#define KEY "0123456789abcdef"

// Neither the folder of what is read is written into, nor a machine's folder in it: such folders
// have a key as their name.
static void what_is_read_is_not_replaced(void **state)
{
    (void)state;
    static const struct {
        const char *line, *folder; // that is spared; NULL: the result is written
    } rows[] = {
        {"table --from in -o in", "in"},          {"table --from in/a.json -o in", "in"},
        {"table --from in/a.json -o .", NULL},    {"table --from in -o in/" KEY, "in/" KEY},
        {"table --from in -o in/" KEY "0", NULL}, {"table --from in/a.json -o in/" KEY, NULL},
        {"table --from in -o out/" KEY, NULL},    {"table --from in -o out", NULL},
    };
    char due[256];
    assert_true(!mkdir("in", 0777) && !mkdir("out", 0777) && !mkdir("in/" KEY, 0777));
    assert_true(!mkdir("in/" KEY "0", 0777) && !mkdir("out/" KEY, 0777));
    store("in/a.json", 1, "Toy");
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const bool is_refused = asked_run(rows[i].line) == RG_EXIT_USAGE;
        snprintf(due, sizeof(due),
                 "%s: holds what --from reads, which would be replaced; name another folder with "
                 "-o, or leave it out",
                 rows[i].folder);
        if (is_refused != (rows[i].folder != NULL))
            fail_msg("%s: %s", rows[i].line, asked_logged);
        assert_string_equal(asked_logged, rows[i].folder ? due : "");
    }
}

// Of several machines each has its own folder, which may be the one that is read.
static void a_machine_s_folder_is_not_replaced(void **state)
{
    (void)state;
    char key[17] = "", folder[64], line[256];
    assert_true(!mkdir("in", 0777) && !mkdir("out", 0777));
    store("in/a.json", 1, "Toy");
    store("in/b.json", 1, "Other");
    asked_run("table --from in");
    assert_int_equal(sscanf(asked_printed, "# A: Toy, 0 cores, key %16[0-9a-f]", key), 1);
    snprintf(folder, sizeof(folder), "out/%s", key);
    assert_int_equal(rename("in", folder), 0);
    snprintf(line, sizeof(line), "table --from %s -o out", folder);
    asked_expect(line, "memory 0; ", RG_EXIT_USAGE);
    snprintf(line, sizeof(line),
             "%s: holds what --from reads, which would be replaced; name another folder with -o, "
             "or leave it out",
             folder);
    assert_string_equal(asked_logged, line);
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, asked_setup, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(parts_are_printed),
        ASKED(tables_are_chosen),
        ASKED(tables_stand_apart),
        ASKED(what_is_not_there_is_refused),
        ASKED(machines_stand_apart),
        ASKED(what_is_read_is_not_replaced),
        ASKED(a_machine_s_folder_is_not_replaced),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
