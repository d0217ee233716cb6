#define _GNU_SOURCE // SOCK_CLOEXEC
#include "harness/devices/workers/channel.h"

#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/base/files/nameless.h"

// --- the page ---

// Maps the page from a file, or as private memory if there is none. A private page shows nobody
// what the worker does; the time without progress then counts from its last message.
static struct rg_doing *map(int page)
{
    const int shared = page < 0 ? MAP_PRIVATE | MAP_ANONYMOUS : MAP_SHARED;
    void *bytes = mmap(NULL, sizeof(struct rg_doing), PROT_READ | PROT_WRITE, shared, page, 0);
    return bytes != MAP_FAILED ? bytes : page < 0 ? NULL : map(-1);
}

// Makes the page's file; -1 on failure, as with ulimit -f 0. Writes zeros up to the page's size,
// because no filter of system calls refuses a write.
static int make_page(void)
{
    static const char zeros[sizeof(struct rg_doing)];
    char why[RG_NAMELESS_WHY];
    const int page = rg_file_nameless(why);
    if (page < 0 || write(page, zeros, sizeof(zeros)) == sizeof(zeros))
        return page;
    close(page);
    return -1;
}

// --- opening and closing ---

int rg_channel_create(struct rg_channel *channel, int theirs[2])
{
    int sockets[2];
    *channel = (struct rg_channel){.socket = -1};
    theirs[0] = theirs[1] = -1;
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets))
        return errno;
    channel->socket = sockets[0];
    theirs[0] = sockets[1];
    theirs[1] = make_page();
    channel->doing = map(theirs[1]);
    return channel->doing ? 0 : errno;
}

bool rg_channel_join(struct rg_channel *channel, int socket, int page)
{
    *channel = (struct rg_channel){
        .socket = socket, .patience_ms = -1, .most_bytes = INT64_MAX, .doing = map(page)};
    close(page);
    return channel->doing;
}

void rg_channel_close(struct rg_channel *channel)
{
    if (channel->doing)
        munmap(channel->doing, sizeof(*channel->doing));
    channel->doing = NULL;
    rg_message_free(&channel->taken);
    channel->taken_bytes = 0;
    if (channel->socket >= 0)
        close(channel->socket);
    channel->socket = -1;
}

// --- sending ---

static bool send_bytes(const struct rg_channel *channel, const void *bytes, int64_t size)
{
    for (const char *at = bytes, *end = at + size; at < end;) {
        struct pollfd ready = {.fd = channel->socket, .events = POLLOUT};
        const ssize_t sent =
            send(channel->socket, at, (size_t)(end - at), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent > 0)
            at += sent;
        else if (errno == EAGAIN && !poll(&ready, 1, channel->patience_ms))
            return errno = ETIMEDOUT, false;
        else if (errno != EAGAIN && errno != EINTR)
            return false;
    }
    return true;
}

bool rg_channel_send(struct rg_channel *channel, const struct rg_message *head,
                     const struct rg_message *body)
{
    const int64_t size = head->size + body->size;
    return !head->failed && !body->failed && send_bytes(channel, &size, sizeof(size)) &&
           send_bytes(channel, head->bytes, head->size) &&
           send_bytes(channel, body->bytes, body->size);
}

// --- receiving ---

// Grows a message's memory, at most to twice the received size, because the announced size may be
// false.
static bool make_room(struct rg_channel *channel)
{
    enum { LEAST_BYTES = 1 << 16 };
    struct rg_message *taken = &channel->taken;
    if (taken->size < taken->room)
        return true;
    int64_t room = taken->room ? 2 * taken->room : LEAST_BYTES;
    if (room > channel->taken_size)
        room = channel->taken_size;
    char *bytes = realloc(taken->bytes, (size_t)room + 1);
    if (!bytes)
        return false;
    taken->bytes = bytes;
    taken->room = room;
    return true;
}

// Receives available bytes, starting with the message's size. Returns the kernel's result.
static ssize_t take(struct rg_channel *channel)
{
    struct rg_message *taken = &channel->taken;
    const int64_t before = (int64_t)sizeof(channel->taken_size);
    const bool is_size = channel->taken_bytes < before;
    void *to =
        is_size ? (char *)&channel->taken_size + channel->taken_bytes : taken->bytes + taken->size;
    const int64_t most = is_size ? before - channel->taken_bytes : taken->room - taken->size;
    const ssize_t got = recv(channel->socket, to, (size_t)most, MSG_DONTWAIT);
    if (got > 0)
        channel->taken_bytes += got;
    if (got > 0 && !is_size)
        taken->size += got;
    return got;
}

// How much of the message has arrived. Its size comes from a process that a driver may have
// damaged.
static enum rg_arrival look(struct rg_channel *channel)
{
    if (channel->taken_bytes < (int64_t)sizeof(channel->taken_size))
        return RG_NOT_YET;
    if (channel->taken_size < 0 || channel->taken_size > channel->most_bytes)
        return RG_DAMAGED;
    if (channel->taken.size == channel->taken_size && channel->taken.bytes)
        return RG_ARRIVED;
    if (!make_room(channel))
        return RG_NO_ROOM;
    return channel->taken_size ? RG_NOT_YET : RG_ARRIVED;
}

enum rg_arrival rg_channel_receive(struct rg_channel *channel, struct rg_message *message,
                                   int timeout_ms)
{
    struct pollfd waited = {.fd = channel->socket, .events = POLLIN};
    enum rg_arrival arrival = RG_NOT_YET;
    *message = (struct rg_message){0};
    while (arrival == RG_NOT_YET) {
        const int ready = poll(&waited, 1, timeout_ms);
        if (ready == 0 || (ready < 0 && errno == EINTR))
            return RG_NOT_YET;
        const ssize_t got = ready < 0 ? 0 : take(channel);
        if (got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN))
            return RG_ENDED;
        arrival = look(channel);
    }
    if (arrival == RG_ARRIVED) {
        *message = channel->taken;
        channel->taken = (struct rg_message){0};
        channel->taken_bytes = 0;
    }
    return arrival;
}
