// A channel between the harness and a worker: messages lie in memory that both share, and a socket
// says when one is there. It ends when the process at its other end does.
#ifndef RG_HARNESS_DEVICES_WORKERS_CHANNEL_H
#define RG_HARNESS_DEVICES_WORKERS_CHANNEL_H

#include "core/base/doing.h"
#include "harness/devices/workers/message.h"
#include "harness/devices/workers/segment.h"

// Zeroed but for the socket, which is -1: none.
struct rg_channel {
    int socket;
    struct rg_segment doing; // a struct rg_doing: what the worker does
    struct rg_segment sent;  // of this process: its last message
    struct rg_segment taken; // of the other
    int64_t most_bytes;      // that a message of the other may have; 0: as many as there are
    double patience_ms;      // how long one may take to be copied; 0: as long as that lasts
};

// Makes the harness's end. `theirs` gets the socket that the worker's process is started with,
// which the caller closes; it joins with doing.id. 0, or the errno; to be closed in either case.
int rg_channel_create(struct rg_channel *channel, int *theirs);
// The worker's end. False on failure.
bool rg_channel_join(struct rg_channel *channel, int socket, int doing_id);
void rg_channel_close(struct rg_channel *channel);

// Sends a message of two parts, whole. False where the other end has ended, or there is no memory.
bool rg_channel_send(struct rg_channel *channel, const struct rg_message *head,
                     const struct rg_message *body);
// Waits for up to `timeout_ms`, -1 for as long as it takes, and takes a message, which the caller
// frees. RG_DAMAGED: the other end said that there is one, and there is none that can be taken.
enum rg_arrival { RG_ARRIVED, RG_ENDED, RG_NOT_YET, RG_DAMAGED };
enum rg_arrival rg_channel_receive(struct rg_channel *channel, struct rg_message *message,
                                   int timeout_ms);

#endif
