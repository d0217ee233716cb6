// Lists devices such that a broken driver does no harm, and opens them by name.
#ifndef RG_HARNESS_DEVICES_DEVICES_H
#define RG_HARNESS_DEVICES_DEVICES_H

#include "core/device/device.h"

// Lists the devices of every backend, each in a worker: a driver that crashes, hangs or prints does
// no harm. Its backend is then listed as missing, with that outcome.
void rg_devices_list(struct rg_device_list *list);
// Logs a line for each missing backend: a warning if it is unsupported, else an error. Returns an
// enum rg_exit: fail if a driver failed.
int rg_devices_complain(const struct rg_device_list *list);

// Opens a device by name, in its own worker (harness/devices/workers/device.h). A name may include
// an environment (harness/devices/names.h). NULL, and one logged line, on failure.
struct rg_device *rg_devices_open_one(const char *name);

// Opens the devices in `names`, in order: "all", or names separated by commas. Returns an enum
// rg_exit. An unknown name is bad usage, an absent driver unsupported, a failing one a failure; if
// one is absent, the others are opened and closed again. With "all", logs a line for each absent or
// failing device and leaves it out.
struct rg_devices {
    int count;
    struct rg_device *devices[RG_MAX_DEVICES];
    // Left out: backends without a device, and listed devices that failed to open.
    int absent_count;
    struct rg_absent_device {
        char name[RG_DEVICE_NAME_SIZE];  // of the backend or the device
        enum rg_outcome outcome;         // unsupported, or how its driver failed
        char why[RG_LIST_WHY_SIZE + 64]; // one line
    } absent[RG_MAX_BACKENDS + RG_MAX_DEVICES];
};
int rg_devices_open(const char *names, struct rg_devices *devices);

// The command line's options about devices.
struct rg_devices_asked {
    char *names;   // of --device
    char *require; // devices or backends that must be among them; NULL: none
    int timeout_s; // a device is given up after it has not answered for so long
};
// Opens these devices. A missing required device is a failure, with one line that says why.
int rg_devices_open_asked(const struct rg_devices_asked *asked, struct rg_devices *devices);
// Whether all required devices are present; logs a line for each missing one.
bool rg_devices_have(const struct rg_devices *devices, const char *require);
// Whether a name in --require means this device: by its own name, or its backend's.
bool rg_device_is_of(const char *device, const char *name);
// The enum rg_exit for devices that were left out: fail if a driver failed.
int rg_devices_exit(const struct rg_devices *devices);
// Whether two devices may be compared (harness/devices/drivers/apart.h). False, and one logged
// line, if both run one driver though their names choose two.
bool rg_devices_are_apart(const struct rg_device_info *a, const struct rg_device_info *b);
// The same of two valid names: whether they choose two drivers of one API, and the settings by
// which they differ besides.
bool rg_devices_choose_drivers(const char *a, const char *b);
void rg_devices_settings(const char *now, const char *then, char *text, size_t size);
// Closes the devices; false on a leak, or if a driver crashes meanwhile.
bool rg_devices_close(struct rg_devices *devices);
// Closes them at the end of a command with status `exit`; returns its final enum rg_exit.
int rg_devices_end(struct rg_devices *devices, int exit);

#endif
