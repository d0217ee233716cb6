// A device in a worker, as a struct rg_device: it has the device's description, and sessions
// (harness/devices/frames/session.h) do the work.
#ifndef RG_HARNESS_DEVICES_WORKERS_DEVICE_H
#define RG_HARNESS_DEVICES_WORKERS_DEVICE_H

#include "core/device/device.h"
#include "harness/devices/workers/worker.h"

// Opens a device in its own worker, or in `worker`, which it then owns, if that is not NULL.
// `environment` is as for rg_worker_create. `full` is the device's name including '@' and what
// follows; `name` is the name in messages and tables, if another. rg_device_close closes it and
// ends the worker. NULL, and one logged line, on failure, with rg_device_open's kind of error, or
// the kind that ended the worker.
struct rg_device *rg_remote_open(struct rg_worker *worker, const char *name, const char *full,
                                 const char *environment);

// A worker's description of its device, and its backend's number.
struct rg_told_device {
    struct rg_device_info info;
    int backend;
};

// A worker's description of a backend: its devices, or why there are none.
struct rg_told_list {
    int count;
    struct rg_device_info infos[RG_MAX_DEVICES];
    enum rg_outcome outcome; // without devices: whether the driver is absent, or fails
    char why[RG_LIST_WHY_SIZE + 16];
};

extern const struct rg_field rg_told_device_fields[], rg_told_list_fields[];

// The resident memory of the device's process.
int64_t rg_remote_held_bytes(const struct rg_device *device);

// The worker of a device; NULL: the device is in this process.
struct rg_worker *rg_remote_worker(const struct rg_device *device);

#endif
