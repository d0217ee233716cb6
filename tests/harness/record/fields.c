// Fields of documents: what each type takes, and what is said of what it does not take.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/record/schema/fields.h"
#include "tests/tools/expect.h"

static char why[256];

static struct rg_reader reader_of(const char *place)
{
    struct rg_reader reader = {
        .file = "a.json", .mend = "mend it", .why = why, .why_size = sizeof(why)};
    *why = 0;
    rg_reader_enter(&reader, "%s", place);
    return reader;
}

// A document's field f has this value.
static json_t *with(const char *value)
{
    char text[512];
    json_error_t error;
    snprintf(text, sizeof(text), *value ? "{\"f\": %s}" : "{\"g\": 1%s}", value);
    json_t *document = json_loads(text, 0, &error);
    assert_non_null(document);
    return document;
}

struct row {
    const char *value; // "": the field is missing
    double due;        // what is read
    const char *said;  // what is said if it is refused; NULL: it is taken
};

static void expect_said(const struct row *row, bool is_taken)
{
    char due[256] = "";
    if (row->said)
        snprintf(due, sizeof(due), "a.json: f %s; mend it", row->said);
    assert_string_equal(why, due);
    assert_int_equal(is_taken, !row->said);
}

// --- numbers ---

#define OUTSIDE "is no whole number from -5 to 7"

static void whole_numbers_have_bounds(void **state)
{
    (void)state;
    static const struct row rows[] = {
        {"3", 3, NULL},       {"-5", -5, NULL},      {"7", 7, NULL},
        {"-6", 0, OUTSIDE},   {"8", 0, OUTSIDE},     {"2.5", 0, OUTSIDE},
        {"0.0", 0, OUTSIDE},  {"\"3\"", 0, OUTSIDE}, {"4294967299", 0, OUTSIDE},
        {"true", 0, OUTSIDE}, {"null", 0, OUTSIDE},  {"", 0, "is missing"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_reader reader = reader_of("");
        json_t *document = with(rows[i].value);
        int found = 99;
        expect_said(&rows[i], rg_field_int(&reader, document, "f", -5, 7, &found));
        assert_int_equal(found, rows[i].said ? 99 : (int)rows[i].due);
        json_decref(document);
    }
    struct rg_reader reader = reader_of("");
    json_t *document = with("1");
    int found;
    assert_false(rg_field_int(&reader, document, "f", 2, INT_MAX, &found));
    assert_string_equal(why, "a.json: f is no whole number from 2 on; mend it");
    json_decref(document);
}

static void numbers_and_counts_are_not_negative(void **state)
{
    (void)state;
    static const struct row numbers[] = {{"0", 0, NULL},
                                         {"2.5", 2.5, NULL},
                                         {"-0.5", 0, "is no number from 0 on"},
                                         {"\"1\"", 0, "is no number from 0 on"},
                                         {"null", 0, "is no number from 0 on"},
                                         {"", 0, "is missing"}};
    static const struct row counts[] = {{"0", 0, NULL},
                                        {"5000000000", 5e9, NULL},
                                        {"null", -1, NULL},
                                        {"-1", 0, "is no whole number from 0 on"},
                                        {"2.5", 0, "is no whole number from 0 on"},
                                        {"\"1\"", 0, "is no whole number from 0 on"},
                                        {"", 0, "is missing"}};
    for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++) {
        struct rg_reader reader = reader_of("");
        json_t *document = with(numbers[i].value);
        double found;
        expect_said(&numbers[i], rg_field_number(&reader, document, "f", &found));
        if (!numbers[i].said)
            assert_equals(found, numbers[i].due);
        json_decref(document);
    }
    for (size_t i = 0; i < sizeof(counts) / sizeof(counts[0]); i++) {
        struct rg_reader reader = reader_of("");
        json_t *document = with(counts[i].value);
        int64_t found;
        expect_said(&counts[i], rg_field_count(&reader, document, "f", &found));
        if (!counts[i].said)
            assert_equals((double)found, counts[i].due);
        json_decref(document);
    }
}

static void switches_are_true_or_false(void **state)
{
    (void)state;
    static const struct row rows[] = {{"true", 1, NULL},
                                      {"false", 0, NULL},
                                      {"1", 0, "is neither true nor false"},
                                      {"null", 0, "is neither true nor false"},
                                      {"", 0, "is missing"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_reader reader = reader_of("");
        json_t *document = with(rows[i].value);
        bool found = rows[i].due == 0;
        expect_said(&rows[i], rg_field_bool(&reader, document, "f", &found));
        if (!rows[i].said)
            assert_int_equal(found, rows[i].due != 0);
        json_decref(document);
    }
}

// --- texts and lists ---

static void texts_fit(void **state)
{
    (void)state;
    static const struct {
        struct row row;
        bool may_be_null;
        const char *text;
    } rows[] = {
        {{"\"abc\"", 0, NULL}, false, "abc"},
        {{"\"\"", 0, NULL}, false, ""},
        {{"\"a\\nb\"", 0, NULL}, false, "a b"}, // it is printed later
        {{"\"abcd\"", 0, "is no text of less than 4 bytes"}, false, NULL},
        {{"1", 0, "is no text"}, false, NULL},
        {{"null", 0, "is no text"}, false, NULL},
        {{"null", 0, NULL}, true, ""},
        {{"\"abc\"", 0, NULL}, true, "abc"},
        {{"1", 0, "is no text"}, true, NULL},
        {{"", 0, "is missing"}, true, NULL},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_reader reader = reader_of("");
        json_t *document = with(rows[i].row.value);
        char text[4] = "old";
        expect_said(&rows[i].row,
                    rows[i].may_be_null
                        ? rg_field_text_or_null(&reader, document, "f", text, sizeof(text))
                        : rg_field_text(&reader, document, "f", text, sizeof(text)));
        if (rows[i].text)
            assert_string_equal(text, rows[i].text);
        json_decref(document);
    }
}

static void lists_have_one_to_most_elements(void **state)
{
    (void)state;
    static const struct row rows[] = {{"[1]", 1, NULL},
                                      {"[1, 2]", 2, NULL},
                                      {"[]", 0, "has not 1 to 2 elements"},
                                      {"[1, 2, 3]", 0, "has not 1 to 2 elements"},
                                      {"{}", 0, "is no array"},
                                      {"", 0, "is missing"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_reader reader = reader_of("");
        json_t *document = with(rows[i].value);
        int count = 99;
        expect_said(&rows[i], rg_field_array(&reader, document, "f", 2, &count) != NULL);
        assert_int_equal(count, (int)rows[i].due);
        json_decref(document);
    }
}

static void named_values_are_numbers_texts_or_nothing(void **state)
{
    (void)state;
    static const struct row refused[] = {
        {"{\"a\": true}", 0, "has 'a', which is of another kind"},
        {"{\"a\": 1, \"b\": []}", 0, "has 'b', which is of another kind"},
        {"{\"a\": \"\"}", 0, "has 'a', which is of another kind"},
        {"{\"a\": 1, \"b\": 2, \"c\": 3, \"d\": 4}", 0, "has more than 3 fields"},
        {"{\"\": 1}", 0, NULL},
        {"3", 0, "is no object"},
    };
    struct rg_named named[3];
    int count;
    struct rg_reader reader = reader_of("");
    json_t *document = with("{\"a\": 2.5, \"b\": \"x\", \"c\": null}");
    assert_true(rg_field_named(&reader, document, "f", named, 3, &count));
    assert_int_equal(count, 3);
    assert_string_equal(named[0].name, "a");
    assert_equals(named[0].number, 2.5);
    assert_string_equal(named[1].text, "x");
    assert_true(isnan(named[1].number) && isnan(named[2].number) && !*named[2].text);
    json_decref(document);
    for (size_t i = 0; i < sizeof(refused) / sizeof(refused[0]); i++) {
        reader = reader_of("");
        document = with(refused[i].value);
        assert_false(rg_field_named(&reader, document, "f", named, 3, &count));
        if (refused[i].said)
            expect_said(&refused[i], false);
        else
            assert_non_null(strstr(why, "has a field whose name has not 1 to "));
        json_decref(document);
    }
}

static void counts_are_whole_numbers(void **state)
{
    (void)state;
    struct rg_count counts[2];
    int count;
    struct rg_reader reader = reader_of("");
    json_t *document = with("{\"a\": 5000000000, \"b\": -2}");
    assert_true(rg_field_counts(&reader, document, "f", counts, 2, &count));
    assert_int_equal(count, 2);
    assert_string_equal(counts[1].name, "b");
    assert_true(counts[0].value == 5000000000 && counts[1].value == -2);
    json_decref(document);
    document = with("{\"a\": 2.5}");
    assert_false(rg_field_counts(&reader, document, "f", counts, 2, &count));
    assert_string_equal(why, "a.json: f has 'a', which is of another kind; mend it");
    json_decref(document);
}

// --- places ---

// A field is said to lie in the object that is read.
static void places_are_told(void **state)
{
    (void)state;
    struct rg_reader reader = reader_of("cells[3]");
    json_t *document = with("1");
    char text[4];
    assert_false(rg_field_text(&reader, document, "f", text, sizeof(text)));
    assert_string_equal(why, "a.json: cells[3].f is no text; mend it");
    assert_false(rg_reader_refuse(&reader, "", "is of %d rows", 7));
    assert_string_equal(why, "a.json: cells[3] is of 7 rows; mend it");
    reader = reader_of("");
    rg_reader_refuse(&reader, "", "is empty");
    assert_string_equal(why, "a.json: is empty; mend it");
    json_decref(document);
}

// All counts of a tally are read, and what is wrong is said of the count; then the place is as
// before.
static void a_tally_has_all_its_counts(void **state)
{
    (void)state;
    json_t *document = json_object(), *counts = json_object();
    for (int i = 0; i < RG_TALLY_FIELDS; i++)
        json_object_set_new(counts, rg_tally_fields[i].name, json_integer(100 + i));
    json_object_set_new(document, "f", counts);
    struct rg_reader reader = reader_of("cells[3]");
    struct rg_tally tally = {0};
    assert_true(rg_field_tally(&reader, document, "f", &tally));
    for (int i = 0; i < RG_TALLY_FIELDS; i++) {
        int64_t found;
        memcpy(&found, (const char *)&tally + rg_tally_fields[i].offset, sizeof(found));
        assert_int_equal(found, 100 + i);
    }
    assert_string_equal(reader.place, "cells[3]");
    const char *last = rg_tally_fields[RG_TALLY_FIELDS - 1].name;
    char due[256];
    json_object_set_new(counts, last, json_string("x"));
    assert_false(rg_field_tally(&reader, document, "f", &tally));
    snprintf(due, sizeof(due), "a.json: cells[3].f.%s is no whole number from 0 on; mend it", last);
    assert_string_equal(why, due);
    assert_string_equal(reader.place, "cells[3]");
    json_decref(document);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_numbers_have_bounds),
        cmocka_unit_test(numbers_and_counts_are_not_negative),
        cmocka_unit_test(switches_are_true_or_false),
        cmocka_unit_test(texts_fit),
        cmocka_unit_test(lists_have_one_to_most_elements),
        cmocka_unit_test(named_values_are_numbers_texts_or_nothing),
        cmocka_unit_test(counts_are_whole_numbers),
        cmocka_unit_test(places_are_told),
        cmocka_unit_test(a_tally_has_all_its_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
