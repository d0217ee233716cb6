// Folders for sides: a device with settings of its own, or a side of a gate, keeps compiled code in
// a folder of its own, by its settings and its driver.
//
// Drivers keep the code that they compile, and not all know what it depends on. Mesa 22.3 keeps
// code that it compiled under LP_PERF=no_tex, or for another LP_NATIVE_VECTOR_WIDTH, as if it had
// been compiled without: the next plain run draws with it, and a run with the setting takes what a
// plain run left. So two sides in one cache run the same code, and the user's own cache is spoilt.
#ifndef RG_HARNESS_DEVICES_DRIVERS_CACHES_H
#define RG_HARNESS_DEVICES_DRIVERS_CACHES_H

#include <limits.h>
#include <stdbool.h>
#include <stdint.h>

#include "harness/devices/drivers/variables.h"

// So many folders of settings are kept, and so many drivers' in one of them: those last used.
enum { RG_SIDES_KEPT = 32, RG_SIDE_DRIVERS_KEPT = 4 };

struct rg_side_folder {
    uint64_t settings, driver; // hashes; the driver's is 0 before it was ever seen
    char settings_path[PATH_MAX];
    char path[PATH_MAX]; // of these settings and this driver
};

// The folder of a device's settings and of the driver that it had when it was last opened. It is
// made, and stays while this process lives; others that were not used for longest go. Settings are
// the API's name, the device's own variables (harness/devices/workers/environment.h), and those of
// this process that a driver reads. False, and one logged line, on failure.
bool rg_side_folder_find(const char *api, const char *environment, struct rg_side_folder *folder);

// Takes the folder of the driver that was found to be there, and notes it for the next time. False
// where it was this folder already.
bool rg_side_folder_move(struct rg_side_folder *folder, uint64_t driver);

// A folder in it, which is made.
bool rg_side_folder_in(const struct rg_side_folder *folder, const char *name, char path[PATH_MAX]);

// Has drivers keep their code there. What the device's own settings say of a cache is obeyed.
bool rg_side_caches_set(const struct rg_side_folder *folder, struct rg_worker_variables *variables);

#endif
