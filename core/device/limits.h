// What a device lacks, read from its limits and said here alone. Each function returns whether the
// device can do what it is asked; where it cannot, it has logged one line with rg_unsupported.
#ifndef RG_CORE_DEVICE_LIMITS_H
#define RG_CORE_DEVICE_LIMITS_H

#include "backends/backend.h"

// Whether what a driver tells of itself can be: a device has room for work groups and items. Else
// its driver is wrong, with one line.
bool rg_limits_are_sound(const struct rg_device_info *info);
// One more buffer or image (`noun`) beside those that live.
bool rg_limits_allow_object(const struct rg_device *device, const char *noun, const char *name);
bool rg_limits_allow_buf(const struct rg_device_info *info, int64_t size, const char *name);
bool rg_limits_allow_image(const struct rg_device_info *info, const struct rg_image_desc *desc,
                           const char *name);
// Slots and formats of a kernel, and of a DRAW program that the device draws at all.
bool rg_limits_allow_kernel(const struct rg_device_info *info, const struct rg_kernel *kernel);
// Formats that a run of a DRAW program draws to and blends with.
bool rg_limits_allow_draw(const struct rg_device_info *info, const struct rg_kernel *kernel,
                          const struct rg_draw *draw);
bool rg_limits_allow_time(const struct rg_device_info *info);

#endif
