// Records that become a page: those that are taken from files and folders, those that are refused,
// and the data of the page that is written.
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
#include "harness/record/output.h"
#include "harness/record/passport/build_info.h"
#include "harness/record/schema/schema.h"
#include "harness/report/page.h"
#include "tests/harness/record/made.h"

// --- stand-ins ---

static char seen[2048], logged[1024];
static bool has_pictures; // false: they have no room

static void see(const char *format, const char *first, const char *second)
{
    const size_t used = strlen(seen);
    snprintf(seen + used, sizeof(seen) - used, format, first, second);
}

bool rg_page_add_pictures(struct rg_page *page, const char *folder, const json_t *document)
{
    (void)page;
    assert_true(json_is_object(document));
    see("pictures of %s%s; ", folder, "");
    return has_pictures || rg_error("no room");
}

bool rg_page_add_gallery(struct rg_page *page, const char *folder, const char *markdown)
{
    (void)page;
    see("gallery of %s: %s; ", folder, markdown);
    return has_pictures || rg_error("no room");
}

static char *written, *written_to;

bool rg_output_write_file(const char *path, const char *text)
{
    written_to = strdup(path);
    written = strdup(text);
    return has_pictures || rg_error("%s: is full", path);
}

// --- the tests' own ---

static char folder[64];

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    snprintf(logged, sizeof(logged), "%s", line);
}

static int begin(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/raingauge-records-XXXXXX");
    *seen = *logged = 0;
    has_pictures = true;
    rg_log_listen(hear, NULL);
    return mkdtemp(folder) ? chdir(folder) : -1;
}

static int end(void **state)
{
    (void)state;
    char command[128];
    rg_log_listen(NULL, NULL);
    snprintf(command, sizeof(command), "rm -r %s", folder);
    return chdir("/") || system(command);
}

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void expect_json(const json_t *found, const char *due)
{
    char *text = json_dumps(found, JSON_COMPACT | JSON_ENCODE_ANY);
    assert_non_null(text);
    assert_string_equal(text, due);
    free(text);
}

// The files of a page's records, with their kinds.
static void expect_records(const struct rg_page *page, const char *due)
{
    char text[2048] = "";
    size_t i;
    json_t *record;
    json_array_foreach(page->records, i, record)
    {
        const size_t used = strlen(text);
        snprintf(text + used, sizeof(text) - used, "%s %s; ",
                 json_string_value(json_object_get(record, "kind")),
                 json_string_value(json_object_get(record, "file")));
    }
    assert_string_equal(text, due);
}

#define MEND "name what a command wrote with --json or -o (docs/records.md)"

// --- records ---

static void each_kind_is_known_by_a_field(void **state)
{
    (void)state;
    static const char *const kinds[][2] = {
        {"claims", "\"claims\":[]"},      {"gate", "\"gated\":[]"},
        {"baseline", "\"baseline\":[]"},  {"verify", "\"checks\":[]"},
        {"diff", "\"pairs\":[]"},         {"doctor", "\"warnings\":[]"},
        {"render", "\"file\":\"a.png\""}, {"bisect", "\"candidates\":3"},
        {"table", "\"cells\":[]"}};
    for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]); i++) {
        struct rg_page page = {0};
        char text[128], due[256];
        snprintf(text, sizeof(text), "{\"format\":1,%s}", kinds[i][1]);
        assert_true(rg_page_add_text(&page, "there/a.json", text));
        snprintf(due, sizeof(due), "[{\"kind\":\"%s\",\"file\":\"there/a.json\",\"document\":%s}]",
                 kinds[i][0], text);
        expect_json(page.records, due);
        rg_page_free(&page);
        assert_true(!page.records && !page.gates);
    }
    assert_string_equal(seen,
                        "pictures of there/; pictures of there/; pictures of there/; pictures "
                        "of there/; pictures of there/; pictures of there/; pictures of "
                        "there/; pictures of there/; pictures of there/; ");
}

static void what_is_no_record_is_refused(void **state)
{
    (void)state;
    static const char *const rows[][2] = {
        {"{\"gated\":[]}", "a.json: is no record of raingauge; " MEND},
        {"{\"format\":\"1\",\"gated\":[]}", "a.json: is no record of raingauge; " MEND},
        {"{\"format\":1,\"gated\":{}}", "a.json: is no record of raingauge; " MEND},
        {"{\"format\":1,\"checks\":[],\"shard\":{}}",
         "a.json: is the record of a shard; name what `raingauge verify --from --json` makes of "
         "all "
         "of them"},
        {"{\"format\":2,\"gated\":[]}",
         "a.json: is of format 2, and this raingauge knows format 1; use the raingauge that wrote "
         "it, or a newer one"},
        {"{\"format\":", "a.json: line 1 is no JSON: unexpected token near end of file; " MEND}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_page page = {0};
        assert_false(rg_page_add_text(&page, "a.json", rows[i][0]));
        assert_string_equal(logged, rows[i][1]);
        write_file("a.json", rows[i][0]);
        *logged = 0;
        assert_false(rg_page_add(&page, "a.json"));
        assert_string_equal(logged, rows[i][1]);
        assert_null(page.records);
        rg_page_free(&page);
    }
    assert_string_equal(seen, "");
    struct rg_page page = {0};
    has_pictures = false;
    assert_false(rg_page_add_text(&page, "a.json", "{\"format\":1,\"gated\":[]}"));
    assert_string_equal(logged, "no room");
    assert_string_equal(seen, "pictures of .; ");
    assert_null(page.records);
}

// Gates beyond the thirtieth push out the first ones, and no other record.
static void the_last_gates_are_kept(void **state)
{
    (void)state;
    struct rg_page page = {0};
    char text[64];
    assert_true(rg_page_add_text(&page, "a", "{\"format\":1,\"pairs\":[]}"));
    for (int i = 0; i < RG_PAGE_GATES + 2; i++) {
        assert_int_equal(page.gates_left_out, 0 + (i > RG_PAGE_GATES));
        snprintf(text, sizeof(text), "{\"format\":1,\"gated\":[],\"number\":%d}", i);
        assert_true(rg_page_add_text(&page, "b", text));
    }
    assert_int_equal(page.gates_left_out, 2);
    assert_int_equal(json_array_size(page.records), RG_PAGE_GATES + 1);
    expect_json(json_array_get(page.records, 0),
                "{\"kind\":\"diff\",\"file\":\"a\",\"document\":{\"format\":1,\"pairs\":[]}}");
    for (int i = 0; i < RG_PAGE_GATES; i++) {
        const json_t *record = json_array_get(page.records, (size_t)i + 1);
        const json_t *number = json_object_get(json_object_get(record, "document"), "number");
        assert_int_equal(json_integer_value(number), i + 2);
    }
    rg_page_free(&page);
}

// --- files and folders ---

#define GATE "{\"format\":1,\"gated\":[]}"
#define DIFF "{\"format\":1,\"pairs\":[]}"
#define KEY  "0123456789abcdef"

static void make_files(void)
{
    assert_true(!mkdir("in", 0777) && !mkdir("in/" KEY, 0777) && !mkdir("in/" KEY "/" KEY, 0777));
    assert_true(!mkdir("in/other", 0777) && !mkdir("empty", 0777));
    write_file("in/b.json", GATE "\n" DIFF "\n\n");
    write_file("in/a.json", " \n" DIFF);
    write_file("in/c.txt", "no record");
    write_file("in/figures.md", "# figures");
    write_file("in/more.md", "# more");
    write_file("in/.json", "no record");
    write_file("in/other/d.json", GATE);
    write_file("in/" KEY "/e.json", GATE);
    write_file("in/" KEY "/" KEY "/f.json", GATE);
}

// A folder's records and those of its machines come in the order of their names. Of texts only
// figures.md is taken, unless a text is named.
static void folders_hold_records(void **state)
{
    (void)state;
    static const char due[] = "gate in/" KEY "/e.json; diff in/a.json; gate in/b.json; diff "
                              "in/b.json; ";
    struct rg_page page = {0};
    make_files();
    assert_true(rg_page_add(&page, "in"));
    expect_records(&page, due);
    assert_string_equal(seen, "pictures of in/" KEY "/; pictures of in/; pictures of in/; pictures "
                              "of in/; gallery of in/: # figures; ");
    *seen = 0;
    assert_true(rg_page_add(&page, "in/more.md"));
    assert_string_equal(seen, "gallery of in/: # more; ");
    assert_int_equal(page.gates, 2);
    rg_page_free(&page);
    assert_true(rg_page_add(&page, "in/other/d.json"));
    expect_records(&page, "gate in/other/d.json; ");
    rg_page_free(&page);
    assert_string_equal(logged, "");
}

static void folders_without_records_are_refused(void **state)
{
    (void)state;
    static const char *const rows[][2] = {
        {"empty", "empty: holds no .json and no figures.md; " MEND},
        {"in/" KEY "/" KEY, ""},
        {"none", "none: cannot be read: No such file or directory; " MEND},
        {"none.md", "none.md: cannot be read: No such file or directory; name a text that can be "
                    "read"},
        {"in/c.txt", "in/c.txt: line 1 is no JSON: '[' or '{' expected near 'no'; " MEND},
        {"bad", "bad/b.json: line 2 is no JSON: '}' expected near end of file; " MEND}};
    make_files();
    assert_int_equal(mkdir("bad", 0777), 0);
    write_file("bad/a.json", DIFF);
    write_file("bad/b.json", GATE "\n{\"a\":1");
    write_file("bad/c.json", DIFF);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_page page = {0};
        *logged = 0;
        assert_int_equal(rg_page_add(&page, rows[i][0]), !*rows[i][1]);
        assert_string_equal(logged, rows[i][1]);
        if (i == 5)
            expect_records(&page, "diff bad/a.json; gate bad/b.json; ");
        rg_page_free(&page);
    }
    has_pictures = false;
    struct rg_page page = {0};
    assert_false(rg_page_add(&page, "in/more.md"));
    assert_string_equal(logged, "no room");
    rg_page_free(&page);
}

// --- tables ---

static void store(const char *path, const char *cpu, bool full)
{
    struct rg_result made = make_result();
    made.full = full;
    json_object_set_new(made.passport, "machine", json_pack("{ss}", "cpu", cpu));
    json_t *document = rg_result_json(&made);
    char *text = json_dumps(document, RG_JSON_FLAGS);
    write_file(path, text);
    free(text);
    json_decref(document);
    rg_result_free(&made);
}

// A table is taken once of each machine, and at one length.
static void tables_are_taken_once(void **state)
{
    (void)state;
    struct rg_page page = {0};
    store("a.json", "First", true);
    store("b.json", "Second", true);
    store("c.json", "Third", false);
    assert_true(rg_page_add(&page, "a.json") && rg_page_add(&page, "b.json"));
    assert_false(rg_page_add(&page, "a.json"));
    assert_string_equal(logged, "a.json: holds table 'test-1.2', which a.json holds too; name one "
                                "of them");
    assert_false(rg_page_add(&page, "b.json"));
    assert_string_equal(logged, "b.json: holds table 'test-1.2', which b.json holds too; name one "
                                "of them");
    assert_false(rg_page_add(&page, "c.json"));
    assert_string_equal(logged, "c.json: holds table 'test-1.2' measured quick, and a.json does "
                                "not; name one of them");
    expect_records(&page, "table a.json; table b.json; ");
    for (size_t i = 0; i < 2; i++) {
        const json_t *record = json_array_get(page.records, i);
        assert_int_equal(json_object_size(record), 4); // the table is no paper's
        assert_string_equal(json_string_value(json_object_get(record, "machine")), i ? "B" : "A");
        const json_t *document = json_object_get(record, "document");
        size_t k;
        json_t *cell;
        json_array_foreach(json_object_get(document, "cells"), k, cell)
        {
            const json_t *measured = json_object_get(cell, "measured");
            assert_null(json_object_get(cell, "checksum"));
            assert_null(json_object_get(measured, "samples_ms"));
            assert_null(json_object_get(measured, "taken"));
            assert_null(json_object_get(measured, "passes_share"));
            assert_true(!measured || json_is_number(json_object_get(measured, "create_ms")));
        }
        assert_int_equal(k, 16);
    }
    rg_page_free(&page);
    assert_int_equal(page.outcomes.origins.count, 0);
}

// --- the page ---

#define ENDINGS                                                                                    \
    "\"endings\":[{\"name\":\"crash\",\"fails\":true},{\"name\":\"timeout\",\"fails\":true},"
#define RULES                                                                                      \
    "\"rules\":{\"looks\":[12,24,48,96],\"fall\":1.05,\"reversal\":1.1},\"machines\":[],"          \
    "\"claims\":"                                                                                  \
    "null,"

// The data in a page that is written. The caller frees it.
static char *data_of(const struct rg_page *page, const struct rg_page *before)
{
    static const char start[] = "<script type=\"application/json\" id=\"data\">",
                      end[] = "</script>";
    assert_true(rg_page_write(page, before, "page.html"));
    assert_string_equal(written_to, "page.html");
    const char *from = strstr(written, start), *to = from ? strstr(from, end) : NULL;
    assert_true(from && to);
    assert_true(!strncmp(written, "<!doctype html>", 15) && strstr(to, "</html>"));
    char *text = strndup(from + strlen(start), (size_t)(to - from) - strlen(start));
    free(written);
    free(written_to);
    return text;
}

static void expect_part(const char *text, const char *due)
{
    if (!strstr(text, due))
        fail_msg("no '%s' in: %s", due, text);
}

static void a_page_has_all_data(void **state)
{
    (void)state;
    struct rg_page page = {.left_out = 3, .gates_left_out = 4}, before = {0};
    char due[512];
    char *text = data_of(&page, NULL);
    snprintf(due, sizeof(due),
             "{\"format\":1,\"version\":\"%s\",\"commit\":\"%s\",\"pictures_left_out\":3,"
             "\"gates_left_out\":4," ENDINGS,
             rg_build_version, rg_build_commit);
    assert_memory_equal(text, due, strlen(due));
    expect_part(text, "{\"name\":\"pass\",\"fails\":false}]," RULES
                      "\"before\":null,\"records\":[],\"pictures\":{},\"files\":{},\"linear\":{},"
                      "\"gallery\":[]}");
    json_t *data = json_loads(text, 0, NULL);
    assert_int_equal(json_array_size(json_object_get(data, "endings")), 16);
    json_decref(data);
    free(text);
    assert_true(rg_page_add_text(&page, "</script>", DIFF));
    assert_true(rg_page_add_text(&before, "b", GATE));
    page.pictures = json_pack("{ss}", "p", "1");
    page.files = json_pack("{ss}", "f", "2");
    page.linear = json_pack("{ss}", "l", "3");
    page.gallery = json_pack("[s]", "g");
    text = data_of(&page, &before);
    expect_part(text,
                "\"before\":{\"machines\":[],\"claims\":null,\"records\":[{\"kind\":\"gate\","
                "\"file\":\"b\",\"document\":" GATE "}]},\"records\":[{\"kind\":\"diff\",\"file\":"
                "\"\\u003c/script>\",\"document\":" DIFF "}],\"pictures\":{\"p\":\"1\"},\"files\":"
                "{\"f\":\"2\"},\"linear\":{\"l\":\"3\"},\"gallery\":[\"g\"]}");
    free(text);
    has_pictures = false;
    assert_false(rg_page_write(&page, NULL, "page.html"));
    assert_string_equal(logged, "page.html: is full");
    free(written);
    free(written_to);
    rg_page_free(&page);
    rg_page_free(&before);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, begin, end)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(each_kind_is_known_by_a_field),
        IN_FOLDER(what_is_no_record_is_refused),
        IN_FOLDER(the_last_gates_are_kept),
        IN_FOLDER(folders_hold_records),
        IN_FOLDER(folders_without_records_are_refused),
        IN_FOLDER(tables_are_taken_once),
        IN_FOLDER(a_page_has_all_data),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
