// The calls about a session or a run: functions if the instance lives in this process, else
// messages to its worker, with the fields listed here. Only files of this folder, and those that
// serve the calls (harness/devices/measure/serving/), may include this; all others use session.h
// and digests.h.
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

// A call of RG_SESSION_CALLS or RG_RUN_CALLS. One of the two functions does it in this process, and
// returns false, with one logged line, on failure. `reply` begins zeroed or is the caller's struct.
struct rg_frame_call {
    bool (*of_session)(struct rg_session *session, const void *request, void *reply);
    bool (*of_run)(struct rg_device *device, const void *request, void *reply);
    const struct rg_field *request, *reply; // NULL: nothing
    size_t request_size, reply_size;
};
extern const struct rg_frame_call rg_frame_calls[RG_CALL_COUNT_OF_CALLS];

// Does a call, here or in the device's worker. The caller frees what `reply` has, in either case.
// False, with one logged line, on failure.
bool rg_session_ask(const struct rg_session *session, enum rg_call call, const void *request,
                    void *reply);
bool rg_run_ask(struct rg_device *device, enum rg_call call, const void *request, void *reply);

// Opens and closes a session whose instance lives in a worker. Only the session's device, technique
// and size are set before.
bool rg_remote_session_open(struct rg_session *session, const struct rg_subject *subject);
void rg_remote_session_close(struct rg_session *session);

#endif
