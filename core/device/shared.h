// Things of a device that several instances on it read, such as an atlas's image, a city's meshes
// or a depth map: made by the first that asks, destroyed with the last that puts it back. What is
// shared is not written after it was made.
#ifndef RG_CORE_DEVICE_SHARED_H
#define RG_CORE_DEVICE_SHARED_H

#include "backends/backend.h"

// What all things of one kind have in common; a constant that outlives them. Things of different
// kinds never meet, whatever their keys.
struct rg_shared_kind {
    const char *name; // for messages: "atlas"
    // Makes a thing of what `arg` says. NULL, and one logged line, on failure. It may ask for other
    // shared things, and destroy puts those back.
    void *(*make)(struct rg_device *device, const void *arg);
    void (*destroy)(void *thing);
};

// The device's thing of this kind and key. Where it has none, `make` makes it of `arg`, so the key
// must tell apart everything that decides the content: parameters, and hashes of files. Keys are
// copied and may be long. Every call that returns a thing wants one rg_shared_put before the device
// closes, which else reports it as a leak. NULL, and one logged line, where it could not be made;
// the next call tries again.
void *rg_shared_get(struct rg_device *device, const char *key, const struct rg_shared_kind *kind,
                    const void *arg);

// Gives back what rg_shared_get returned; NULL is allowed.
void rg_shared_put(struct rg_device *device, void *thing);

// Destroys what was not put back before a device closes, a logged line each. Returns whether there
// was nothing.
bool rg_shared_close(struct rg_device *device);

#endif
