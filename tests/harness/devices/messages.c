// Messages between processes: values come out as they were put in, and damage is found.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/devices/workers/channel.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

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
    assert_equals(number, 0.1);
    assert_false(message.failed);
    rg_message_free(&message);
}

// Taking from a cut message of any length fails once, and gives nothing more.
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
        logged_lines = 0;
        rg_take_int(&cut);
        rg_take_text(&cut);
        rg_take_text(&cut);
        free(rg_take_block(&cut, &taken));
        free(rg_take_block(&cut, &taken));
        RG_TAKE(&cut, number);
        assert_true(cut.failed);
        assert_int_equal(logged_lines, 1);
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
        size = 1;
        assert_null(rg_take_block(&message, &size));
        assert_int_equal(size, 0); // so that no taker counts rows in it
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
    assert_ptr_equal(names[0], names[2]); // equal names share memory
    assert_ptr_equal(names[1], names[3]);
}

// Names are kept as long as the process lives, so a liar may not send new ones for ever.
static void names_are_no_more_than_a_program_has(void **state)
{
    char name[512] = "";
    int taken = 0;
    (void)state;
    logged_lines = 0;
    for (int i = 0; i < 10000; i++) {
        struct rg_message message = {0};
        snprintf(name, sizeof(name), "name %d", i);
        rg_put_text(&message, name);
        taken += rg_take_name(&message)[0] != 0;
        rg_message_free(&message);
    }
    assert_between(taken, 1000, 5000);
    assert_int_equal(logged_lines, 10000 - taken);
    memset(name, 'n', sizeof(name) - 1);
    struct rg_message message = {0};
    rg_put_text(&message, name);
    assert_string_equal(rg_take_name(&message), "");
    assert_true(message.failed);
    rg_message_free(&message);
}

// The receiver bounds the size that a sender announces, and stops waiting for a message that never
// comes.
static void a_message_is_bounded(void **state)
{
    static const struct {
        int64_t most_bytes, told_bytes;
        enum rg_arrival arrival;
    } all[] = {{8, 8, RG_ARRIVED},
               {7, 8, RG_DAMAGED},
               {8, -1, RG_DAMAGED},
               {8, INT64_MAX, RG_DAMAGED},
               {INT64_MAX, 1 << 30, RG_NOT_YET}};
    (void)state;
    for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); i++) {
        const int64_t words[] = {all[i].told_bytes, 7};
        struct rg_channel ours;
        struct rg_message got;
        int theirs[2];
        assert_int_equal(rg_channel_create(&ours, theirs), 0);
        ours.most_bytes = all[i].most_bytes;
        assert_int_equal(write(theirs[0], words, sizeof(words)), sizeof(words));
        assert_int_equal(rg_channel_receive(&ours, &got, 10), all[i].arrival);
        assert_int_equal(got.size, all[i].arrival == RG_ARRIVED ? 8 : 0);
        rg_message_free(&got);
        rg_channel_close(&ours);
        close(theirs[0]);
        close(theirs[1]);
    }
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
        cmocka_unit_test(names_are_no_more_than_a_program_has),
        cmocka_unit_test(a_message_is_bounded),
    };
    rg_log_listen(log_last, NULL);
    return cmocka_run_group_tests_name("messages", tests, NULL, NULL);
}
