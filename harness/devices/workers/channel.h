// A channel between the harness and a worker: a socket for messages, and a page that shows what the
// worker does. It ends when the other process does.
//
// Messages pass through the socket as a whole, so that limits on shared memory or file sizes do not
// apply. Nor can anybody change a message while it is received.
#ifndef RG_HARNESS_DEVICES_WORKERS_CHANNEL_H
#define RG_HARNESS_DEVICES_WORKERS_CHANNEL_H

#include "core/base/doing.h"
#include "harness/devices/workers/message.h"

// Zero it except the socket, which is -1: none.
struct rg_channel {
    int socket;
    int patience_ms;         // how long to wait while the receiver takes nothing; -1: forever
    int64_t most_bytes;      // limit of a received message
    struct rg_doing *doing;  // shows what the worker does; owned
    struct rg_message taken; // a message that has partly arrived
    int64_t taken_bytes;     // bytes received of the message and of the size before it
    int64_t taken_size;
};

// Makes the harness's end. `theirs` gets the socket and the page's file for the worker's process,
// -1: none; the caller closes them. Returns 0 or the errno; close the channel in either case.
int rg_channel_create(struct rg_channel *channel, int theirs[2]);
// Makes the worker's end from its descriptors. False on failure.
bool rg_channel_join(struct rg_channel *channel, int socket, int page);
void rg_channel_close(struct rg_channel *channel);

// Sends a message of two parts. False if the other end has ended, or takes nothing (errno is then
// ETIMEDOUT).
bool rg_channel_send(struct rg_channel *channel, const struct rg_message *head,
                     const struct rg_message *body);
// Waits for up to `timeout_ms`, -1: forever, and receives a message, which the caller frees. A
// partial message is kept for the next call. RG_DAMAGED: its size is impossible.
enum rg_arrival { RG_ARRIVED, RG_ENDED, RG_NOT_YET, RG_NO_ROOM, RG_DAMAGED };
enum rg_arrival rg_channel_receive(struct rg_channel *channel, struct rg_message *message,
                                   int timeout_ms);

#endif
