// Calls about a session or a run, by where the instance lives: here they are functions, and of a
// worker they are asked by messages, of which this has the fields. Only files of this folder, and
// those that serve the calls (harness/measure/serving/), may include this: all others go through
// session.h and digests.h.
#ifndef RG_HARNESS_DEVICES_FRAMES_CALLING_H
#define RG_HARNESS_DEVICES_FRAMES_CALLING_H

#include "harness/devices/workers/calls.h"
#include "harness/devices/workers/fields.h"
#include "harness/devices/frames/session.h"

struct rg_session {
    struct rg_device *device;
    const struct rg_technique *technique;
    int width, height; // pixels
    int state_count;
    struct rg_instance *instance; // in this process
    int number, life;             // in a worker: its number there, and in which of its lives
};

// One of RG_SESSION_CALLS or RG_RUN_CALLS. What does it in this process has one of the two forms,
// of which a reply is zeroed before or what the caller has had; it returns false, with one logged
// line, on failure.
struct rg_frame_call {
    bool (*of_session)(struct rg_session *session, const void *request, void *reply);
    bool (*of_run)(struct rg_device *device, const void *request, void *reply);
    const struct rg_field *request, *reply; // NULL: nothing
    size_t request_size, reply_size;
};
extern const struct rg_frame_call rg_frame_calls[RG_CALL_COUNT_OF_CALLS];

// Does a call, here or in the device's worker. The caller frees what the reply has got in either
// case. False, with one logged line, on failure.
bool rg_session_ask(const struct rg_session *session, enum rg_call call, const void *request,
                    void *reply);
bool rg_run_ask(struct rg_device *device, enum rg_call call, const void *request, void *reply);

// Opens a session of which all but its device, technique and size is still to be set, and closes
// it: whose instance lives in a worker.
bool rg_remote_session_open(struct rg_session *session, const struct rg_subject *subject);
void rg_remote_session_close(struct rg_session *session);

#endif
