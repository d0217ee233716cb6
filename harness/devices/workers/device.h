// A device that lives in a worker, as a struct rg_device: what it tells of itself is here, and what
// is done on it goes through sessions (harness/frames/session.h).
#ifndef RG_HARNESS_DEVICES_WORKERS_DEVICE_H
#define RG_HARNESS_DEVICES_WORKERS_DEVICE_H

#include "core/device/device.h"
#include "harness/devices/workers/worker.h"

// Opens a device in a worker of its own, or in `worker`, which it then owns, where that is not
// NULL. `environment` is as rg_worker_create takes it. `full` is the device's name with what
// follows '@'; `name` is what messages and tables call it, where that is another name, or where
// something follows '@'.
// rg_device_close closes it and ends the worker. NULL, and one logged line, on failure, of the kind
// that rg_device_open has, or that ended the worker.
struct rg_device *rg_remote_open(struct rg_worker *worker, const char *name, const char *full,
                                 const char *environment);

// What a worker tells of its device: what it is, and the number of its backend.
struct rg_told_device {
    struct rg_device_info info;
    int backend;
};

// What it tells of a backend: its devices, or why there are none.
struct rg_told_list {
    int count;
    struct rg_device_info infos[RG_MAX_DEVICES];
    enum rg_outcome outcome; // without a device: whether the driver is absent, or fails
    char why[RG_LIST_WHY_SIZE + 16];
};

extern const struct rg_field rg_told_device_fields[], rg_told_list_fields[];

// The memory that the process holds in which a device lives.
int64_t rg_remote_held_bytes(const struct rg_device *device);

// The worker that a device lives in; NULL: it lives in this process.
struct rg_worker *rg_remote_worker(const struct rg_device *device);

#endif
