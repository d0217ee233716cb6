// What the harness asks of workers. What a call is given and gives lies with those who make and
// serve it: harness/frames/remote.c and harness/devices/serving/.
#ifndef RG_HARNESS_DEVICES_WORKERS_CALLS_H
#define RG_HARNESS_DEVICES_WORKERS_CALLS_H

enum rg_call {
    RG_CALL_HELLO, // do both speak of the same things (harness/devices/serving/hello.c)? First for
                   // ever, in all builds
    // The device
    RG_CALL_LIST,     // a backend's devices
    RG_CALL_OPEN,     // the one device of this worker
    RG_CALL_CLOSE,    // likewise, and the worker ends
    RG_CALL_PROBE,    // is its arithmetic exact?
    RG_CALL_AUDIT,    // is its clock?
    RG_CALL_CEILINGS, // what it can do at most
    // Sessions
    RG_CALL_SESSION_OPEN,
    RG_CALL_SESSION_CLOSE,
    RG_CALL_STEP,
    RG_CALL_DRAW,
    RG_CALL_SYNC,
    RG_CALL_FRAMES,
    RG_CALL_COUNT,
    RG_CALL_STAGES,
    RG_CALL_TIME,
    RG_CALL_CODE,
    RG_CALL_READ,
    RG_CALL_TELL,
    RG_CALL_READ_STATE,
    RG_CALL_OBEYS,
    RG_CALL_TEXTURE,
    RG_CALL_DIGESTS,
    RG_CALL_CONTENTS,
    RG_CALL_DISPATCHES,
    RG_CALL_DISPATCH,
    RG_CALL_KERNEL_CODE,
    RG_CALL_COUNT_OF_CALLS,
};

// What a worker does while it serves a call: "opening the device".
const char *rg_call_doing(enum rg_call call);

#endif
