// The checked device: every call of a backend goes through core/device.
//
// It checks all arguments, and refuses bad ones with one logged line that names the object and the
// number. It also splits runs that exceed a device's work-group limits, counts work, and finds
// objects that were not destroyed. This header has devices, and includes their operations:
// objects.h, buffers and images; pass.h, runs of kernels; work.h, the counts.
#ifndef RG_CORE_DEVICE_DEVICE_H
#define RG_CORE_DEVICE_DEVICE_H

#include "backends/backend.h"
#include "core/base/outcome.h"
#include "core/device/objects.h"
#include "core/device/pass.h"
#include "core/device/work.h"

// The devices of the backends, or why there is none. Logs only a warning of a driver that fails
// beside others.
struct rg_device_list {
    int count;
    struct rg_device_info infos[RG_MAX_DEVICES];
    int backend_index[RG_MAX_DEVICES]; // the index that backend->create takes
    const struct rg_backend *backends[RG_MAX_DEVICES];
    int missing_count; // backends without a device
    struct rg_missing {
        const struct rg_backend *backend;
        enum rg_outcome outcome;         // unsupported, or how the driver failed when it was asked
        char why[RG_LIST_WHY_SIZE + 16]; // one line, which begins with the backend's name
    } missing[RG_MAX_BACKENDS];
};
void rg_device_list_all(struct rg_device_list *list);
// Adds one backend's devices to a list that was zeroed at first; call it once for each backend.
void rg_device_list_add(struct rg_device_list *list, const struct rg_backend *backend);

// The backend in a device's name: that of "gl" for "gl:1@LP_NUM_THREADS=1". NULL: none has it.
const struct rg_backend *rg_backend_of(const char *name);

// Opens a device by name: "cpu", "cpu:reference", "gl", "gl:1", "vulkan:NVIDIA" (an index, or a
// part of the device's name, case ignored). With ":native" at its end the device draws through the
// driver's own pipeline (docs/native.md). NULL, and one logged line, on failure: an input error
// for an unknown name, unsupported where the driver is absent, a driver error where it fails.
struct rg_device *rg_device_open(const char *name);
// Waits, logs an error for objects that still live on the device, and closes it. Returns false on a
// leak.
bool rg_device_close(struct rg_device *device);

// Counts of the work done so far; the struct stays the device's.
const struct rg_work *rg_device_work(const struct rg_device *device);

// Waits until the device has done all queued work. False, and one logged line, if some of it
// failed.
bool rg_device_sync(struct rg_device *device);
// Reads the API's clock, in nanoseconds from an arbitrary start, after waiting as rg_device_sync
// does. False, and one logged line, on failure; unsupported where the device has no clock.
bool rg_device_time(struct rg_device *device, int64_t *time_ns);

// Draws once through the driver's own pipeline, and waits. `feature` names the draw in messages.
// False, and one logged line, on failure; unsupported where the API has no fixed functions. What a
// device lacks for this draw alone stands in picture->lacks, and is no failure.
bool rg_device_fixed_draw(struct rg_device *device, const char *feature,
                          const struct rg_fixed_state *state, struct rg_fixed_picture *picture);

// Begins to measure the memory of things that are opened after this call and closed before
// rg_room_end. `room` is RG_ROOM_COUNTED, or RG_ROOM_WATCHED, which takes the memory unless it
// exceeds a quarter of what is left, or a GiB. Nothing is logged while objects are only counted.
void rg_room_begin(struct rg_device *device, enum rg_room room);
// Ends it, and returns the peak in bytes that buffers and images took, or would have taken, since
// rg_room_begin. `is_taken` says whether all of them were really made.
int64_t rg_room_end(struct rg_device *device, bool *is_taken);

// Calls `watch` before and after each run from here on; NULL ends that. Packing buffers are made
// anew, so that they are no larger than the next draws need. `watch` must live until then.
void rg_device_watch(struct rg_device *device, const struct rg_watch *watch);

// The tier that pictures of two devices must meet: the looser of both devices' tiers against
// cpu:reference.
enum rg_tier rg_tier_owed(const struct rg_device_info *a, const struct rg_device_info *b);

#endif
