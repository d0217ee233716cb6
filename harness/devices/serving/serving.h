// What a worker does: it holds one device, with sessions on it, and serves the calls of
// harness/devices/workers/calls.h.
#ifndef RG_HARNESS_DEVICES_SERVING_SERVING_H
#define RG_HARNESS_DEVICES_SERVING_SERVING_H

#include "harness/devices/workers/serve.h"

// By call.
extern rg_service *const rg_services[RG_CALL_COUNT_OF_CALLS];

// Serves as a worker (rg_serve), until the harness ends. Returns the exit status.
int rg_serving(const char *argument);

// The messages that this build takes and gives, as a text for rg_workers.hello: builds that have
// the same understand each other.
const char *rg_serving_hello(void);

#endif
