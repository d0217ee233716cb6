// A folder with a driver, DRIVER=PREFIX, in one of three forms: as packages unpack (usr/lib,
// usr/share, etc), as `meson install` fills a prefix (lib, share), or a build folder as used by
// `meson devenv`.
#ifndef RG_HARNESS_DEVICES_DRIVERS_PREFIX_H
#define RG_HARNESS_DEVICES_DRIVERS_PREFIX_H

#include <limits.h>
#include <stdbool.h>

#include "harness/devices/drivers/variables.h"

enum { RG_PREFIX_DRIVERS = 24, RG_PREFIX_FOLDERS = 24 };

struct rg_prefix {
    char path[PATH_MAX]; // without links
    int folder_count;    // folders with libraries
    char folders[RG_PREFIX_FOLDERS][PATH_MAX];
    int driver_count; // for all APIs
    struct rg_prefix_driver {
        const char *api;         // "vulkan"
        char manifest[PATH_MAX]; // "": none, because none is needed or one will be made
        char library[PATH_MAX];  // its library, in the prefix
    } drivers[RG_PREFIX_DRIVERS];
};

// Finds the drivers in a prefix, at least one of this API. `device` is for messages. False, and one
// logged line, on failure: an input error if the folder is missing or its libraries are for another
// processor, unsupported if it has no driver of that API.
bool rg_prefix_read(const char *device, const char *api, const char *path,
                    struct rg_prefix *prefix);

// Sets variables that make the loaders of all three APIs use only the prefix's drivers. Copies of
// manifests, with paths of libraries, go into `folder`, which must exist. False, and one logged
// line, on failure.
bool rg_prefix_set(const struct rg_prefix *prefix, const char *folder,
                   struct rg_worker_variables *variables);

#endif
