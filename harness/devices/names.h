// Names of devices as the command line has them.
//
// A name may have an environment: "vulkan@VK_DRIVER_FILES=old.json;LP_NUM_THREADS=1". Its worker is
// started with these variables over raingauge's own, so that two drivers of one API, or one driver
// in two settings, stand side by side. A value that holds a comma, a semicolon or a double quote is
// put in double quotes; within them two double quotes mean one. No variable stands there twice.
//
// A name may begin with a short one: "new=vulkan@DRIVER=/opt/mesa". Tables, messages and files call
// the device "new" then, and the command line may do so as well from there on.
#ifndef RG_HARNESS_DEVICES_NAMES_H
#define RG_HARNESS_DEVICES_NAMES_H

#include <stdbool.h>

#include "backends/backend.h"

struct rg_device_name {
    char name[RG_DEVICE_NAME_SIZE];            // the short one, or what was given, with its quotes
    char full[RG_DEVICE_NAME_SIZE];            // what was given, without the short one
    char environment[RG_DEVICE_NAME_SIZE + 2]; // "KEY=value", each ended by a zero, the last by two
};

// Whether all names are such forms; else one line has been logged, which says what they were given
// to: "--require".
bool rg_device_names_check(const char *given_to, const char *names);

// Whether it is the name of one device, on which a command draws. False, and one logged line.
bool rg_device_names_one(const char *names, const char *command);

// Reads the first of several names, which commas separate, and moves `*names` behind it and the
// comma. A short name is known from then on. False, and one logged line, where it is empty, too
// long or no such form, or where the short name stands for another device already.
bool rg_device_name_read(const char **names, struct rg_device_name *name);

// What a short name stands for, which lives as long as the process; else `name` itself.
const char *rg_device_name_full(const char *name);

// A device's name with one variable more; a value that needs quotes gets them. False, and one
// logged line, where it gets too long.
bool rg_device_name_with(const char *name, const char *key, const char *value,
                         char with[RG_DEVICE_NAME_SIZE]);

#endif
