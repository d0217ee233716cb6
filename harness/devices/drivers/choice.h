// Whether the driver that a device's name asks for is the driver that runs.
//
// Names ask for drivers in many ways, and the loaders of Vulkan, EGL and OpenCL go on where one
// leads nowhere: with the system's driver. So what is named is looked at before a device is opened,
// and held against the files that its worker has mapped after.
#ifndef RG_HARNESS_DEVICES_DRIVERS_CHOICE_H
#define RG_HARNESS_DEVICES_DRIVERS_CHOICE_H

#include <stdbool.h>

#include "backends/backend.h"
#include "harness/devices/drivers/manifest.h"
#include "harness/devices/drivers/prefix.h"
#include "harness/devices/drivers/variables.h"

enum { RG_CHOICE_MANIFESTS = 32 };

// A device as the command line names it (harness/devices/names.h). Nothing in it is owned.
struct rg_asked {
    const char *name; // that messages call it by
    const char *full; // "vulkan:1@DRIVER=/opt/mesa"
    const char *environment;
};

// What a device's name asks of its driver.
struct rg_choice {
    const char *name, *environment; // not owned
    char api[32];                   // "vulkan"
    const char *driver;             // of DRIVER=PREFIX, not owned; NULL: not given
    const char *variable;           // that names manifests, "VK_DRIVER_FILES"; NULL: none does
    struct rg_prefix prefix;        // of `driver`
    int count;
    struct rg_manifest manifests[RG_CHOICE_MANIFESTS]; // that the variable names
};

// Reads what was asked, whose texts outlive the choice; rg_choice_free frees it. NULL, and one
// logged line, on failure: it names files or a folder that are absent or no such thing.
struct rg_choice *rg_choice_read(const struct rg_asked *asked);
void rg_choice_free(struct rg_choice *choice);

// The name's variables for the worker, those of DRIVER=PREFIX among them, whose copies of manifests
// go into `folder`. False, and one logged line, on failure.
bool rg_choice_set(const struct rg_choice *choice, const char *folder,
                   struct rg_worker_variables *variables);

// The libraries that were named. Returns how many; at most `max`.
int rg_choice_libraries(const struct rg_choice *choice, const char **libraries, int max);
// Says that none of them can be loaded, for a reason of the dynamic linker. False.
bool rg_choice_refuse(const struct rg_choice *choice, const char *why);

// Whether the device that was opened runs one of them. False, and one logged line, where its driver
// lies elsewhere than what was named.
bool rg_choice_is_met(const struct rg_choice *choice, const struct rg_device_info *info);

// How a device's driver is to be named instead, for messages: takes the API's name.
#define RG_MEND_PREFIX                                                                             \
    "write '%s@DRIVER=PREFIX', PREFIX the folder that has its usr/lib and usr/share"

#endif
