// A folder with a driver in it, DRIVER=PREFIX: as packages unpack (usr/lib, usr/share, etc), as
// `meson install` fills a prefix (lib, share), or a build folder that `meson devenv` works in.
#ifndef RG_HARNESS_DEVICES_DRIVERS_PREFIX_H
#define RG_HARNESS_DEVICES_DRIVERS_PREFIX_H

#include <limits.h>
#include <stdbool.h>

#include "harness/devices/drivers/variables.h"

enum { RG_PREFIX_DRIVERS = 24, RG_PREFIX_FOLDERS = 24 };

struct rg_prefix {
    char path[PATH_MAX]; // without links
    int folder_count;    // that hold libraries
    char folders[RG_PREFIX_FOLDERS][PATH_MAX];
    int driver_count; // of all APIs
    struct rg_prefix_driver {
        const char *api;         // "vulkan"
        char manifest[PATH_MAX]; // "": it has none, and needs none or gets one
        char library[PATH_MAX];  // that it names, in the prefix
    } drivers[RG_PREFIX_DRIVERS];
};

// Finds what a prefix holds; at least a driver of this API. `device` is for messages. False, and
// one logged line, on failure: the user's where the folder is absent or its libraries are for
// another processor, and unsupported where it has no driver of that API.
bool rg_prefix_read(const char *device, const char *api, const char *path,
                    struct rg_prefix *prefix);

// Sets what has the loaders of all three APIs take the prefix's drivers and nothing else. Copies of
// manifests, which name their libraries by path, go into `folder`, which is there. False, and one
// logged line, on failure.
bool rg_prefix_set(const struct rg_prefix *prefix, const char *folder,
                   struct rg_worker_variables *variables);

#endif
