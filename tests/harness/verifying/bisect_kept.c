// The verdicts that a bisect keeps: whole ones come back, and all that is damaged, of another key
// or cannot be is begun anew, under a right checksum too.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/compare/bisect/kept.h"
#include "harness/compare/bisect/stamp.h"
#include "harness/record/disk/document.h"
#include "harness/record/disk/seal.h"
#include "harness/record/output.h"

enum { COUNT = 4 };

struct rig {
    char folder[64], file[96], path[1200], text[128]; // `text`: a candidate that names the file
    const char *names[COUNT];
    struct rg_candidates candidates;
    struct rg_judging judging;
    struct rg_judged judged[COUNT];
    int64_t order[COUNT];
    struct rg_bisect bisect;
    struct rg_bisect_kept kept;
};

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static int setup(void **state)
{
    struct rig *r = calloc(1, sizeof(*r));
    snprintf(r->folder, sizeof(r->folder), "/tmp/raingauge-test-XXXXXX");
    if (!mkdtemp(r->folder) || setenv("XDG_STATE_HOME", r->folder, 1))
        return -1;
    snprintf(r->file, sizeof(r->file), "%s/driver.json", r->folder);
    snprintf(r->text, sizeof(r->text), "vulkan@VK_DRIVER_FILES=%s", r->file);
    write_text(r->file, "{}");
    const char *const names[] = {"a", r->text, "c\xff", "d"};
    memcpy(r->names, names, sizeof(names));
    r->candidates = (struct rg_candidates){.count = COUNT, .names = r->names};
    r->judging = (struct rg_judging){.line = "test {}", .budget_s = 1.0 / 3, .tries = 3};
    r->bisect = (struct rg_bisect){.candidates = &r->candidates,
                                   .judging = &r->judging,
                                   .judged = r->judged,
                                   .order = r->order};
    rg_bisect_kept_find(&r->bisect, &r->kept);
    snprintf(r->path, sizeof(r->path), "%s/%s", r->kept.folder, r->kept.name);
    rg_log_hold(true);
    *state = r;
    return 0;
}

static int teardown(void **state)
{
    struct rig *r = *state;
    rg_log_hold(false);
    rg_bisect_kept_remove(&r->kept);
    unlink(r->file);
    rmdir(r->kept.folder);
    const int left = rmdir(r->folder);
    free(r);
    return left;
}

static void forget(struct rig *r)
{
    memset(r->judged, 0, sizeof(r->judged));
    r->bisect.order_count = 0;
}

// The three verdicts of an interrupted bisect.
static void keep(struct rig *r)
{
    static const struct rg_judged all[COUNT] = {{RG_JUDGED_GOOD, 0, 1, 0.25, 0},
                                                {RG_JUDGED_SKIP, 3, 3, 12.5, 0},
                                                {.verdict = RG_JUDGED_NONE},
                                                {RG_JUDGED_BAD, 1, 2, 1, 0}};
    static const int64_t order[] = {0, 3, 1};
    memcpy(r->judged, all, sizeof(all));
    memcpy(r->order, order, sizeof(order));
    r->bisect.order_count = 3;
    for (int i = 0; i < 3; i++)
        r->judged[order[i]].stamp = rg_candidate_stamp(r->names[order[i]]);
    assert_true(rg_bisect_kept_write(&r->kept, &r->bisect));
    forget(r);
}

static int64_t take(struct rig *r)
{
    forget(r);
    return rg_bisect_kept_take(&r->kept, &r->bisect);
}

static void verdicts_come_back(void **state)
{
    struct rig *r = *state;
    keep(r);
    assert_int_equal(take(r), 3);
    assert_int_equal(r->order[0], 0);
    assert_int_equal(r->order[1], 3);
    assert_int_equal(r->order[2], 1);
    assert_int_equal(r->judged[1].verdict, RG_JUDGED_SKIP);
    assert_int_equal(r->judged[1].status, 3);
    assert_int_equal(r->judged[1].tries, 3);
    assert_true(r->judged[1].seconds == 12.5);
    assert_int_equal(r->judged[2].verdict, RG_JUDGED_NONE);
    assert_int_equal(r->judged[3].verdict, RG_JUDGED_BAD);
}

// A candidate that was built anew is judged anew, and with the good end all are.
static void what_has_changed_is_judged_anew(void **state)
{
    struct rig *r = *state;
    keep(r);
    // Also where others are judged, and kept, after that.
    assert_int_equal(take(r), 3);
    write_text(r->file, "{ }");
    assert_true(rg_bisect_kept_write(&r->kept, &r->bisect));
    assert_int_equal(take(r), 2);
    assert_int_equal(r->judged[1].verdict, RG_JUDGED_NONE);
    assert_int_equal(r->judged[3].verdict, RG_JUDGED_BAD);
    r->names[0] = r->text;
    r->names[1] = "a";
    rg_bisect_kept_find(&r->bisect, &r->kept);
    keep(r);
    assert_int_equal(take(r), 3);
    write_text(r->file, "{  }");
    assert_int_equal(take(r), 0);
    assert_int_equal(r->judged[3].verdict, RG_JUDGED_NONE);
    rg_bisect_kept_remove(&r->kept);
    r->names[0] = "a";
    r->names[1] = r->text;
    rg_bisect_kept_find(&r->bisect, &r->kept);
}

static void a_folder_is_what_lies_in_it(void **state)
{
    struct rig *r = *state;
    const uint64_t before = rg_candidate_stamp(r->folder);
    assert_true(before != 0);
    assert_true(before == rg_candidate_stamp(r->folder));
    write_text(r->file, "{    }");
    assert_true(before != rg_candidate_stamp(r->folder));
    assert_int_equal(rg_candidate_stamp("HEAD~3"), 0);
}

// In whatever place of a candidate a file stands, it counts.
static void all_files_of_a_name_count(void **state)
{
    struct rig *r = *state;
    static const char *const forms[] = {"%s", "gl@A=%s", "gl@A=1;B=\"%s\"", "gl@A=/none.json:%s",
                                        "gl@A=%s:/none.json"};
    for (size_t i = 0; i < sizeof(forms) / sizeof(forms[0]); i++) {
        char name[256];
        const char *end = strstr(forms[i], "%s");
        snprintf(name, sizeof(name), "%.*s%s%s", (int)(end - forms[i]), forms[i], r->file, end + 2);
        write_text(r->file, "{}");
        const uint64_t before = rg_candidate_stamp(name);
        assert_true(before != 0);
        write_text(r->file, "{   }");
        assert_true(before != rg_candidate_stamp(name));
    }
}

// --- what is no record of this bisect ---

static json_t *load(const struct rig *r)
{
    char why[RG_WHY_SIZE];
    json_t *document = rg_document_read(r->path, "", why);
    assert_non_null(document);
    return document;
}

static void store(struct rig *r, json_t *document)
{
    assert_true(rg_seal(document));
    char *text = json_dumps(document, RG_JSON_FLAGS);
    assert_true(rg_output_write(r->kept.folder, r->kept.name, text));
    free(text);
    json_decref(document);
}

// Each field of the key, changed under a right checksum.
static void other_keys_are_begun_anew(void **state)
{
    struct rig *r = *state;
    keep(r);
    json_t *whole = load(r), *value;
    const char *field;
    int fields = 0;
    json_object_foreach(json_object_get(whole, "key"), field, value)
    {
        json_t *document = json_deep_copy(whole);
        json_object_set_new(json_object_get(document, "key"), field, json_string("other"));
        store(r, document);
        assert_int_equal(take(r), 0);
        fields++;
    }
    assert_int_equal(fields, 7);
    json_t *format = json_deep_copy(whole);
    json_object_set_new(format, "format", json_integer(99));
    store(r, format);
    assert_int_equal(take(r), 0);
    store(r, whole);
    assert_int_equal(take(r), 3);
}

// A verdict that cannot be, under a right checksum, and none of those beside it either.
static void impossible_verdicts_are_begun_anew(void **state)
{
    struct rig *r = *state;
    static const struct {
        const char *field;
        double number;
        const char *text; // NULL: the number
    } wrong[] = {
        {"at", -1, NULL},     {"at", 4, NULL},        {"at", 3, NULL},      {"verdict", 0, "bad"},
        {"verdict", 0, "no"}, {"verdict", 0, "stop"}, {"verdict", 7, NULL}, {"status", 1, NULL},
        {"status", -1, NULL}, {"status", 256, NULL},  {"tries", 0, NULL},   {"tries", 4, NULL},
        {"stamp", 0, NULL},   {"seconds", 0, "1"},
    };
    keep(r);
    json_t *whole = load(r);
    for (size_t i = 0; i < sizeof(wrong) / sizeof(*wrong); i++) {
        json_t *document = json_deep_copy(whole);
        json_t *verdict = json_array_get(json_object_get(document, "verdicts"), 2);
        json_object_set_new(verdict, wrong[i].field,
                            wrong[i].text ? json_string(wrong[i].text)
                                          : json_integer((json_int_t)wrong[i].number));
        store(r, document);
        assert_int_equal(take(r), 0);
    }
    json_t *document = json_deep_copy(whole);
    json_object_set_new(json_array_get(json_object_get(document, "verdicts"), 2), "seconds",
                        json_real(-0.5));
    store(r, document);
    assert_int_equal(take(r), 0);
    json_decref(whole);
}

// What stands in the file, changed by hand, cut, or without its checksum.
static void damaged_files_are_begun_anew(void **state)
{
    struct rig *r = *state;
    char why[RG_WHY_SIZE];
    size_t size;
    keep(r);
    char *text = rg_document_load(r->path, &size, "", why);
    assert_non_null(text);
    for (size_t i = 0; i < 16; i++) {
        char *cut = strndup(text, size * i / 16);
        write_text(r->path, cut);
        assert_int_equal(take(r), 0);
        free(cut);
    }
    char *status = strstr(text, "\"status\":3");
    assert_non_null(status);
    status[9] = '4'; // skips as well
    write_text(r->path, text);
    assert_int_equal(take(r), 0);
    status[9] = '3';
    char *twice = malloc(2 * size + 1);
    memcpy(twice, text, size);
    memcpy(twice + size, text, size + 1);
    write_text(r->path, twice);
    assert_int_equal(take(r), 0);
    free(twice);
    write_text(r->path, text);
    json_t *bare = load(r);
    char *plain = json_dumps(bare, RG_JSON_FLAGS);
    write_text(r->path, plain);
    assert_int_equal(take(r), 0);
    write_text(r->path, text);
    assert_int_equal(take(r), 3);
    free(plain);
    free(text);
    json_decref(bare);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(verdicts_come_back, setup, teardown),
        cmocka_unit_test_setup_teardown(what_has_changed_is_judged_anew, setup, teardown),
        cmocka_unit_test_setup_teardown(a_folder_is_what_lies_in_it, setup, teardown),
        cmocka_unit_test_setup_teardown(all_files_of_a_name_count, setup, teardown),
        cmocka_unit_test_setup_teardown(other_keys_are_begun_anew, setup, teardown),
        cmocka_unit_test_setup_teardown(impossible_verdicts_are_begun_anew, setup, teardown),
        cmocka_unit_test_setup_teardown(damaged_files_are_begun_anew, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
