// A worker's main part: it holds one device with sessions on it, and serves the calls of
// harness/devices/workers/calls.h.
#ifndef RG_HARNESS_DEVICES_MEASURE_SERVING_SERVING_H
#define RG_HARNESS_DEVICES_MEASURE_SERVING_SERVING_H

#include "harness/devices/workers/serve.h"

// The services by call.
extern rg_service *const rg_services[RG_CALL_COUNT_OF_CALLS];

// Serves as a worker (rg_serve) until the harness ends. Returns the exit status.
int rg_serving(const char *argument);

// A description of the messages that this build understands, for rg_workers.hello: builds with
// equal texts are compatible.
const char *rg_serving_hello(void);

#endif
