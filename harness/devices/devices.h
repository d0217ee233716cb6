// The devices of a command: listed so that a broken driver harms nothing, and opened by name.
#ifndef RG_HARNESS_DEVICES_DEVICES_H
#define RG_HARNESS_DEVICES_DEVICES_H

#include "core/device/device.h"

// Lists the devices of every backend, each in a worker: a driver that crashes, hangs or prints
// harms nothing, and its backend is missing with that outcome.
void rg_devices_list(struct rg_device_list *list);
// Says what is missing of a list, in a line each: a warning where it is unsupported, else an error.
// Returns an enum rg_exit: fail where a driver failed.
int rg_devices_complain(const struct rg_device_list *list);

// Opens a device by name, in a worker of its own (harness/devices/workers/device.h). A name may
// have an environment (harness/devices/names.h). NULL, and one logged line, on failure.
struct rg_device *rg_devices_open_one(const char *name);

// The devices that `names` holds: "all", or names separated by commas. Opened, in order. A name
// that is unknown is bad usage, a driver that is absent unsupported, one that fails a failure; the
// others are opened beside one that is absent, and closed. When the list is "all", what is absent
// or fails is left out, with its line. Returns an enum rg_exit.
struct rg_devices {
    int count;
    struct rg_device *devices[RG_MAX_DEVICES];
    // What is left out: backends without a device, and devices that are listed and do not open.
    int absent_count;
    struct rg_absent_device {
        char name[RG_DEVICE_NAME_SIZE];  // the backend's or the device's
        enum rg_outcome outcome;         // unsupported, or how its driver failed
        char why[RG_LIST_WHY_SIZE + 64]; // one line
    } absent[RG_MAX_BACKENDS + RG_MAX_DEVICES];
};
int rg_devices_open(const char *names, struct rg_devices *devices);

// What the command line asks of devices.
struct rg_devices_asked {
    char *names;   // of --device
    char *require; // names of devices or of backends that must be among them; NULL: none
    int timeout_s; // a device that does not answer for so long is given up
};
// The same. What is required and is not there is a failure, with one line that says why.
int rg_devices_open_asked(const struct rg_devices_asked *asked, struct rg_devices *devices);
// Whether what is required is among the devices; else one line is logged for each that is not.
bool rg_devices_have(const struct rg_devices *devices, const char *require);
// Whether a device is of a name of --require: its own, or its backend's.
bool rg_device_is_of(const char *device, const char *name);
// Of what was left out, an enum rg_exit: fail where a driver failed.
int rg_devices_exit(const struct rg_devices *devices);
// Whether two devices may be held against each other (harness/devices/drivers/apart.h). False, and
// one logged line, where one driver runs on both though their names choose two.
bool rg_devices_are_apart(const struct rg_device_info *a, const struct rg_device_info *b);
// Closes them; false on a leak, or where a driver crashes meanwhile.
bool rg_devices_close(struct rg_devices *devices);
// The same at the end of a command that came to `exit`: what it comes to then, an enum rg_exit.
int rg_devices_end(struct rg_devices *devices, int exit);

#endif
