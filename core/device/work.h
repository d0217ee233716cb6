// Counts of the work done on a device since it was opened, and on request exact counts of its
// passes' work. Devices that do the same work have the same counts, however they schedule it.
//
// Exact counting makes each draw wait and reads its primitives on the host, so that counting runs
// are never timing runs.
#ifndef RG_CORE_DEVICE_WORK_H
#define RG_CORE_DEVICE_WORK_H

#include "backends/backend.h"

// Whether objects are really made and take memory.
enum rg_room {
    RG_ROOM_TAKEN,   // they are; one that exceeds the limit (core/base/memory.h) is refused
    RG_ROOM_WATCHED, // they are, until much of the limit is taken; later ones are counted
    RG_ROOM_COUNTED, // they are not: objects have a size alone, runs do nothing, reads give zeroes
};

// Called before and after each run that goes to a backend: after splitting, and including packing
// passes.
struct rg_watch {
    void (*before)(const struct rg_pass *pass, const struct rg_run *run, void *user);
    void (*after)(const struct rg_pass *pass, const struct rg_run *run, void *user);
    void *user;
};

struct rg_work {
    int64_t runs;                      // pass runs asked for
    int64_t dispatches;                // pass runs after splitting
    int64_t items;                     // items run
    int64_t bytes_written, bytes_read; // between host and device
    int64_t live_buffers, live_images, live_passes;
    int64_t live_bytes;   // of buffers and images
    int64_t most_bytes;   // the peak of live_bytes since rg_room_begin (device.h)
    int64_t before_bytes; // live_bytes at rg_room_begin
    int64_t watch_bytes;  // with RG_ROOM_WATCHED, later objects are only counted beyond this
    enum rg_room room;
    bool has_failed;        // while an object was destroyed; the next sync or closing reports it
    struct rg_tally *tally; // NULL: no exact counts
    const struct rg_watch *watch; // NULL: nobody looks
};

// -1 marks a count that this device cannot take exactly.
static inline bool rg_is_counted(int64_t count)
{
    return count >= 0;
}

struct rg_tally {
    int64_t runs;                      // pass runs asked for
    int64_t dispatches;                // the device's runs for them: split, packed, in batches
    int64_t items;                     // of all runs
    int64_t records;                   // items of draws that are seen
    int64_t fragments;                 // pixels that their primitives cover
    int64_t fragments_kept;            // fragments neither discarded nor hidden
    int64_t light_evaluations;         // lights of lit programs, once for each fragment
    int64_t texels_fetched;            // texel fetches from images
    int64_t bytes_written, bytes_read; // between host and device
};

// Waits for all queued work before an object is destroyed. Destroying cannot report a failure, so
// the next sync, or closing the device, does.
void rg_work_settle(struct rg_device *device);

// Switches to counting objects without making them: for core/device/objects.c.
void rg_room_count(struct rg_device *device);

// Adds exact counts to a tally from here on, until rg_tally_end.
void rg_tally_begin(struct rg_device *device, struct rg_tally *tally);
void rg_tally_end(struct rg_device *device);

// Hands the backend a run without checks, and counts its work: for core/device/grid.c.
bool rg_tally_run(struct rg_tally *tally, struct rg_pass *pass, const struct rg_run *run);

#endif
