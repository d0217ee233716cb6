// The channel between the harness and a worker: messages pass as a whole, whatever parts they
// arrive in, and its end is seen.
#define _GNU_SOURCE // ppoll
#include "harness/devices/workers/channel.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "core/base/log.h"

enum { SOON_MS = 5 };

// --- stand-ins ---

// How many of the next calls of each kind a signal interrupts, and the error of a call that fails.
static int interrupted_sends, interrupted_receipts, interrupted_waits;
static int broken_receipt;

ssize_t send(int socket, const void *bytes, size_t size, int flags)
{
    if (interrupted_sends > 0)
        return interrupted_sends--, errno = EINTR, -1;
    return sendto(socket, bytes, size, flags, NULL, 0);
}

ssize_t recv(int socket, void *bytes, size_t size, int flags)
{
    if (interrupted_receipts > 0)
        return interrupted_receipts--, errno = EINTR, -1;
    if (broken_receipt)
        return errno = broken_receipt, -1;
    return recvfrom(socket, bytes, size, flags, NULL, NULL);
}

int poll(struct pollfd *waited, nfds_t count, int timeout_ms)
{
    const struct timespec timeout = {timeout_ms / 1000, timeout_ms % 1000 * 1000000L};
    if (interrupted_waits > 0)
        return interrupted_waits--, errno = EINTR, -1;
    return ppoll(waited, count, timeout_ms < 0 ? NULL : &timeout, NULL);
}

// --- the tests' own ---

// Both ends, in this process.
struct pair {
    struct rg_channel ours, theirs;
};

static struct pair open_pair(void)
{
    struct pair pair;
    int theirs[2];
    assert_int_equal(rg_channel_create(&pair.ours, theirs), 0);
    assert_true(rg_channel_join(&pair.theirs, theirs[0], theirs[1]));
    pair.ours.most_bytes = INT64_C(1) << 30;
    pair.ours.patience_ms = pair.theirs.patience_ms = 1000;
    return pair;
}

static void close_pair(struct pair *pair)
{
    rg_channel_close(&pair->ours);
    rg_channel_close(&pair->theirs);
}

static bool send_text(struct rg_channel *channel, const char *head, const char *body)
{
    struct rg_message both[2] = {{0}, {0}};
    rg_put(&both[0], head, (int64_t)strlen(head));
    rg_put(&both[1], body, (int64_t)strlen(body));
    const bool ok = rg_channel_send(channel, &both[0], &both[1]);
    const int error = errno;
    rg_message_free(&both[0]);
    rg_message_free(&both[1]);
    errno = error;
    return ok;
}

static void expect(struct rg_channel *channel, const char *text)
{
    struct rg_message got;
    assert_int_equal(rg_channel_receive(channel, &got, SOON_MS), RG_ARRIVED);
    assert_int_equal(got.size, strlen(text));
    if (*text)
        assert_memory_equal(got.bytes, text, strlen(text));
    assert_int_equal(got.at, 0);
    assert_false(got.failed);
    rg_message_free(&got);
}

static void expect_none(struct rg_channel *channel, enum rg_arrival arrival)
{
    struct rg_message got;
    assert_int_equal(rg_channel_receive(channel, &got, SOON_MS), arrival);
    assert_null(got.bytes);
    assert_int_equal(got.size, 0);
}

static void messages_pass_both_ways_in_order(void **state)
{
    (void)state;
    struct pair pair = open_pair();
    expect_none(&pair.ours, RG_NOT_YET);
    assert_true(send_text(&pair.ours, "head, ", "body"));
    assert_true(send_text(&pair.ours, "", "body alone"));
    assert_true(send_text(&pair.ours, "", ""));
    assert_true(send_text(&pair.ours, "head alone", ""));
    assert_true(send_text(&pair.theirs, "reply", ""));
    expect(&pair.theirs, "head, body");
    expect(&pair.theirs, "body alone");
    expect(&pair.theirs, "");
    expect(&pair.theirs, "head alone");
    expect_none(&pair.theirs, RG_NOT_YET);
    expect(&pair.ours, "reply");
    close_pair(&pair);
}

// Bytes come one after the other, from two messages.
static void a_part_waits_for_the_rest(void **state)
{
    (void)state;
    struct pair pair = open_pair();
    for (int message = 0; message < 2; message++) {
        char bytes[sizeof(int64_t) + 5];
        const int64_t size = 5;
        memcpy(bytes, &size, sizeof(size));
        memcpy(bytes + sizeof(size), message ? "later" : "first", 5);
        for (size_t i = 0; i < sizeof(bytes); i++) {
            expect_none(&pair.ours, RG_NOT_YET);
            assert_int_equal(write(pair.theirs.socket, bytes + i, 1), 1);
        }
        expect(&pair.ours, message ? "later" : "first");
    }
    close_pair(&pair);
}

static void a_large_message_grows_as_it_comes(void **state)
{
    (void)state;
    enum { BYTES = 100000 }; // more than the room at first, and no multiple of it
    struct pair pair = open_pair();
    char *text = malloc(BYTES + 1);
    for (int i = 0; i < BYTES; i++)
        text[i] = (char)('a' + i % 23);
    text[BYTES] = 0;
    assert_true(send_text(&pair.theirs, "", text));
    expect(&pair.ours, text);
    free(text);
    close_pair(&pair);
}

static void an_end_is_seen(void **state)
{
    (void)state;
    struct pair pair = open_pair();
    assert_true(send_text(&pair.theirs, "last", ""));
    rg_channel_close(&pair.theirs);
    assert_int_equal(pair.theirs.socket, -1);
    assert_null(pair.theirs.doing);
    rg_channel_close(&pair.theirs); // again
    expect(&pair.ours, "last");
    expect_none(&pair.ours, RG_ENDED);
    errno = 0;
    assert_false(send_text(&pair.ours, "to nobody", ""));
    assert_int_not_equal(errno, ETIMEDOUT);
    close_pair(&pair);
}

static void nobody_waits_for_ever_for_a_receiver(void **state)
{
    (void)state;
    struct pair pair = open_pair();
    char *text = malloc((8 << 20) + 1);
    memset(text, 'x', 8 << 20);
    text[8 << 20] = 0;
    pair.ours.patience_ms = SOON_MS;
    assert_false(send_text(&pair.ours, "", text));
    assert_int_equal(errno, ETIMEDOUT);
    free(text);
    close_pair(&pair);
}

static void a_message_that_failed_is_not_sent(void **state)
{
    (void)state;
    struct pair pair = open_pair();
    const struct rg_message well = {0}, failed = {.failed = true};
    assert_false(rg_channel_send(&pair.ours, &failed, &well));
    assert_false(rg_channel_send(&pair.ours, &well, &failed));
    expect_none(&pair.theirs, RG_NOT_YET);
    assert_true(rg_channel_send(&pair.ours, &well, &well));
    expect(&pair.theirs, "");
    close_pair(&pair);
}

// A message that has partly arrived goes with its channel.
static void what_the_worker_does_is_seen(void **state)
{
    (void)state;
    struct pair pair = open_pair();
    const int64_t sizes[] = {100, 7};
    assert_int_equal(atomic_load(&pair.ours.doing->count), 0);
    strcpy(pair.theirs.doing->what, "waiting");
    atomic_store(&pair.theirs.doing->count, 3);
    assert_int_equal(atomic_load(&pair.ours.doing->count), 3);
    assert_string_equal(pair.ours.doing->what, "waiting");
    assert_int_equal(write(pair.theirs.socket, sizes, sizeof(sizes)), sizeof(sizes));
    expect_none(&pair.ours, RG_NOT_YET);
    rg_channel_close(&pair.ours);
    assert_null(pair.ours.taken.bytes);
    assert_int_equal(pair.ours.taken_bytes, 0);
    close_pair(&pair);
}

// A signal during a call is no end: the call is made again, or, where it waits, the caller looks
// whether the signal asks for something.
static void a_signal_is_no_end(void **state)
{
    (void)state;
    struct pair pair = open_pair();
    interrupted_sends = 3;
    assert_true(send_text(&pair.theirs, "whole", ""));
    assert_int_equal(interrupted_sends, 0);
    interrupted_waits = 2;
    expect_none(&pair.ours, RG_NOT_YET);
    expect_none(&pair.ours, RG_NOT_YET);
    assert_int_equal(interrupted_waits, 0);
    interrupted_receipts = 3;
    expect(&pair.ours, "whole");
    assert_int_equal(interrupted_receipts, 0);
    assert_true(send_text(&pair.theirs, "lost", ""));
    broken_receipt = ECONNRESET;
    expect_none(&pair.ours, RG_ENDED);
    broken_receipt = 0;
    close_pair(&pair);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(messages_pass_both_ways_in_order),
        cmocka_unit_test(a_part_waits_for_the_rest),
        cmocka_unit_test(a_large_message_grows_as_it_comes),
        cmocka_unit_test(an_end_is_seen),
        cmocka_unit_test(nobody_waits_for_ever_for_a_receiver),
        cmocka_unit_test(a_message_that_failed_is_not_sent),
        cmocka_unit_test(what_the_worker_does_is_seen),
        cmocka_unit_test(a_signal_is_no_end),
    };
    return cmocka_run_group_tests_name("channels", tests, NULL, NULL);
}
