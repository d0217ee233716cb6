// Checksums of a stored table's cells: any change is noticed, and the cell is named. Derived
// fields, and the form of numbers, may change.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/record/disk/cells.h"
#include "harness/record/disk/seal.h"
#include "harness/tables/print.h"
#include "tests/harness/record/made.h"
#include "tests/tools/expect.h"

// A made result, printed and read again.
static json_t *make_document(void)
{
    struct rg_result made = make_result();
    char *text = print_result(&made, RG_RESULT_JSON);
    json_t *document = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(document);
    free(text);
    rg_result_free(&made);
    return document;
}

static json_t *cell_of(const json_t *document, size_t i)
{
    return json_array_get(json_object_get(document, "cells"), i);
}

static void assert_taken(const json_t *document)
{
    char why[RG_WHY_SIZE];
    if (!rg_cells_are_whole("some/file.json", document, why))
        fail_msg("refused: %s", why);
}

// `names`: text that the line contains.
static void assert_refused(const json_t *document, const char *names)
{
    char why[RG_WHY_SIZE] = "";
    if (rg_cells_are_whole("some/file.json", document, why))
        fail_msg("taken, where '%s' is wrong", names);
    if (strncmp(why, "some/file.json: ", 16) != 0 || !strstr(why, names) || strchr(why, '\n') ||
        !strstr(why, "; restore it, or measure the table again"))
        fail_msg("'%s' instead of '%s'", why, names);
}

// --- changed fields ---

static bool is_made_anew(const char *key)
{
    // The last is a fact, next to its published value.
    static const char *const keys[] = {"interrupted", "shapes",   "fps",          "ms",
                                       "ms_low",      "ms_high",  "passes_share", "noise",
                                       "disturbed",   "particles"};
    bool is = false;
    for (size_t i = 0; i < sizeof(keys) / sizeof(keys[0]); i++)
        is = is || !strcmp(key, keys[i]);
    return is;
}

// Another value of the same kind, with the smallest difference that is kept.
static json_t *other_value(const json_t *value)
{
    char text[4096];
    if (json_is_string(value)) {
        snprintf(text, sizeof(text), "%s.", json_string_value(value));
        return json_string(text);
    }
    if (json_is_real(value))
        return json_real(json_real_value(value) * (1 + 2e-8) + 1e-20);
    if (json_is_integer(value))
        return json_integer(json_integer_value(value) ^ 1);
    if (json_is_boolean(value))
        return json_boolean(!json_is_true(value));
    return json_is_null(value) ? json_integer(0) : json_null();
}

// Changes each value below `at` except derived ones, and takes each out of its object. Returns the
// number of changes. `names`: text that the line has to contain.
static int change_each(const json_t *document, json_t *at, const char *names)
{
    const char *key;
    json_t *value;
    int tried = 0;
    for (size_t i = 0; json_is_array(at) && i < json_array_size(at); i++) {
        json_t *kept = json_incref(json_array_get(at, i));
        json_array_set_new(at, i, other_value(kept));
        assert_refused(document, names);
        json_array_set(at, i, kept);
        tried += 1 + change_each(document, kept, names);
        json_decref(kept);
    }
    json_t *fields = json_is_object(at) ? json_copy(at) : NULL;
    const bool is_measured = fields && json_object_get(fields, "samples_ms");
    json_object_foreach(fields, key, value)
    {
        if (!strcmp(key, "cells") ||
            ((is_measured || json_object_get(fields, "format")) && is_made_anew(key)))
            continue;
        json_object_set_new(at, key, other_value(value));
        assert_refused(document, names);
        json_object_del(at, key);
        assert_refused(document, names);
        json_object_clear(at);
        json_object_update(at, fields);
        tried += 2 + change_each(document, value, names);
    }
    json_decref(fields);
    return tried;
}

static void test_each_field(void **state)
{
    (void)state;
    json_t *document = make_document();
    assert_taken(document);
    const int head = change_each(document, document, "what stands before its cells was changed");
    int cells = change_each(document, cell_of(document, 0), "cells[0] (row ");
    cells += change_each(document, cell_of(document, 7), "cells[7] (row ");
    assert_taken(document);
    print_message("%d changes before the cells, %d of two cells\n", head, cells);
    assert_above(head, 60);
    assert_above(cells, 120);
    json_decref(document);
}

// Fields that follow from others can be wrong, or missing, as in the tables that results/keep.py
// keeps.
static void test_made_anew(void **state)
{
    (void)state;
    static const char *const names[] = {"fps",          "ms",    "ms_low",    "ms_high",
                                        "passes_share", "noise", "disturbed", "particles"};
    json_t *document = make_document();
    json_t *measured = json_object_get(cell_of(document, 0), "measured");
    json_object_set_new(measured, "fps", json_integer(1));
    json_object_set_new(document, "interrupted", json_false());
    assert_taken(document);
    json_object_del(document, "shapes");
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
        assert_int_equal(json_object_del(measured, names[i]), 0);
    assert_taken(document);
    json_decref(document);
}

// --- other writers ---

// Writes whole numbers without a point, as another program may; the others keep all their digits.
static void rewrite(json_t *at)
{
    const char *key;
    json_t *value, *fields = json_is_object(at) ? json_copy(at) : NULL;
    for (size_t i = 0; json_is_array(at) && i < json_array_size(at); i++) {
        value = json_array_get(at, i);
        if (json_is_real(value) && json_real_value(value) == (double)(int)json_real_value(value))
            json_array_set_new(at, i, json_integer((int)json_real_value(value)));
        else
            rewrite(value);
    }
    json_object_foreach(fields, key, value)
    {
        if (json_is_real(value) && json_real_value(value) == (double)(int)json_real_value(value))
            json_object_set_new(at, key, json_integer((int)json_real_value(value)));
        else
            rewrite(value);
    }
    json_decref(fields);
}

static void test_other_writers(void **state)
{
    (void)state;
    json_t *document = make_document();
    json_t *measured = json_object_get(cell_of(document, 0), "measured");
    assert_true(json_is_real(json_object_get(measured, "first_frame_ms")));
    rewrite(document);
    assert_true(json_is_integer(json_object_get(measured, "first_frame_ms")));
    char *text = json_dumps(document, JSON_REAL_PRECISION(17) | JSON_ENSURE_ASCII);
    json_t *again = json_loads(text, 0, NULL);
    assert_taken(again);
    // The order of fields counts: the first number of a row is its axis, and passes are in the
    // order in which they run.
    json_t *sorted;
    free(text);
    text = json_dumps(document, JSON_SORT_KEYS);
    sorted = json_loads(text, 0, NULL);
    assert_refused(sorted, "no checksum is right");
    free(text);
    json_decref(sorted);
    json_decref(again);
    // Rounding may make a number whole only when it is written.
    json_object_set_new(json_object_get(document, "passport"), "else", json_real(2 - 1e-12));
    assert_true(rg_cells_seal(document));
    text = json_dumps(document, RG_JSON_FLAGS);
    again = json_loads(text, 0, NULL);
    assert_taken(again);
    free(text);
    json_decref(again);
    json_decref(document);
}

// --- moved cells ---

static void test_moved(void **state)
{
    (void)state;
    json_t *document = make_document(), *other = make_document();
    json_t *cells = json_object_get(document, "cells");
    // One cell's measurements put over another variant's, and its counted work over another row's.
    static const char *const fields[] = {"measured", "counted"};
    for (size_t i = 0; i < 2; i++) {
        json_t *cell = cell_of(document, i ? 8 : 2), *first = cell_of(document, 0);
        json_t *kept = json_incref(json_object_get(cell, fields[i]));
        json_object_set(cell, fields[i], json_object_get(first, fields[i]));
        assert_refused(document, i ? "cells[8] (row 4, paper, full, on cpu:reference) has a wrong"
                                   : "cells[2] (row 2, paper, bare, on cpu:reference) has a wrong");
        json_object_set_new(cell, fields[i], kept);
    }
    assert_taken(document);
    // A whole cell, with the names of the one that it replaces.
    json_t *copied = json_deep_copy(cell_of(document, 0));
    json_object_set_new(copied, "device", json_string("gl"));
    json_array_set_new(cells, 1, copied);
    assert_refused(document, "cells[1] (row 2, paper, full, on gl) has a wrong checksum");
    // A cell of another machine's table.
    json_object_set_new(json_object_get(other, "passport"), "else", json_string("is another"));
    assert_true(rg_cells_seal(other));
    assert_taken(other);
    json_array_set(cells, 1, cell_of(other, 1));
    assert_refused(document, "cells[1] (row 2, paper, full, on gl) has a wrong checksum");
    json_decref(other);
    json_decref(document);
}

// A table from before there were checksums has none in any cell.
static void test_missing(void **state)
{
    (void)state;
    json_t *document = make_document(), *cell;
    size_t i;
    json_object_del(cell_of(document, 3), "checksum");
    assert_refused(document, "cells[3] (row 2, paper, bare, on gl) has no checksum");
    json_object_set_new(cell_of(document, 3), "checksum", json_integer(3));
    assert_refused(document, "cells[3] (row 2, paper, bare, on gl) has a wrong checksum");
    json_array_foreach(json_object_get(document, "cells"), i, cell)
        json_object_del(cell, "checksum");
    assert_taken(document);
    json_array_clear(json_object_get(document, "cells"));
    assert_taken(document);
    json_decref(document);
}

// Whoever writes a document anew may order its names otherwise.
static void test_order_of_names(void **state)
{
    (void)state;
    json_t *written = json_pack("{s:i, s:{s:i, s:i}}", "b", 1, "a", "d", 2, "c", 3);
    assert_true(rg_seal(written));
    json_t *read = json_pack("{s:{s:i, s:i}, s:O, s:i}", "a", "c", 3, "d", 2, "checksum",
                             json_object_get(written, "checksum"), "b", 1);
    assert_int_equal(rg_unseal(read), RG_SEAL_WHOLE);
    json_decref(written);
    json_decref(read);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_field),    cmocka_unit_test(test_made_anew),
        cmocka_unit_test(test_other_writers), cmocka_unit_test(test_moved),
        cmocka_unit_test(test_missing),       cmocka_unit_test(test_order_of_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
