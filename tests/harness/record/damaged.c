// Documents with unforeseen damage are refused in one line, or taken and printed, and do no harm.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/record/schema/schema.h"
#include "harness/tables/print.h"
#include "tests/harness/record/made.h"
#include "tests/tools/expect.h"

// Prints a document that is taken, and writes it as it was read. One that is not taken is refused
// in one line that begins with the file.
static bool try_document(const json_t *document)
{
    char why[RG_WHY_SIZE];
    struct rg_result result = {0};
    if (!rg_result_from_json(document, "some/file.json", &result, why)) {
        if (strncmp(why, "some/file.json: ", 16) != 0 || strchr(why, '\n') || !strstr(why, "; "))
            fail_msg("refused with: %s", why);
        return false;
    }
    struct rg_result again = {0};
    json_t *written = rg_result_json(&result);
    assert_true(rg_result_from_json(written, "again", &again, why));
    assert_prints_same(&result, &again);
    json_decref(written);
    rg_result_free(&again);
    rg_result_free(&result);
    return true;
}

static json_t *make_document(void)
{
    struct rg_result made = make_result();
    json_t *document = rg_result_json(&made);
    rg_result_free(&made);
    return document;
}

static json_t *other_value(int kind)
{
    static char long_text[4096];
    memset(long_text, 'x', sizeof(long_text) - 1);
    switch (kind) {
    case 0:
        return json_null();
    case 1:
        return json_true();
    case 2:
        return json_integer(-1);
    case 3:
        return json_integer(INT64_MAX);
    case 4:
        return json_real(1e300);
    case 5:
        return json_string("");
    case 6:
        return json_string(long_text);
    case 7:
        return json_array();
    default:
        return json_object();
    }
}
enum { KINDS = 9 };

struct found {
    int refused, taken;
    char unread[1024], optional[1024]; // names of fields, each with a space before and after
};

static void add_name(char list[1024], const char *name)
{
    char word[80];
    snprintf(word, sizeof(word), " %s ", name);
    if (!strstr(list, word))
        strncat(list, *list ? word + 1 : word, 1024 - strlen(list) - 1);
}

// Puts every kind of value in the place of each field and element, one at a time, and leaves each
// field out. The first element of a list stands for all.
static void vary(const json_t *document, json_t *at, struct found *found)
{
    const char *key;
    json_t *value;
    const size_t size = json_is_array(at) ? json_array_size(at) : 0;
    for (size_t i = 0; i < size; i += size) {
        json_t *kept = json_incref(json_array_get(at, i));
        for (int kind = 0; kind < KINDS; kind++) {
            json_array_set_new(at, i, other_value(kind));
            ++*(try_document(document) ? &found->taken : &found->refused);
        }
        json_array_set(at, i, kept);
        vary(document, kept, found);
        json_decref(kept);
    }
    json_t *fields = json_is_object(at) ? json_copy(at) : NULL;
    json_object_foreach(fields, key, value)
    {
        int refused = 0;
        for (int kind = 0; kind < KINDS; kind++) {
            json_object_set_new(at, key, other_value(kind));
            refused += !try_document(document);
        }
        found->refused += refused;
        found->taken += KINDS - refused;
        json_object_del(at, key);
        if (!refused)
            add_name(found->unread, key);
        else if (try_document(document))
            add_name(found->optional, key);
        json_object_set(at, key, value);
        vary(document, value, found);
    }
    json_decref(fields);
}

// Does the same to a cell that was left out.
static void vary_left_out(const json_t *document, struct found *found)
{
    json_t *cell = json_array_get(json_object_get(document, "cells"), 3);
    assert_non_null(json_object_get(cell, "detail"));
    vary(document, cell, found);
}

static void test_other_kinds(void **state)
{
    (void)state;
    struct found found = {0};
    json_t *document = make_document();
    assert_true(try_document(document));
    vary(document, document, &found);
    vary_left_out(document, &found);
    assert_true(try_document(document));
    assert_above(found.refused, 300);
    assert_above(found.taken, 50);
    // Made anew from others when it is printed.
    assert_string_equal(found.unread,
                        " interrupted else fps ms ms_low ms_high passes_share flow_move "
                        "flow_light noise disturbed particles ");
    // Names of a row's own, and what older records lack.
    assert_string_equal(found.optional, " scene height_m fps particles unknown drops counted model "
                                        "share flow_move flow_light taken calibration_begin_ms ");
    json_decref(document);
}

// Whether a text is a document that is taken.
static bool try_text(const char *text, size_t size)
{
    json_t *document = json_loadb(text, size, JSON_REJECT_DUPLICATES, NULL);
    const bool ok = document && try_document(document);
    json_decref(document);
    return ok;
}

// Texts that were cut, or that have changed bytes.
static void test_bytes(void **state)
{
    (void)state;
    struct rg_result made = make_result();
    char *text = print_result(&made, RG_RESULT_JSON);
    const size_t size = strlen(text);
    assert_true(try_text(text, size));
    for (size_t length = 0; length < size - 2; length += 1 + size / 97)
        assert_false(try_text(text, length));
    uint32_t random = 12345;
    int refused = 0;
    for (int i = 0; i < 600; i++) {
        char *damaged = strdup(text);
        for (int changes = 0; changes <= i % 3; changes++) {
            random = random * 1664525 + 1013904223;
            damaged[(random >> 8) % size] = (char)(random >> 4 & 0xff);
        }
        refused += !try_text(damaged, size);
        free(damaged);
    }
    assert_above(refused, 200);
    free(text);
    rg_result_free(&made);
}

// Texts and names in a document may not control the terminal that it is printed on.
static void test_control_characters(void **state)
{
    (void)state;
    static const int formats[] = {RG_RESULT_MD, RG_RESULT_CSV, RG_RESULT_TEX, RG_RESULT_WIDE};
    char why[RG_WHY_SIZE];
    struct rg_result result = {0};
    json_t *document = make_document();
    json_object_set_new(document, "note",
                        json_string("no\x1b[2Jte \x7f \xc2\x9b"
                                    "2J"));
    json_object_set_new(document, "missing", json_pack("[s]", "mis\x1b[2Jsing"));
    json_t *cell = json_array_get(json_object_get(document, "cells"), 0);
    json_object_set_new(json_object_get(cell, "row"), "scene", json_string("sce\x1b[2Jne"));
    json_object_set_new(json_object_get(cell, "facts"),
                        "fa\x1b"
                        "ct",
                        json_string("a\x1b[2Jb"));
    if (!rg_result_from_json(document, "file", &result, why))
        fail_msg("%s", why);
    for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++) {
        char *text = print_result(&result, formats[i]);
        assert_null(strchr(text, 0x1b));
        assert_null(strchr(text, 0x7f));
        assert_null(strstr(text, "\xc2\x9b"));
        free(text);
    }
    assert_string_equal(result.note, "no?[2Jte ? ??2J");
    rg_result_free(&result);
    json_decref(document);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_other_kinds),
        cmocka_unit_test(test_bytes),
        cmocka_unit_test(test_control_characters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
