// What a worker does: it holds one device, with sessions on it, and serves the calls of
// harness/devices/workers/calls.h.
#ifndef RG_HARNESS_DEVICES_SERVING_SERVING_H
#define RG_HARNESS_DEVICES_SERVING_SERVING_H

// Serves as a worker (rg_serve), until the harness ends. Returns the exit status.
int rg_serving(const char *argument);

#endif
