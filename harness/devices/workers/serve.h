// The worker's side: serves one call after the other, until the harness ends.
#ifndef RG_HARNESS_DEVICES_WORKERS_SERVE_H
#define RG_HARNESS_DEVICES_WORKERS_SERVE_H

#include "harness/devices/workers/calls.h"
#include "harness/devices/workers/message.h"

// Serves a call: takes the request, and puts the result into the reply. False, with one logged
// line, on failure; the reply's content is then not sent.
typedef bool rg_service(struct rg_message *request, struct rg_message *reply);

// Serves the calls of the process that started this one, until that ends or closes. Returns the
// exit status. `argument` is what follows RG_WORKER_ARGUMENT; `services` are by call, NULL: not
// served.
int rg_serve(const char *argument, rg_service *const services[RG_CALL_COUNT_OF_CALLS]);

#endif
