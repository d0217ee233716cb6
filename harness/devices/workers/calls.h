// The calls from the harness to workers: one list, with each call's service
// (harness/devices/measure/serving/) and the worker's activity during it. Tables of fields, used by
// both sides, describe requests and replies (harness/devices/frames/messages.h,
// harness/devices/measure/serving/messages.h, harness/devices/workers/device.h).
#ifndef RG_HARNESS_DEVICES_WORKERS_CALLS_H
#define RG_HARNESS_DEVICES_WORKERS_CALLS_H

// Calls about an open session (harness/devices/frames/local.c does them).
#define RG_SESSION_CALLS(CALL)                                                                     \
    CALL(STEP, step, "simulating a frame")                                                         \
    CALL(DRAW, draw, "drawing a frame")                                                            \
    CALL(SYNC, sync, "waiting for the device")                                                     \
    CALL(FRAMES, frames, "simulating and drawing frames")                                          \
    CALL(COUNT, count, "counting a frame's work")                                                  \
    CALL(STAGES, stages, "timing a frame's passes")                                                \
    CALL(TIME, time, "asking for the device's time")                                               \
    CALL(CODE, code, "telling of its code")                                                        \
    CALL(READ, read, "reading the picture")                                                        \
    CALL(TELL, tell, "telling of a technique")                                                     \
    CALL(READ_STATE, read_state, "reading the state")                                              \
    CALL(OBEYS, obeys, "checking a law")                                                           \
    CALL(TEXTURE, texture, "telling of a texture")
// Calls about runs on a device, and about kernels, without a session (likewise).
#define RG_RUN_CALLS(CALL)                                                                         \
    CALL(DIGESTS, digests, "digesting stages")                                                     \
    CALL(CONTENTS, contents, "reading an asset")                                                   \
    CALL(DISPATCHES, dispatches, "keeping a stage's dispatches")                                   \
    CALL(DISPATCH, dispatch, "running a kernel alone")                                             \
    CALL(KERNEL_CODE, kernel_code, "reading a kernel's code")                                      \
    CALL(COMPILE, compile, "compiling a kernel")

// HELLO asks whether both processes use the same messages
// (harness/devices/measure/serving/hello.c); it stays first for ever, in all builds. LIST is about
// a backend's devices, LOAD about libraries that a device's name names. OPEN to FIXED are about
// this worker's one device; the worker ends after CLOSE. The rest are about sessions and runs.
#define RG_CALLS(CALL)                                                                             \
    CALL(HELLO, hello, "greeting")                                                                 \
    CALL(LIST, list, "listing devices")                                                            \
    CALL(LOAD, load, "loading the driver")                                                         \
    CALL(OPEN, open, "opening the device")                                                         \
    CALL(CLOSE, close, "closing the device")                                                       \
    CALL(PROBE, probe, "probing its arithmetic")                                                   \
    CALL(DRAWING, drawing, "drawing into each format")                                             \
    CALL(AUDIT, audit, "auditing its timer")                                                       \
    CALL(CEILINGS, ceilings, "measuring its ceilings")                                             \
    CALL(FIXED, fixed, "drawing a fixed function")                                                 \
    CALL(SESSION_OPEN, session_open, "opening a technique")                                        \
    CALL(SESSION_CLOSE, session_close, "closing a technique")                                      \
    RG_SESSION_CALLS(CALL)                                                                         \
    RG_RUN_CALLS(CALL)

#define RG_CALL_NUMBER(name, service, doing) RG_CALL_##name,
enum rg_call { RG_CALLS(RG_CALL_NUMBER) RG_CALL_COUNT_OF_CALLS };

// The worker's activity during a call: "opening the device".
const char *rg_call_doing(enum rg_call call);

#endif
