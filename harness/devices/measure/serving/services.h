// The services of a worker, by subject. Only files of this folder include it.
#ifndef RG_HARNESS_DEVICES_MEASURE_SERVING_SERVICES_H
#define RG_HARNESS_DEVICES_MEASURE_SERVING_SERVICES_H

#include "core/device/device.h"
#include "harness/devices/workers/serve.h"

// The worker's device, which is opened on first use; `name` may include an environment. NULL, and
// one logged line, on failure.
struct rg_device *rg_served_device(const char *name);
bool rg_served_device_close(void);
// Closes every session.
void rg_served_sessions_close(void);

// A service for each call of the list: rg_serve_hello and so on.
#define RG_SERVICE(name, service, doing) rg_service rg_serve_##service;
RG_CALLS(RG_SERVICE)

#endif
