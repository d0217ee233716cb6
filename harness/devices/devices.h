// The devices of a command: listed so that a broken driver harms nothing, and opened by name.
#ifndef RG_HARNESS_DEVICES_DEVICES_H
#define RG_HARNESS_DEVICES_DEVICES_H

#include "core/device/device.h"

// Lists the devices of every backend, each in a child process: a driver that crashes, hangs or
// prints is missing, and its line says so. To be called before this process uses a driver or
// OpenMP.
void rg_devices_list(struct rg_device_list *list);

// The devices that `names` holds: "all", or names separated by commas. Opened, in order. A name
// that is unknown is bad usage; a driver that is absent is unsupported, and skipped with its line
// when the list was "all". So is one that is there and does not open, which the command reports as
// a failure. Returns an enum rg_exit.
struct rg_devices {
    int count;
    struct rg_device *devices[RG_MAX_DEVICES];
    // With "all": one line a backend without a device, "" after the last.
    char missing[RG_MAX_BACKENDS + 1][256];
    int broken_count; // with "all": devices that are listed and do not open
    struct rg_broken_device {
        char name[32], why[256];
    } broken[RG_MAX_DEVICES];
};
int rg_devices_open(const char *names, struct rg_devices *devices);
// Closes them; false on a leak.
bool rg_devices_close(struct rg_devices *devices);

#endif
