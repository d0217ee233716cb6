// Shared state of a command's tables: devices, sessions kept open, and true pictures.
//
// Instances on a device share large constant data (an atlas, a scene) while at least one of them
// lives. So one is kept open on each device between rows.
#ifndef RG_HARNESS_DEVICES_KEPT_H
#define RG_HARNESS_DEVICES_KEPT_H

#include "harness/devices/devices.h"
#include "harness/devices/frames/session.h"

enum { RG_KEPT_DEVICES = 2, RG_KEPT_TRUTHS = 8 };

// Zero it except `devices`, which must outlive it. The owner calls rg_kept_free.
struct rg_kept {
    const struct rg_devices *devices;
    struct rg_device *own[RG_KEPT_DEVICES]; // opened in addition
    struct rg_kept_session {
        struct rg_session *session; // owned
        struct rg_subject of;       // of textures: its subject; settings owned
    } sessions[RG_MAX_DEVICES + RG_KEPT_DEVICES];
    struct rg_kept_picture {
        struct rg_picture picture; // owned; no texels: empty
        struct rg_subject of;      // settings owned
        int frames;
    } truths[RG_KEPT_TRUTHS];
    int truth_count; // made so far; a new one replaces the oldest
};

// The device of this name, from `devices` or opened in addition. NULL, and one logged line, on
// failure.
struct rg_device *rg_kept_device(struct rg_kept *kept, const char *name);

// Takes ownership of a session, which is closed when another replaces it on its device.
void rg_kept_put(struct rg_kept *kept, struct rg_session *session);

// A session of this subject, newly opened or kept, at any frame. NULL, and one logged line, on
// failure.
struct rg_session *rg_kept_open(struct rg_kept *kept, struct rg_device *device,
                                const struct rg_subject *subject);

// The picture on `cpu` after this many frames, which is kept for later calls. NULL, and one logged
// line, on failure.
const struct rg_picture *rg_kept_truth(struct rg_kept *kept, const struct rg_subject *subject,
                                       int frames);

// Closes all. False on a leak.
bool rg_kept_free(struct rg_kept *kept);

#endif
