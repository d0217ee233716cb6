// Checks against a device's limits; these messages are written nowhere else. Each function returns
// whether the device can do what is asked, and logs one line with rg_unsupported where it cannot.
#ifndef RG_CORE_DEVICE_LIMITS_H
#define RG_CORE_DEVICE_LIMITS_H

#include "backends/backend.h"

// Whether the limits that a driver reports are possible: a device has work groups and items. If
// not, the driver is at fault, in one logged line.
bool rg_limits_are_sound(const struct rg_device_info *info);
// Whether one more buffer or image (`noun`) may be made.
bool rg_limits_allow_object(const struct rg_device *device, const char *noun, const char *name);
bool rg_limits_allow_buf(const struct rg_device_info *info, int64_t size, const char *name);
bool rg_limits_allow_image(const struct rg_device_info *info, const struct rg_image_desc *desc,
                           const char *name);
// Checks a kernel's slots and formats, and whether the device draws at all where it is a DRAW
// program.
bool rg_limits_allow_kernel(const struct rg_device_info *info, const struct rg_kernel *kernel);
// Checks the formats that a run of a DRAW program draws to and blends with.
bool rg_limits_allow_draw(const struct rg_device_info *info, const struct rg_kernel *kernel,
                          const struct rg_draw *draw);
bool rg_limits_allow_time(const struct rg_device_info *info);
// Whether a listed device can be opened as the native device `name`.
bool rg_limits_allow_native(const char *name, const struct rg_device_info *info);
bool rg_limits_allow_fixed(const struct rg_device_info *info);

#endif
