// Names, texts and numbers as documents keep them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <jansson.h>
#include <math.h>
#include <string.h>

#include "harness/record/named.h"
#include "tests/tools/expect.h"

// A character that does not fit whole is left out; bytes that are no UTF-8 are marked.
static void test_texts(void **state)
{
    (void)state;
    static const struct {
        const char *text, *kept;
    } cases[] = {{"abcdefg", "abcdefg"},
                 {"abcdefgh", "abcdefg"},
                 {"abcde\xe2\x82\xac", "abcde"},
                 {"abcdef\xc3\xa9", "abcdef"},
                 {"abcd\xe2\x82\xac", "abcd\xe2\x82\xac"},
                 {"ab\xffz", "ab?z"},
                 {"", ""},
                 {"a\x1b[\tb", "a?[ b"},
                 {"abcdef\xc3\xa9\xc3\xa9", "abcdef"}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char kept[8];
        rg_text_copy(kept, sizeof(kept), cases[i].text);
        assert_string_equal(kept, cases[i].kept);
    }
    json_t *json = rg_json_text("a\xff\xc3\xa9");
    assert_string_equal(json_string_value(json), "a???");
    json_decref(json);
    json = rg_json_text("\xc3\xa9 as it is");
    assert_string_equal(json_string_value(json), "\xc3\xa9 as it is");
    json_decref(json);
}

// NaN and infinities are null; whole numbers are integers if they lose nothing.
static void test_numbers(void **state)
{
    (void)state;
    static const struct {
        double number;
        json_type type;
    } cases[] = {{NAN, JSON_NULL},       {INFINITY, JSON_NULL},
                 {-INFINITY, JSON_NULL}, {3, JSON_INTEGER},
                 {0.5, JSON_REAL},       {-7, JSON_INTEGER},
                 {1e300, JSON_REAL},     {9007199254740992.0, JSON_REAL},
                 {0, JSON_INTEGER}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        json_t *json = rg_number_json(cases[i].number);
        assert_int_equal(json_typeof(json), cases[i].type);
        if (cases[i].type != JSON_NULL)
            assert_equals(json_number_value(json), cases[i].number);
        json_decref(json);
    }
    assert_true(isnan(rg_number_kept(INFINITY)));
    assert_equals(rg_number_kept(123456789), 123456789);
    assert_equals(rg_number_kept(rg_number_kept(M_PI)), rg_number_kept(M_PI));
    assert_differs(rg_number_kept(M_PI), M_PI);
    assert_below(fabs(rg_number_kept(M_PI) - M_PI), 1e-6);
}

static void test_named(void **state)
{
    (void)state;
    struct rg_named named[3];
    char text[64];
    rg_named_set_text(&named[0], "fps", "many");
    rg_named_set_number(&named[1], "fps", 25.5);
    rg_named_set_number(&named[2], "ms", NAN);
    assert_true(isnan(named[0].number));
    assert_equals(*rg_named_number(named, 3, "fps"), 25.5); // a text is no number
    assert_null(rg_named_number(named, 1, "fps"));
    assert_null(rg_named_number(named, 3, "fp"));
    static const char *const except[] = {"ms", NULL};
    rg_named_text(named, 3, except, text, sizeof(text));
    assert_string_equal(text, "fps many, fps 25.5");
    json_t *json = rg_named_json(named + 1, 2);
    assert_equals(json_real_value(json_object_get(json, "fps")), 25.5);
    assert_true(json_is_null(json_object_get(json, "ms")));
    json_decref(json);
}

// Facts are texts or numbers, and all are taken, in their order.
static void test_copies(void **state)
{
    (void)state;
    const struct rg_fact facts[] = {{.name = "faces", .number = 12345678901},
                                    {.name = "model", .text = "bunny", .number = 7},
                                    {.name = "share", .number = 2.0 / 3}};
    const struct rg_counter counters[] = {{"drops", 5}, {"splashes", INT64_MAX}};
    struct rg_named named[3];
    struct rg_count counts[2];
    char text[64];
    rg_facts_copy(named, facts, 3);
    rg_named_text(named, 3, NULL, text, sizeof(text));
    assert_string_equal(text, "faces 12345678901, model bunny, share 0.666666667");
    static const char *const first[] = {"share", "faces", NULL};
    rg_named_text(named, 3, first, text, sizeof(text));
    assert_string_equal(text, "model bunny");
    rg_named_text(named, 0, NULL, text, sizeof(text));
    assert_string_equal(text, "");
    rg_counters_copy(counts, counters, 2);
    json_t *json = rg_counts_json(counts, 2);
    assert_int_equal(json_object_size(json), 2);
    assert_int_equal(json_integer_value(json_object_get(json, "drops")), 5);
    assert_int_equal(json_integer_value(json_object_get(json, "splashes")), INT64_MAX);
    json_decref(json);
}

// Older readers know the words of the first outcomes alone; of the last two a fault tells which.
static void test_outcomes(void **state)
{
    (void)state;
    static const struct {
        enum rg_outcome outcome;
        const char *status, *fault;
    } rows[] = {{RG_OK, "ok", NULL},           {RG_FAIL, "fail", NULL},
                {RG_ERROR, "error", NULL},     {RG_CRASH, "crash", NULL},
                {RG_TIMEOUT, "timeout", NULL}, {RG_UNSUPPORTED, "unsupported", NULL},
                {RG_NOTHING, "nothing", NULL}, {RG_LACKING, "error", "harness"},
                {RG_SETUP, "error", "set-up"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        json_t *json = json_object();
        rg_outcome_set(json, rows[i].outcome);
        assert_string_equal(json_string_value(json_object_get(json, "status")), rows[i].status);
        const char *fault = json_string_value(json_object_get(json, "fault"));
        assert_string_equal(fault ? fault : "", rows[i].fault ? rows[i].fault : "");
        json_decref(json);
    }
}

// Nine digits are kept, of numbers of any size.
static void test_digits(void **state)
{
    (void)state;
    assert_equals(rg_number_kept(1.0 / 3), 0.333333333);
    assert_equals(rg_number_kept(-200000.0 / 3), -66666.6667);
    assert_equals(rg_number_kept(2e-20 / 3), 6.66666667e-21);
    assert_equals(rg_number_kept(12345678901234.0), 12345678901234.0); // a whole one keeps all
    assert_true(isnan(rg_number_kept(NAN)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_texts),    cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_named),    cmocka_unit_test(test_copies),
        cmocka_unit_test(test_outcomes), cmocka_unit_test(test_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
