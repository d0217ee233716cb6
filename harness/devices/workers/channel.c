#define _GNU_SOURCE // SOCK_CLOEXEC
#include "harness/devices/workers/channel.h"

#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "harness/console/clock.h"

enum { LEAST_BYTES = 1 << 16 }; // of a segment for messages
enum { PIECE_BYTES = 1 << 26 }; // are copied between two looks at the clock

// What the socket carries: where the message is.
struct notice {
    int64_t size;
    int segment, unused; // so that no byte of it is left unset
};

int rg_channel_create(struct rg_channel *channel, int *theirs)
{
    int sockets[2];
    *channel = (struct rg_channel){.socket = -1};
    *theirs = -1;
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets))
        return errno;
    channel->socket = sockets[0];
    *theirs = sockets[1];
    return rg_segment_create(&channel->doing, sizeof(struct rg_doing));
}

bool rg_channel_join(struct rg_channel *channel, int socket, int doing_id)
{
    *channel = (struct rg_channel){.socket = socket};
    return rg_segment_join(&channel->doing, doing_id) &&
           channel->doing.size >= (int64_t)sizeof(struct rg_doing);
}

void rg_channel_close(struct rg_channel *channel)
{
    rg_segment_free(&channel->doing);
    rg_segment_free(&channel->sent);
    rg_segment_free(&channel->taken);
    if (channel->socket >= 0)
        close(channel->socket);
    channel->socket = -1;
}

// Room for messages of this size and for ones that are not much larger.
static bool make_room(struct rg_segment *segment, int64_t size)
{
    if (size <= segment->size)
        return true;
    int64_t room = LEAST_BYTES;
    while (room < size)
        room += room / 2;
    return !rg_segment_create(segment, room);
}

bool rg_channel_send(struct rg_channel *channel, const struct rg_message *head,
                     const struct rg_message *body)
{
    const int64_t size = head->size + body->size;
    if (head->failed || body->failed || !make_room(&channel->sent, size))
        return false;
    const struct notice notice = {size, channel->sent.id, 0};
    memcpy(channel->sent.bytes, head->bytes, (size_t)head->size);
    if (body->size)
        memcpy((char *)channel->sent.bytes + head->size, body->bytes, (size_t)body->size);
    ssize_t sent;
    do
        sent = send(channel->socket, &notice, sizeof(notice), MSG_NOSIGNAL);
    while (sent < 0 && errno == EINTR);
    return sent == sizeof(notice);
}

// Memory that nobody has written yet is made as it is read, so that a copy takes long which is
// larger than what was sent.
static bool copy(const struct rg_channel *channel, char *to, int64_t size)
{
    const double end_ms = rg_now_ms() + channel->patience_ms;
    for (int64_t at = 0; at < size; at += PIECE_BYTES) {
        const int64_t piece = size - at < PIECE_BYTES ? size - at : PIECE_BYTES;
        memcpy(to + at, (const char *)channel->taken.bytes + at, (size_t)piece);
        if (channel->patience_ms > 0 && rg_now_ms() > end_ms)
            return false;
    }
    return true;
}

// The notice was sent by a process that a driver may have damaged.
static bool take(struct rg_channel *channel, struct rg_message *message,
                 const struct notice *notice)
{
    struct rg_segment *taken = &channel->taken;
    if ((!taken->bytes || taken->id != notice->segment) && !rg_segment_join(taken, notice->segment))
        return false;
    if (notice->size < 0 || notice->size > taken->size ||
        (channel->most_bytes && notice->size > channel->most_bytes))
        return false;
    message->bytes = malloc((size_t)notice->size + 1);
    message->size = message->room = notice->size;
    return message->bytes && copy(channel, message->bytes, notice->size);
}

enum rg_arrival rg_channel_receive(struct rg_channel *channel, struct rg_message *message,
                                   int timeout_ms)
{
    struct pollfd waited = {.fd = channel->socket, .events = POLLIN};
    struct notice notice;
    *message = (struct rg_message){0};
    const int ready = poll(&waited, 1, timeout_ms);
    if (ready == 0 || (ready < 0 && errno == EINTR))
        return RG_NOT_YET;
    const ssize_t got = ready < 0 ? -1 : recv(channel->socket, &notice, sizeof(notice), 0);
    if (got < 0 && errno == EINTR)
        return RG_NOT_YET;
    if (got == sizeof(notice) && take(channel, message, &notice))
        return RG_ARRIVED;
    rg_message_free(message);
    return got > 0 ? RG_DAMAGED : RG_ENDED;
}
