// What the tables of one command share: devices, sessions that stay open, and truths.
//
// Instances on a device share what is large and the same for all (an atlas, a scene), for as long
// as one of them lives. So one is kept open on each device from one row to the next.
#ifndef RG_HARNESS_DEVICES_KEPT_H
#define RG_HARNESS_DEVICES_KEPT_H

#include "harness/devices/devices.h"
#include "harness/frames/session.h"

enum { RG_KEPT_DEVICES = 2, RG_KEPT_TRUTHS = 8 };

// Zeroed but for `devices`, which outlive it. The owner calls rg_kept_free.
struct rg_kept {
    const struct rg_devices *devices;
    struct rg_device *own[RG_KEPT_DEVICES]; // opened beside them
    struct rg_kept_session {
        struct rg_session *session; // owned
        struct rg_subject of;       // of textures: what it was opened with; settings owned
    } sessions[RG_MAX_DEVICES + RG_KEPT_DEVICES];
    struct rg_kept_picture {
        struct rg_picture picture; // owned; no texels: nothing
        struct rg_subject of;      // settings owned
        int frames;
    } truths[RG_KEPT_TRUTHS];
    int truth_count; // made so far; the oldest gives way
};

// The device of this name, among `devices` or opened beside them for as long as this
// lives. NULL, and one logged line, on failure.
struct rg_device *rg_kept_device(struct rg_kept *kept, const char *name);

// Takes over a session, which lives until another takes its place on its device.
void rg_kept_put(struct rg_kept *kept, struct rg_session *session);

// A session that may have been opened before, at no frame in particular, and is kept.
// NULL, and one logged line, on failure.
struct rg_session *rg_kept_open(struct rg_kept *kept, struct rg_device *device,
                                const struct rg_subject *subject);

// The picture after so many frames on the device `cpu`, kept for those who ask for
// the same. NULL, and one logged line, on failure.
const struct rg_picture *rg_kept_truth(struct rg_kept *kept, const struct rg_subject *subject,
                                       int frames);

// Closes everything. False on a leak.
bool rg_kept_free(struct rg_kept *kept);

#endif
