// What a command does in shards: how a whole is cut, and the records from which it is put together.
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
#include "harness/record/disk/document.h"
#include "harness/record/disk/parts.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

// --- shards ---

// The largest goes first, each to the shard with the least so far; of equal ones the first.
static void a_whole_is_cut_evenly(void **state)
{
    (void)state;
    static const struct {
        int count, shards;
        double seconds[6];
        int shard_of[6];
        double longest_s;
    } rows[] = {{5, 2, {1, 5, 2, 4, 3}, {1, 1, 1, 2, 2}, 8},
                {6, 3, {7, 7, 7, 7, 7, 7}, {1, 2, 3, 1, 2, 3}, 14},
                {2, 4, {1, 2}, {2, 1}, 2},
                {3, 1, {1, 2, 3}, {1, 1, 1}, 6},
                {3, 3, {0.5, 9, 0.25}, {2, 1, 3}, 9},
                {0, 2, {0}, {0}, 0}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        int shard_of[6] = {0};
        double longest_s = -1;
        assert_true(
            rg_shard_cut(rows[i].seconds, rows[i].count, rows[i].shards, shard_of, &longest_s));
        assert_memory_equal(shard_of, rows[i].shard_of, sizeof(shard_of));
        assert_equals(longest_s, rows[i].longest_s);
        assert_true(rg_shard_cut(rows[i].seconds, rows[i].count, rows[i].shards, shard_of, NULL));
    }
}

static void numbers_are_written_as_slurm_takes_them(void **state)
{
    (void)state;
    static const struct {
        const char *has, *text;
    } rows[] = {{"", ""},
                {"000", ""},
                {"1", "1"},
                {"010", "2"},
                {"011", "2-3"},
                {"111", "1-3"},
                {"101", "1,3"},
                {"1101", "1-2,4"},
                {"01001110", "2,5-7"},
                {"0000000001", "10"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const int count = (int)strlen(rows[i].has);
        bool has[16];
        char text[16 * RG_SHARD_NUMBER] = "unset";
        for (int k = 0; k < count; k++)
            has[k] = rows[i].has[k] == '1';
        rg_shard_array(has, count, text, sizeof(text));
        assert_string_equal(text, rows[i].text);
    }
}

// --- records ---

static char told[4096];
static int errors, warnings, notes;

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    errors += level == RG_LOG_ERROR;
    warnings += level == RG_LOG_WARNING;
    notes += level == RG_LOG_INFO;
    snprintf(told, sizeof(told), "%s", line);
}

static int make(void **state)
{
    rg_log_listen(hear, NULL);
    errors = warnings = notes = 0;
    return make_folder(state);
}

static int clear(void **state)
{
    rg_log_listen(NULL, NULL);
    return remove_whole_folder(state);
}

static const char *path_of(const char *name)
{
    static char path[512];
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    return path;
}

// Writes the record of a shard into a folder in the test's.
static void write_part(const char *inner, int number, int count, const char *whole,
                       const char *note)
{
    json_t *document = json_pack("{si ss}", "format", 1, "note", note);
    json_t *of = json_pack("{ss ss}", "cells", whole, "margin", "5");
    mkdir(path_of(inner), 0777);
    assert_true(
        rg_part_write("gate", (struct rg_shard){number, count}, document, of, path_of(inner)));
}

static void write_text(const char *name, const char *text)
{
    FILE *file = fopen(path_of(name), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

// The shards that are missing after reading, as text; "" if none is.
static const char *lacking(const char *path, struct rg_parts *parts)
{
    static char text[256];
    *parts = (struct rg_parts){0};
    assert_true(rg_parts_read(parts, "gate", path));
    char *found = rg_parts_lacking(parts);
    snprintf(text, sizeof(text), "%s", found);
    free(found);
    return text;
}

static const char *note_of(const struct rg_parts *parts, int shard)
{
    const char *note = json_string_value(json_object_get(parts->documents[shard - 1], "note"));
    return note ? note : "none";
}

// A record lies in the folder or in one of it, sealed, and has its number, count and whole.
static void records_make_a_whole(void **state)
{
    (void)state;
    struct rg_parts parts;
    write_part("", 2, 4, "all", "second");
    write_part("job", 4, 4, "all", "fourth");
    write_part("job", 3, 4, "all", "third");
    assert_string_equal(lacking(folder, &parts), "1");
    assert_true(parts.count == 4 && parts.missing == 1 && !parts.documents[0]);
    assert_string_equal(note_of(&parts, 2), "second");
    assert_string_equal(note_of(&parts, 3), "third");
    assert_string_equal(note_of(&parts, 4), "fourth");
    assert_string_equal(json_string_value(json_object_get(parts.of, "cells")), "all");
    const json_t *shard = json_object_get(parts.documents[2], "shard");
    assert_int_equal(json_integer_value(json_object_get(shard, "number")), 3);
    assert_int_equal(json_integer_value(json_object_get(shard, "count")), 4);
    rg_parts_free(&parts);
    assert_true(!parts.count && !parts.documents);
    assert_string_equal(lacking(path_of("job/gate-4-of-4.json"), &parts), "1-3");
    assert_int_equal(parts.missing, 3);
    rg_parts_free(&parts);
    write_part("", 1, 4, "all", "first");
    assert_string_equal(lacking(folder, &parts), "");
    assert_int_equal(parts.missing, 0);
    rg_parts_free(&parts);
    assert_int_equal(errors + warnings + notes, 0);
}

// Names of other kinds, of copies under way and folders further inside are none of a shard's.
static void other_files_are_left_alone(void **state)
{
    (void)state;
    static const char *const names[] = {
        "verify-1-of-2.json", "gates-1-of-2.json", "gate-1-of-2.json.Xy12Z",
        "gate-1-of-2.jso",    ".gate-1-of-2.json", "gate-one-of-2.json",
        "gate-1-of-2",        "xgate-1-of-2.json"};
    struct rg_parts parts;
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
        write_text(names[i], "no record");
    write_part("job", 1, 2, "all", "first");
    write_part(".hidden", 2, 2, "all", "hidden");
    assert_int_equal(mkdir(path_of("job/inner"), 0777), 0);
    write_part("job/inner", 2, 2, "all", "too deep");
    assert_string_equal(lacking(folder, &parts), "2");
    assert_int_equal(errors + warnings + notes, 0);
    rg_parts_free(&parts);
    struct rg_parts none = {0};
    assert_true(rg_parts_read(&none, "verdict", folder));
    assert_true(!none.count && !none.missing && !none.documents && !none.of);
}

// The first record of a number is taken, and a damaged one counts as missing, each with a line.
static void damaged_records_count_as_missing(void **state)
{
    (void)state;
    struct rg_parts parts;
    write_part("a", 1, 3, "all", "first");
    write_part("b", 1, 3, "all", "again");
    assert_string_equal(lacking(folder, &parts), "2-3");
    assert_string_equal(note_of(&parts, 1), "first");
    assert_true(notes == 1 && !errors && !warnings);
    assert_non_null(strstr(told, "b/gate-1-of-3.json: shard 1 is there twice"));
    rg_parts_free(&parts);
    static const struct {
        const char *text, *says;
    } rows[] = {{"{\"format\": 1, \"shard\": {\"number\": 2", "is no JSON"},
                {"{\"format\": 1, \"shard\": {\"number\": 2, \"count\": 3, \"of\": {}}}",
                 "has no checksum"},
                {"{\"format\": 1, \"checksum\": \"0123456789abcdef\"}", "its checksum is wrong"},
                {"{\"format\": 1} {}", "has more after its end; run its shard again"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        warnings = 0;
        write_text("gate-2-of-3.json", rows[i].text);
        assert_string_equal(lacking(folder, &parts), "2-3");
        assert_int_equal(warnings, 1);
        if (!strstr(told, rows[i].says))
            fail_msg("'%s' instead of '%s'", told, rows[i].says);
        rg_parts_free(&parts);
    }
    assert_int_equal(errors, 0);
}

static void refuse(const char *path, const char *says)
{
    struct rg_parts parts = {0};
    errors = 0;
    assert_false(rg_parts_read(&parts, "gate", path));
    if (!strstr(told, says))
        fail_msg("'%s' instead of '%s'", told, says);
    assert_int_equal(errors, 1);
    rg_parts_free(&parts);
}

// Records of two wholes, or of another format, end the reading by the name of what differs.
static void records_of_two_wholes_are_refused(void **state)
{
    (void)state;
    write_part("a", 1, 3, "all", "first");
    write_part("b", 2, 3, "others", "second");
    refuse(folder, "b/gate-2-of-3.json: its cells is not that of ");
    assert_non_null(strstr(told, "a/gate-1-of-3.json; name the records of one gate, "));
    assert_int_equal(unlink(path_of("b/gate-2-of-3.json")), 0);
    write_part("b", 2, 4, "all", "second");
    refuse(folder, "b/gate-2-of-4.json: its number of shards is not that of ");
    json_t *document = json_pack("{si}", "format", 1);
    json_t *of = json_pack("{ss ss ss}", "cells", "all", "margin", "5", "strict", "yes");
    assert_true(rg_part_write("gate", (struct rg_shard){2, 3}, document, of, path_of("a")));
    refuse(folder, "a/gate-2-of-3.json: its strict is not that of ");
    assert_int_equal(unlink(path_of("a/gate-2-of-3.json")), 0);
    document = json_pack("{si}", "format", 1);
    of = json_pack("{ss}", "cells", "all");
    assert_true(rg_part_write("gate", (struct rg_shard){3, 3}, document, of, path_of("a")));
    refuse(folder, "a/gate-3-of-3.json: its margin is not that of ");
    write_text("new.json", "{\"format\": 2}");
    refuse(path_of("new.json"), "new.json: format is 2, and this raingauge reads 1; ");
    refuse(path_of("none"), "none: No such file or directory; name a folder of records");
    document = json_pack("{si}", "format", 1);
    assert_true(rg_part_write("gate", (struct rg_shard){5, 4}, document, json_object(), folder));
    refuse(path_of("gate-5-of-4.json"), "is no record of a shard; name what `raingauge gate ");
    assert_false(rg_part_write("gate", (struct rg_shard){1, 1}, json_object(), json_object(),
                               path_of("none/inner")));
}

static void expect_texts(const struct rg_parts *parts, bool by_lines, const char *due)
{
    char *text = rg_parts_texts(parts, "note", by_lines);
    assert_string_equal(text, due);
    free(text);
}

// Texts, or their lines, come once each, and no part of a line is taken for one.
static void texts_are_told_once(void **state)
{
    (void)state;
    static const char *const notes_of[] = {
        "cpu: a\ngl: b\n", NULL, "gl: b\nvulkan\x1b: c\n", "gl", "cpu: a\ngl: b\n", "b\n\ncpu: a"};
    enum { COUNT = sizeof(notes_of) / sizeof(notes_of[0]) };
    json_t *documents[COUNT];
    const struct rg_parts parts = {.count = COUNT, .documents = documents};
    for (int i = 0; i < COUNT; i++)
        documents[i] = notes_of[i] ? json_pack("{ss}", "note", notes_of[i]) : NULL;
    expect_texts(&parts, true, "cpu: a\ngl: b\nvulkan?: c\ngl\nb\n");
    expect_texts(&parts, false, "cpu: a\ngl: b\n\ngl: b\nvulkan\x1b: c\n\ngl\nb\n\ncpu: a\n");
    for (int i = 0; i < COUNT; i++)
        json_decref(documents[i]);
    const struct rg_parts none = {0};
    expect_texts(&none, true, "");
}

// --- documents ---

// A line of refusal names the file, the place and the mend; stored documents need a checksum.
static void documents_are_whole(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says;
    } rows[] = {{"{\"a\": 1}", "has no checksum: it is another version's"},
                {"{\"a\": 1, \"checksum\": 5}", "its checksum is wrong: it was changed or cut"},
                {"", "line 1 is no JSON: "},
                {"{\"a\": 1,\n\"a\": 2}", "line 2 is no JSON: "}};
    char why[RG_WHY_SIZE];
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        write_text("a.json", rows[i].text);
        assert_null(rg_document_read(path_of("a.json"), "mend it", why));
        assert_non_null(strstr(why, "/a.json: "));
        if (!strstr(why, rows[i].says))
            fail_msg("'%s' instead of '%s'", why, rows[i].says);
        assert_true(i < 2 || strstr(why, "; mend it"));
    }
    assert_null(rg_document_read(path_of("none.json"), "mend it", why));
    assert_non_null(strstr(why, "none.json: cannot be read: No such file or directory; mend it"));
    json_t *document = json_pack("{si}", "a", 1);
    assert_true(rg_document_unseal("a.json", document, false, why)); // printed ones have none
    assert_false(rg_document_unseal("a.json", document, true, why));
    json_object_set_new(document, "checksum", json_string("0"));
    assert_false(rg_document_unseal("a.json", document, false, why));
    json_decref(document);
}

#define IN_A_FOLDER(test) cmocka_unit_test_setup_teardown(test, make, clear)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_whole_is_cut_evenly),
        cmocka_unit_test(numbers_are_written_as_slurm_takes_them),
        IN_A_FOLDER(records_make_a_whole),
        IN_A_FOLDER(other_files_are_left_alone),
        IN_A_FOLDER(damaged_records_count_as_missing),
        IN_A_FOLDER(records_of_two_wholes_are_refused),
        cmocka_unit_test(texts_are_told_once),
        IN_A_FOLDER(documents_are_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
