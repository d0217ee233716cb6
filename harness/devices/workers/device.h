// A device that lives in a worker, as a struct rg_device: what it tells of itself is here, and what
// is done on it goes through sessions (harness/frames/session.h).
#ifndef RG_HARNESS_DEVICES_WORKERS_DEVICE_H
#define RG_HARNESS_DEVICES_WORKERS_DEVICE_H

#include "core/device/device.h"
#include "harness/devices/workers/worker.h"

// Opens a device in a worker of its own, or in `worker`, which it then owns, where that is not
// NULL. `environment` is as rg_worker_create takes it; the device's name then is `name`.
// rg_device_close closes it and ends the worker. NULL, and one logged line, on failure, of the kind
// that rg_device_open has, or that ended the worker.
struct rg_device *rg_remote_open(struct rg_worker *worker, const char *name,
                                 const char *environment);

// What a worker tells of its device, with texts that end; false where it cannot be.
bool rg_take_device_info(struct rg_message *message, struct rg_device_info *info);

// The memory that the process holds in which a device lives.
int64_t rg_remote_held_bytes(const struct rg_device *device);

// The worker that a device lives in; NULL: it lives in this process.
struct rg_worker *rg_remote_worker(const struct rg_device *device);

#endif
