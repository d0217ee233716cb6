// Checks that the driver chosen by a device's name is the driver that runs.
//
// Names choose drivers in many ways. If a name leads nowhere, the loaders of Vulkan, EGL and OpenCL
// silently use the system's driver. So the named files are examined before a device is opened, and
// compared with the files mapped by its worker after that.
#ifndef RG_HARNESS_DEVICES_DRIVERS_CHOICE_H
#define RG_HARNESS_DEVICES_DRIVERS_CHOICE_H

#include <stdbool.h>

#include "backends/backend.h"
#include "harness/devices/drivers/manifest.h"
#include "harness/devices/drivers/prefix.h"
#include "harness/devices/drivers/variables.h"

enum { RG_CHOICE_MANIFESTS = 32 };

// A device as named on the command line (harness/devices/names.h). Owns nothing.
struct rg_asked {
    const char *name; // the name used in messages
    const char *full; // "vulkan:1@DRIVER=/opt/mesa"
    const char *environment;
};

// The driver that a device's name asks for.
struct rg_choice {
    const char *name, *environment; // not owned
    char api[32];                   // "vulkan"
    const char *driver;             // from DRIVER=PREFIX, not owned; NULL: not given
    const char *variable;           // the variable with manifests, "VK_DRIVER_FILES"; NULL: none
    struct rg_prefix prefix;        // files of `driver`
    int count;
    struct rg_manifest manifests[RG_CHOICE_MANIFESTS]; // files in the variable
};

// Reads the choice in a name, whose texts must outlive it; rg_choice_free frees it. NULL, and one
// logged line, if the name has missing or unsuitable files or folders.
struct rg_choice *rg_choice_read(const struct rg_asked *asked);
void rg_choice_free(struct rg_choice *choice);

// Sets the name's variables for the worker, including those that follow from DRIVER=PREFIX, whose
// copies of manifests go into `folder`. False, and one logged line, on failure.
bool rg_choice_set(const struct rg_choice *choice, const char *folder,
                   struct rg_worker_variables *variables);

// Lists the libraries that were named, up to `max`, and returns their number.
int rg_choice_libraries(const struct rg_choice *choice, const char **libraries, int max);
// Logs that none of them can be loaded, with the dynamic linker's reason. Returns false.
bool rg_choice_refuse(const struct rg_choice *choice, const char *why);

// Whether the opened device runs one of them. False, and one logged line, if its driver is
// elsewhere.
bool rg_choice_is_met(const struct rg_choice *choice, const struct rg_device_info *info);

// The right way to name a device's driver, for messages; takes the API's name.
#define RG_MEND_PREFIX                                                                             \
    "write '%s@DRIVER=PREFIX', PREFIX the folder that has its usr/lib and usr/share"

#endif
