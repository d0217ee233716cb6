// Describes a device's driver for people and machines: its own name and version, and the files from
// which its code was loaded.
#ifndef RG_HARNESS_RECORD_PASSPORT_DRIVER_H
#define RG_HARNESS_RECORD_PASSPORT_DRIVER_H

#include <jansson.h>
#include <stdio.h>

#include "backends/backend.h"

enum { RG_DRIVER_LINE = 2600 };

// "vulkan: llvmpipe Mesa 22.3.6 (LLVM 15.0.6), /usr/lib/x86_64-linux-gnu/libvulkan_lvp.so, build id
// 4c1f...": one line without a newline. Files below the current folder have relative paths. The
// name that a short name stands for follows it.
void rg_driver_line(const struct rg_device_info *info, char line[RG_DRIVER_LINE]);

// Prints a line for each device.
void rg_drivers_print(const struct rg_device_info *const infos[], int count, FILE *out);

// Adds to a device's object "full", the name by which it can be opened again, if that differs, and
// "libraries", an array of {"path", "build"}.
void rg_driver_put(json_t *device, const struct rg_device_info *info);

#endif
