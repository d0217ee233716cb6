#include "backends/vulkan/vulkan.h"

#include <stdio.h>

#include "core/base/log.h"

#define RESULTS(X)                                                                                 \
    X(VK_NOT_READY)                                                                                \
    X(VK_TIMEOUT)                                                                                  \
    X(VK_INCOMPLETE)                                                                               \
    X(VK_ERROR_OUT_OF_HOST_MEMORY)                                                                 \
    X(VK_ERROR_OUT_OF_DEVICE_MEMORY)                                                               \
    X(VK_ERROR_INITIALIZATION_FAILED)                                                              \
    X(VK_ERROR_DEVICE_LOST)                                                                        \
    X(VK_ERROR_MEMORY_MAP_FAILED)                                                                  \
    X(VK_ERROR_LAYER_NOT_PRESENT)                                                                  \
    X(VK_ERROR_EXTENSION_NOT_PRESENT)                                                              \
    X(VK_ERROR_FEATURE_NOT_PRESENT)                                                                \
    X(VK_ERROR_INCOMPATIBLE_DRIVER)                                                                \
    X(VK_ERROR_TOO_MANY_OBJECTS)                                                                   \
    X(VK_ERROR_FORMAT_NOT_SUPPORTED)                                                               \
    X(VK_ERROR_FRAGMENTED_POOL)                                                                    \
    X(VK_ERROR_OUT_OF_POOL_MEMORY)                                                                 \
    X(VK_ERROR_FRAGMENTATION)                                                                      \
    X(VK_ERROR_INVALID_SHADER_NV)                                                                  \
    X(VK_ERROR_UNKNOWN)

const char *vk_result_name(VkResult result)
{
#define NAME(value)                                                                                \
    case value:                                                                                    \
        return #value;
    switch (result) {
        RESULTS(NAME)
    default: {
        static _Thread_local char number[32];
        snprintf(number, sizeof(number), "VkResult %d", (int)result);
        return number;
    }
    }
#undef NAME
}

static const char *mend(VkResult result)
{
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "; use fewer or smaller buffers and images";
    case VK_ERROR_DEVICE_LOST:
        return "; open the device anew";
    default:
        return "";
    }
}

static bool loss_is_told;

bool vk_check(VkResult result, const char *call, const char *noun, const char *name)
{
    if (result >= 0)
        return true;
    loss_is_told = loss_is_told || result == VK_ERROR_DEVICE_LOST;
    return rg_driver_error("%s '%s': %s failed with %s%s", noun, name, call, vk_result_name(result),
                           mend(result));
}

bool vk_close_check(VkResult result, const char *call, const char *name)
{
    const bool is_told = loss_is_told && result == VK_ERROR_DEVICE_LOST;
    const bool ok = !is_told && vk_check(result, call, "device", name);
    loss_is_told = false;
    return ok;
}

bool vk_healthy(struct vk_device *device)
{
    int complaints = device->instance.complaints;
    bool healthy = complaints == device->instance.complaints_told;
    device->instance.complaints_told = complaints;
    return healthy;
}

void vk_name(struct vk_device *device, VkObjectType type, uint64_t handle, const char *name)
{
    if (device->set_name)
        device->set_name(device->handle, &(VkDebugUtilsObjectNameInfoEXT){
                                             VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             NULL, type, handle, name});
}

void vk_group_begin(const struct vk_device *device, VkCommandBuffer commands, const char *name)
{
    if (device->begin_group)
        device->begin_group(
            commands, &(VkDebugUtilsLabelEXT){.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                              .pLabelName = name});
}

void vk_group_end(const struct vk_device *device, VkCommandBuffer commands)
{
    if (device->end_group)
        device->end_group(commands);
}
