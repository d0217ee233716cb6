// Structs in messages, by their tables of fields: every kind of field comes out as it was put in,
// and what its table does not allow is refused.
#include "harness/devices/workers/fields.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

// --- a struct with a field of each kind ---

struct point {
    int x, y;
};

struct own {
    int number;
};

struct sample {
    struct own own; // put, taken and freed by functions, so that it comes first
    bool flag;
    int small, positive;
    unsigned word;
    int64_t whole;
    double number;
    uint64_t any;
    char text[6];
    const char *name, *none;
    int three[3];
    struct point point, points[2];
    int some_count;
    struct point some[3];
    int count;
    int64_t room;
    struct point *rows;
    size_t bytes;
    void *block;
};

static int freed;

static void put_own(struct rg_message *message, const void *entry)
{
    rg_put_int(message, -((const struct own *)entry)->number);
}

static bool take_own(struct rg_message *message, void *entry)
{
    ((struct own *)entry)->number = (int)-rg_take_int(message);
    return ((struct own *)entry)->number != 66 && !message->failed;
}

static void free_own(void *entry)
{
    freed += ((struct own *)entry)->number;
}

static bool is_apart(const void *all)
{
    const struct sample *s = all;
    return s->small != s->positive;
}

static const struct rg_field_way own_way = {put_own, take_own, free_own};

static const struct rg_field point_fields[] = {
    RG_FIELD_INTEGER(struct point, x, 0, 100),
    RG_FIELD_INTEGER(struct point, y, 0, 100),
    RG_FIELDS_END,
};

static const struct rg_field fields[] = {
    RG_FIELD_OWN(struct own, &own_way),
    RG_FIELD_FLAG(struct sample, flag),
    RG_FIELD_INTEGER(struct sample, small, -2, 9),
    RG_FIELD_INTEGER(struct sample, positive, 1, INT_MAX),
    RG_FIELD_INTEGER(struct sample, word, 0, UINT32_MAX),
    RG_FIELD_INTEGER(struct sample, whole, -5, INT64_MAX),
    RG_FIELD_NUMBER(struct sample, number, -1, 2),
    RG_FIELD_BYTES(struct sample, any),
    RG_FIELD_TEXT(struct sample, text),
    RG_FIELD_NAME(struct sample, name),
    RG_FIELD_NAME_OR_NONE(struct sample, none),
    RG_FIELD_INTEGERS(struct sample, three, 1, 7),
    RG_FIELD_STRUCT(struct sample, point, point_fields),
    RG_FIELD_STRUCTS(struct sample, points, point_fields),
    RG_FIELD_SOME(struct sample, some, some_count, point_fields),
    RG_FIELD_LIST(struct sample, rows, point_fields, 2),
    RG_FIELD_BLOCK(struct sample, block, bytes),
    RG_FIELD_CHECK(is_apart),
    RG_FIELDS_END,
};

static struct point rows[3] = {{21, 22}, {23, 24}, {25, 26}};
static char block[5] = {'b', 0, 'c', 1, 2};

static struct sample make(void)
{
    return (struct sample){.own = {8},
                           .flag = true,
                           .small = -2,
                           .positive = 4,
                           .word = 5,
                           .whole = -5,
                           .number = 0.25,
                           .any = UINT64_C(0xfedcba9876543210),
                           .text = "abcde",
                           .name = "a name",
                           .three = {1, 2, 7},
                           .point = {9, 10},
                           .points = {{11, 12}, {13, 14}},
                           .some_count = 2,
                           .some = {{15, 16}, {17, 18}},
                           .count = 2,
                           .rows = rows,
                           .bytes = sizeof(block),
                           .block = block};
}

// Puts a sample, and takes it again; what was taken is freed. Returns whether it was taken.
static bool passes(const struct sample *put, struct sample *taken)
{
    struct rg_message message = {0};
    logged_lines = 0;
    freed = 0;
    *taken = (struct sample){.flag = false};
    rg_put_fields(&message, fields, put);
    const bool ok = rg_take_fields(&message, fields, taken);
    assert_int_equal(ok && message.at == message.size, ok);
    assert_int_equal(message.failed, logged_lines > 0);
    rg_message_free(&message);
    return ok;
}

// --- all comes out ---

static void every_kind_comes_out_as_it_was_put(void **state)
{
    (void)state;
    const struct sample put = make();
    struct sample taken;
    assert_true(passes(&put, &taken));
    assert_int_equal(logged_lines, 0);
    assert_int_equal(taken.own.number, 8);
    assert_int_equal(taken.flag, true);
    assert_int_equal(taken.small, -2);
    assert_int_equal(taken.positive, 4);
    assert_int_equal(taken.word, 5);
    assert_int_equal(taken.whole, -5);
    assert_equals(taken.number, 0.25);
    assert_true(taken.any == put.any);
    assert_string_equal(taken.text, "abcde");
    assert_string_equal(taken.name, "a name");
    assert_null(taken.none);
    assert_memory_equal(taken.three, put.three, sizeof(put.three));
    assert_memory_equal(&taken.point, &put.point, sizeof(put.point));
    assert_memory_equal(taken.points, put.points, sizeof(put.points));
    assert_int_equal(taken.some_count, 2);
    assert_memory_equal(taken.some, put.some, sizeof(put.some)); // the third stays zeros
    assert_int_equal(taken.count, 2);
    assert_at_least(taken.room, 2);
    assert_memory_equal(taken.rows, rows, 2 * sizeof(rows[0]));
    assert_int_equal(taken.bytes, sizeof(block));
    assert_memory_equal(taken.block, block, sizeof(block));
    rg_free_fields(fields, &taken);
    assert_int_equal(freed, 8);
}

// --- ranges ---

#define AT(field) offsetof(struct sample, field), sizeof(((struct sample *)0)->field)

static const struct {
    size_t at, size;
    int64_t value;
    bool ok;
} of_integers[] = {
    {AT(flag), 0, true},
    {AT(flag), 2, false},
    {AT(flag), 255, false},
    {AT(small), -3, false},
    {AT(small), 9, true},
    {AT(small), 10, false},
    {AT(small), INT_MIN, false},
    {AT(small), 4, false}, // as `positive`, which the check
                           // refuses
    {AT(positive), 0, false},
    {AT(positive), 1, true},
    {AT(positive), INT_MAX, true},
    {AT(positive), -1, false},
    {AT(word), UINT32_MAX, true},
    {AT(word), 0, true},
    {AT(whole), -6, false},
    {AT(whole), INT64_MAX, true},
    {AT(any), -1, true},
    {AT(three[0]), 0, false},
    {AT(three[1]), 8, false},
    {AT(three[2]), 0, false},
    {AT(point.x), 101, false},
    {AT(point.y), 101, false},
    {AT(points[0].y), 101, false},
    {AT(points[1].y), 101, false},
    {AT(points[1].y), 100, true},
    {AT(some[1].x), 101, false},
    {AT(some[2].x), 101, true}, // behind those that are used
    {AT(some_count), 3, true},
    {AT(some_count), 0, true},
    {AT(some_count), -1, false},
    {AT(count), 0, true},
    {AT(count), 3, false},
    {AT(count), -1, false},
    {AT(own), 66, false},
};

static void integers_are_within_their_ranges(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(of_integers) / sizeof(of_integers[0]); i++) {
        struct sample put = make(), taken;
        memcpy((char *)&put + of_integers[i].at, &of_integers[i].value, of_integers[i].size);
        if (passes(&put, &taken) != of_integers[i].ok)
            fail_msg("case %d: %lld at %zu", (int)i, (long long)of_integers[i].value,
                     of_integers[i].at);
        if (of_integers[i].ok && of_integers[i].at != offsetof(struct sample, some[2].x))
            assert_memory_equal((char *)&taken + of_integers[i].at,
                                (char *)&put + of_integers[i].at, of_integers[i].size);
        rg_free_fields(fields, &taken);
    }
}

static void numbers_are_within_their_ranges(void **state)
{
    (void)state;
    static const struct {
        double value;
        bool ok;
    } cases[] = {{-1, true},     {2, true},         {0, true},          {-1.001, false},
                 {2.001, false}, {INFINITY, false}, {-INFINITY, false}, {NAN, false}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct sample put = make(), taken;
        put.number = cases[i].value;
        assert_int_equal(passes(&put, &taken), cases[i].ok);
        rg_free_fields(fields, &taken);
    }
}

static void texts_end_and_names_are_there(void **state)
{
    (void)state;
    struct sample put = make(), taken;
    put.none = "something";
    strcpy(put.text, "");
    assert_true(passes(&put, &taken));
    assert_string_equal(taken.none, "something");
    assert_string_equal(taken.text, "");
    rg_free_fields(fields, &taken);
    memset(put.text, 'x', sizeof(put.text));
    assert_false(passes(&put, &taken));
    assert_int_equal(logged_lines, 1);
    rg_free_fields(fields, &taken);
    put = make();
    put.name = NULL;
    assert_false(passes(&put, &taken));
    assert_int_equal(logged_lines, 1);
    rg_free_fields(fields, &taken);
}

// --- damage ---

// Whatever was taken of a message that ends early can be freed.
static void a_struct_that_is_cut_is_refused_in_one_line(void **state)
{
    (void)state;
    const struct sample put = make();
    struct rg_message whole = {0};
    rg_put_fields(&whole, fields, &put);
    for (int64_t size = 0; size < whole.size; size++) {
        struct sample taken = {.flag = false};
        struct rg_message cut = {.bytes = malloc((size_t)size + 1), .size = size, .room = size};
        memcpy(cut.bytes, whole.bytes, (size_t)size);
        logged_lines = 0;
        assert_false(rg_take_fields(&cut, fields, &taken));
        assert_int_equal(logged_lines, 1);
        rg_free_fields(fields, &taken);
        rg_message_free(&cut);
    }
    rg_message_free(&whole);
}

// A call whose message failed before takes nothing of it.
static void nothing_is_taken_of_a_message_that_failed(void **state)
{
    (void)state;
    const struct sample put = make();
    struct sample taken = {.flag = false};
    struct rg_message message = {0};
    rg_put_fields(&message, fields, &put);
    rg_message_fail(&message);
    logged_lines = 0;
    assert_false(rg_take_fields(&message, fields, &taken));
    assert_int_equal(logged_lines, 0);
    assert_int_equal(message.at, 0);
    rg_message_free(&message);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_comes_out_as_it_was_put),
        cmocka_unit_test(integers_are_within_their_ranges),
        cmocka_unit_test(numbers_are_within_their_ranges),
        cmocka_unit_test(texts_end_and_names_are_there),
        cmocka_unit_test(a_struct_that_is_cut_is_refused_in_one_line),
        cmocka_unit_test(nothing_is_taken_of_a_message_that_failed),
    };
    rg_log_listen(log_last, NULL);
    return cmocka_run_group_tests_name("fields", tests, NULL, NULL);
}
