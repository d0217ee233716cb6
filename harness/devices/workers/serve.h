// The worker's side: it serves one call after the other, until the harness ends.
#ifndef RG_HARNESS_DEVICES_WORKERS_SERVE_H
#define RG_HARNESS_DEVICES_WORKERS_SERVE_H

#include "harness/devices/workers/calls.h"
#include "harness/devices/workers/message.h"

// Serves a call: takes the request, puts what comes of it into the reply. False, with one logged
// line, on failure; what it has put is not sent then.
typedef bool rg_service(struct rg_message *request, struct rg_message *reply);

// Serves what it is asked by the process that started this one as a worker, until that ends or asks
// it to close. Returns the exit status. `argument` is what follows RG_WORKER_ARGUMENT;
// `services` are by call, NULL: not served.
int rg_serve(const char *argument, rg_service *const services[RG_CALL_COUNT_OF_CALLS]);

#endif
