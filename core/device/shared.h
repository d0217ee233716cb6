// Things on a device that several instances read, such as an atlas's image, a city's meshes or a
// depth map. The first that asks makes it, the last that puts it back destroys it, and nobody
// writes it in between.
#ifndef RG_CORE_DEVICE_SHARED_H
#define RG_CORE_DEVICE_SHARED_H

#include "backends/backend.h"

// A kind of shared things; a constant that outlives them. Equal keys of different kinds
// do not collide.
struct rg_shared_kind {
    const char *name; // for messages: "atlas"
    // Makes a thing from `arg`. NULL, and one logged line, on failure. It may ask for other shared
    // things, which destroy puts back.
    void *(*make)(struct rg_device *device, const void *arg);
    void (*destroy)(void *thing);
};

// The device's thing of this kind and key. If there is none, `make` makes it from `arg`, so that
// the key must name everything that decides the content: parameters, and hashes of files. Keys are
// copied and may be long. Each thing returned needs one rg_shared_put before the device closes, or
// closing reports a leak. NULL, and one logged line, where it could not be made; the next call
// tries again.
void *rg_shared_get(struct rg_device *device, const char *key, const struct rg_shared_kind *kind,
                    const void *arg);

// Gives back what rg_shared_get returned; NULL is allowed.
void rg_shared_put(struct rg_device *device, void *thing);

// Destroys things that were not put back before a device closes, and logs a line for each. Returns
// whether there were none.
bool rg_shared_close(struct rg_device *device);

#endif
