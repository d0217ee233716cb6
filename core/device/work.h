// What was done on a device since it was opened; and on request what its passes come to, counted
// exactly: the same on all devices that do the same work, however each of them schedules it.
//
// While that is counted, each draw waits for the device and its primitives are looked at on the
// host. So what is timed is not counted, and what is counted is not timed.
#ifndef RG_CORE_DEVICE_WORK_H
#define RG_CORE_DEVICE_WORK_H

#include "backends/backend.h"

// Whether objects are made, and memory is taken for them.
enum rg_room {
    RG_ROOM_TAKEN,   // it is; one that exceeds what is allowed (core/base/memory.h) is refused
    RG_ROOM_WATCHED, // it is, until much of what is allowed is taken; all others are counted
    RG_ROOM_COUNTED, // it is not: objects have a size alone, runs and writes do nothing, and what
                     // is read is zeroes
};

// Who looks at each run that goes to a backend, before and after: after folding, with the passes
// that pack a draw.
struct rg_watch {
    void (*before)(const struct rg_pass *pass, const struct rg_run *run, void *user);
    void (*after)(const struct rg_pass *pass, const struct rg_run *run, void *user);
    void *user;
};

struct rg_work {
    int64_t runs;                      // pass runs asked for
    int64_t dispatches;                // pass runs after folding
    int64_t items;                     // items run
    int64_t bytes_written, bytes_read; // between host and device
    int64_t live_buffers, live_images, live_passes;
    int64_t live_bytes;   // of buffers and images
    int64_t most_bytes;   // the most that lived since rg_room_begin (device.h)
    int64_t before_bytes; // and what lived then
    int64_t watch_bytes;  // beyond which objects are counted, where they are watched
    enum rg_room room;
    bool has_failed;        // while something was destroyed; the next sync says so, or closing
    struct rg_tally *tally; // NULL: only this is counted
    const struct rg_watch *watch; // NULL: nobody looks
};

// A count of -1 is unknown: this device cannot have it exactly.
struct rg_tally {
    int64_t runs;                      // pass runs asked for
    int64_t dispatches;                // what the device made of them: folded, packed, in batches
    int64_t items;                     // of all runs
    int64_t records;                   // of the items of draws, those that are seen
    int64_t fragments;                 // pixels that their primitives cover
    int64_t fragments_kept;            // of these, those that are neither discarded nor hidden
    int64_t light_evaluations;         // lights of lit programs, each once a fragment
    int64_t texels_fetched;            // from images
    int64_t bytes_written, bytes_read; // between host and device
};

// Waits for all that was queued, before something is destroyed: for those who do that, who cannot
// tell of a failure. The next sync does, or closing the device.
void rg_work_settle(struct rg_device *device);

// From here on objects are counted alone: for core/device/objects.c.
void rg_room_count(struct rg_device *device);

// Counts into a tally from here on, until the end.
void rg_tally_begin(struct rg_device *device, struct rg_tally *tally);
void rg_tally_end(struct rg_device *device);

// Hands the backend a run, past all checks, and counts what it comes to: for core/device/grid.c.
bool rg_tally_run(struct rg_tally *tally, struct rg_pass *pass, const struct rg_run *run);

#endif
