// A channel between the harness and a worker: a socket that carries messages, and a page that says
// what the worker does. It ends when the process at its other end does.
//
// Messages pass through the socket whole. So no limit on shared memory or on the sizes of files
// holds for them, and nobody changes a message while it is taken.
#ifndef RG_HARNESS_DEVICES_WORKERS_CHANNEL_H
#define RG_HARNESS_DEVICES_WORKERS_CHANNEL_H

#include "core/base/doing.h"
#include "harness/devices/workers/message.h"

// Zeroed but for the socket, which is -1: none.
struct rg_channel {
    int socket;
    int patience_ms;         // of one who sends, while the other takes nothing; -1: without end
    int64_t most_bytes;      // of a message that is taken
    struct rg_doing *doing;  // what the worker does; owned
    struct rg_message taken; // of which a part has come
    int64_t taken_bytes;     // of it, and of its size before it
    int64_t taken_size;
};

// Makes the harness's end. `theirs` gets the socket and the page's file that the worker's process
// is started with, which the caller closes; -1: none. 0, or the errno; to be closed in either case.
int rg_channel_create(struct rg_channel *channel, int theirs[2]);
// The worker's end, of what it was started with. False on failure.
bool rg_channel_join(struct rg_channel *channel, int socket, int page);
void rg_channel_close(struct rg_channel *channel);

// Sends a message of two parts, whole. False where the other end has ended, or, with ETIMEDOUT as
// errno, takes nothing.
bool rg_channel_send(struct rg_channel *channel, const struct rg_message *head,
                     const struct rg_message *body);
// Waits for up to `timeout_ms`, -1 for as long as it takes, and takes a message, which the caller
// frees. What has come of one that is not whole is kept for the next time. RG_DAMAGED: its size
// cannot be.
enum rg_arrival { RG_ARRIVED, RG_ENDED, RG_NOT_YET, RG_NO_ROOM, RG_DAMAGED };
enum rg_arrival rg_channel_receive(struct rg_channel *channel, struct rg_message *message,
                                   int timeout_ms);

#endif
