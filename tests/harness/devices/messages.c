// Messages between processes: what was put comes out, and damage is found.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/workers/message.h"

static int lines;

static void count_line(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)line;
    (void)user;
    lines++;
}

static void fill(struct rg_message *message)
{
    rg_put_int(message, -3);
    rg_put_text(message, "");
    rg_put_text(message, "name");
    rg_put_block(message, "\0\1\2", 3);
    rg_put_block(message, "", 0);
    const double number = 0.1;
    RG_PUT(message, number);
}

static void values_come_out_in_order(void **state)
{
    (void)state;
    struct rg_message message = {0};
    int64_t size;
    double number = 0;
    fill(&message);
    assert_int_equal(rg_take_int(&message), -3);
    assert_string_equal(rg_take_text(&message), "");
    assert_string_equal(rg_take_text(&message), "name");
    char *block = rg_take_block(&message, &size);
    assert_int_equal(size, 3);
    assert_memory_equal(block, "\0\1\2", 3);
    free(block);
    block = rg_take_block(&message, &size);
    assert_non_null(block);
    assert_int_equal(size, 0);
    free(block);
    assert_true(RG_TAKE(&message, number));
    assert_true(number == 0.1);
    assert_false(message.failed);
    rg_message_free(&message);
}

// Whatever its length, taking a message that was cut fails once, and gives nothing more.
static void a_message_that_is_cut_fails_once(void **state)
{
    (void)state;
    struct rg_message whole = {0};
    fill(&whole);
    for (int64_t size = 0; size < whole.size; size++) {
        struct rg_message cut = {.bytes = malloc((size_t)size + 1), .size = size, .room = size};
        memcpy(cut.bytes, whole.bytes, (size_t)size);
        int64_t taken;
        double number = 0;
        lines = 0;
        rg_take_int(&cut);
        rg_take_text(&cut);
        rg_take_text(&cut);
        free(rg_take_block(&cut, &taken));
        free(rg_take_block(&cut, &taken));
        RG_TAKE(&cut, number);
        assert_true(cut.failed);
        assert_int_equal(lines, 1);
        assert_string_equal(rg_take_text(&cut), "");
        assert_int_equal(rg_take_int(&cut), 0);
        rg_message_free(&cut);
    }
    rg_message_free(&whole);
}

static void sizes_that_lie_are_not_believed(void **state)
{
    (void)state;
    const int64_t sizes[] = {-1, INT64_MIN, INT64_MAX, 9, 1 << 30};
    for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
        struct rg_message message = {0};
        int64_t size;
        rg_put_int(&message, sizes[i]);
        rg_put(&message, "12345678", 8);
        assert_null(rg_take_block(&message, &size));
        assert_true(message.failed);
        rg_message_free(&message);
    }
}

static void a_text_ends_within_its_block(void **state)
{
    (void)state;
    struct rg_message message = {0};
    rg_put_block(&message, "abc", 3); // no zero at its end
    rg_put_block(&message, "", 1);
    assert_string_equal(rg_take_text(&message), "");
    assert_true(message.failed);
    rg_message_free(&message);
}

static void an_index_is_within_its_range(void **state)
{
    (void)state;
    const int64_t given[] = {0, 4, 5, -1, INT64_MAX};
    for (int i = 0; i < 5; i++) {
        struct rg_message message = {0};
        rg_put_int(&message, given[i]);
        const int index = rg_take_index(&message, 5);
        assert_int_equal(message.failed, i >= 2);
        assert_int_equal(index, i < 2 ? (int)given[i] : 0);
        rg_message_free(&message);
    }
}

static void names_stay_when_their_message_has_gone(void **state)
{
    (void)state;
    const char *names[4];
    for (int i = 0; i < 4; i++) {
        struct rg_message message = {0};
        rg_put_text(&message, i % 2 ? "drops" : "texels");
        names[i] = rg_take_name(&message);
        rg_message_free(&message);
    }
    assert_string_equal(names[0], "texels");
    assert_string_equal(names[1], "drops");
    assert_ptr_equal(names[0], names[2]); // and take memory once
    assert_ptr_equal(names[1], names[3]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_come_out_in_order),
        cmocka_unit_test(a_message_that_is_cut_fails_once),
        cmocka_unit_test(sizes_that_lie_are_not_believed),
        cmocka_unit_test(a_text_ends_within_its_block),
        cmocka_unit_test(an_index_is_within_its_range),
        cmocka_unit_test(names_stay_when_their_message_has_gone),
    };
    rg_log_listen(count_line, NULL);
    return cmocka_run_group_tests_name("messages", tests, NULL, NULL);
}
