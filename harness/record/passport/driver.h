// Which driver a device runs, as people and machines are told it: what it says of itself, and which
// files its code was loaded from.
#ifndef RG_HARNESS_RECORD_PASSPORT_DRIVER_H
#define RG_HARNESS_RECORD_PASSPORT_DRIVER_H

#include <jansson.h>
#include <stdio.h>

#include "backends/backend.h"

enum { RG_DRIVER_LINE = 2600 };

// "vulkan: llvmpipe Mesa 22.3.6 (LLVM 15.0.6), /usr/lib/x86_64-linux-gnu/libvulkan_lvp.so, build id
// 4c1f...": one line without its end. A file below the current folder is told from there. A short
// name is told with what it stands for.
void rg_driver_line(const struct rg_device_info *info, char line[RG_DRIVER_LINE]);

// A line for each.
void rg_drivers_print(const struct rg_device_info *const infos[], int count, FILE *out);

// Adds "full", the name by which it can be opened again, where that is another, and "libraries", an
// array of {"path", "build"}, to a device's object.
void rg_driver_put(json_t *device, const struct rg_device_info *info);

#endif
