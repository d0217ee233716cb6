// Names of devices on the command line.
//
// A name may have an environment: "vulkan@VK_DRIVER_FILES=old.json;LP_NUM_THREADS=1". Its worker
// gets these variables in addition to raingauge's own, so that two drivers of one API, or one
// driver in two settings, can be compared. A value with a comma, a semicolon or a double quote is
// put in double quotes, in which two double quotes mean one. A variable may occur only once.
//
// A name may begin with a short name: "new=vulkan@DRIVER=/opt/mesa". Tables, messages and files
// then call the device "new", and so may the rest of the command line.
#ifndef RG_HARNESS_DEVICES_NAMES_H
#define RG_HARNESS_DEVICES_NAMES_H

#include <stdbool.h>

#include "backends/backend.h"

struct rg_device_name {
    char name[RG_DEVICE_NAME_SIZE];            // the short name, or the given one with its quotes
    char full[RG_DEVICE_NAME_SIZE];            // the given name without the short one
    char environment[RG_DEVICE_NAME_SIZE + 2]; // "KEY=value", each ended by a zero, the last by two
};

// Whether all names are well-formed; else logs one line, which names the option in `given_to`, as
// "--require".
bool rg_device_names_check(const char *given_to, const char *names);

// Whether this is one device's name, as needed by a command that draws on one. False, and one
// logged line, if not.
bool rg_device_names_one(const char *names, const char *command);

// Reads the first of several names separated by commas, and moves `*names` past it and its comma.
// Remembers a short name. False, and one logged line, if the name is empty, too long or malformed,
// or if the short name already means another device.
bool rg_device_name_read(const char **names, struct rg_device_name *name);

// The name that a short name stands for, valid for the process's life; for any other name `name`
// itself.
const char *rg_device_name_full(const char *name);

// A device's name with one more variable, quoted if necessary. False, and one logged line, if it
// gets too long.
bool rg_device_name_with(const char *name, const char *key, const char *value,
                         char with[RG_DEVICE_NAME_SIZE]);

#endif
