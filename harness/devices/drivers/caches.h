// Folders for sides: a device with settings of its own, or a side of a gate, has its own folder for
// compiled code, by its settings and its driver.
//
// Drivers cache compiled code, and some omit from the key a thing on which the code depends. Mesa
// 22.3 caches code compiled under LP_PERF=no_tex, or for another LP_NATIVE_VECTOR_WIDTH, as if
// compiled without: the next plain run draws with it, and vice versa. So two sides with one cache
// would run the same code, and would spoil the user's cache.
#ifndef RG_HARNESS_DEVICES_DRIVERS_CACHES_H
#define RG_HARNESS_DEVICES_DRIVERS_CACHES_H

#include <limits.h>
#include <stdbool.h>
#include <stdint.h>

#include "harness/devices/drivers/variables.h"

// The numbers of folders that are kept: of settings, and of drivers in each. The last used remain.
enum { RG_SIDES_KEPT = 32, RG_SIDE_DRIVERS_KEPT = 4 };

struct rg_side_folder {
    uint64_t settings, driver; // hashes; the driver's is 0 before it was first seen
    char settings_path[PATH_MAX];
    char path[PATH_MAX]; // for these settings and this driver
};

// Finds or makes the folder of a device's settings and of the driver that it had when last opened.
// It stays while this process lives; of the others the least recently used are removed, up to the
// first that another process uses. Settings are the API's name, the device's own variables
// (harness/devices/workers/environment.h) but for those of raingauge (RG_PROGRAM counts), and this
// process's variables that a driver reads. False, and one logged line, on failure.
bool rg_side_folder_find(const char *api, const char *environment, struct rg_side_folder *folder);

// Switches to the folder of the driver that was actually found, and notes it for the next time.
// False if it is the same folder.
bool rg_side_folder_move(struct rg_side_folder *folder, uint64_t driver);

// Makes a folder in it.
bool rg_side_folder_in(const struct rg_side_folder *folder, const char *name, char path[PATH_MAX]);

// Makes drivers cache their code there, unless the device's own settings choose a cache.
bool rg_side_caches_set(const struct rg_side_folder *folder, struct rg_worker_variables *variables);

#endif
