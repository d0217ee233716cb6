// The checked device: every call of a backend goes through core/device.
//
// It checks all arguments and refuses with one logged line that names the object and the number;
// splits runs that exceed a device's work-group limits; counts work; and finds what was not
// destroyed. This header has devices, and includes what is done on them: objects.h, buffers and
// images; pass.h, runs of kernels; work.h, the counts.
#ifndef RG_CORE_DEVICE_DEVICE_H
#define RG_CORE_DEVICE_DEVICE_H

#include "backends/backend.h"
#include "core/base/outcome.h"
#include "core/device/objects.h"
#include "core/device/pass.h"
#include "core/device/work.h"

// Backends' devices, or why there is none. Quiet, but for a warning of a driver that fails beside
// others.
struct rg_device_list {
    int count;
    struct rg_device_info infos[RG_MAX_DEVICES];
    int backend_index[RG_MAX_DEVICES]; // what backend->create takes
    const struct rg_backend *backends[RG_MAX_DEVICES];
    int missing_count; // backends without a device
    struct rg_missing {
        const struct rg_backend *backend;
        enum rg_outcome outcome;         // unsupported, or how its driver failed when it was asked
        char why[RG_LIST_WHY_SIZE + 16]; // one line, which begins with the backend's name
    } missing[RG_MAX_BACKENDS];
};
void rg_device_list_all(struct rg_device_list *list);
// Adds one backend's to a list that began zeroed; each backend once.
void rg_device_list_add(struct rg_device_list *list, const struct rg_backend *backend);

// Opens a device by name: "cpu", "cpu:reference", "gl", "gl:1", "vulkan:NVIDIA" (an index, or a
// part of the device's name, case ignored). NULL, and one logged line, on failure: the user's error
// where there is no such name, unsupported where the driver is absent, the driver's where it fails.
struct rg_device *rg_device_open(const char *name);
// Waits, reports what still lives on it as an error, and closes it. Returns false on a leak.
bool rg_device_close(struct rg_device *device);

// What was done on the device so far; it stays the device's.
const struct rg_work *rg_device_work(const struct rg_device *device);

// Waits until all that was asked for has been done. False, and one logged line, if some of it
// failed.
bool rg_device_sync(struct rg_device *device);
// The API's own clock, in nanoseconds from an arbitrary start, after the same wait. False, and one
// logged line, on failure, and unsupported where the device has no clock.
bool rg_device_time(struct rg_device *device, int64_t *time_ns);

// Finds what something needs that is opened on the device between the two, and closed before the
// second: `room` is RG_ROOM_COUNTED, or RG_ROOM_WATCHED to take it unless it is a quarter of what
// is left, or a GiB. Nothing is logged while objects are counted.
void rg_room_begin(struct rg_device *device, enum rg_room room);
// The bytes that buffers and images took together at most, or would have taken, on the device since
// the first; `is_taken` says whether all were made.
int64_t rg_room_end(struct rg_device *device, bool *is_taken);

// Has each run watched from here on; NULL: no longer. Buffers that pack draws are made anew, so
// that they are no larger than the draws that follow want. `watch` lives until then.
void rg_device_watch(struct rg_device *device, const struct rg_watch *watch);

// The tier that pictures of two devices must hold, in either order: the looser of theirs, for what
// one of them may differ by from cpu:reference it may differ by from the other.
enum rg_tier rg_tier_owed(const struct rg_device_info *a, const struct rg_device_info *b);

#endif
