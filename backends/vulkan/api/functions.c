// Finds the driver's code that serves a device.
#include "backends/vulkan/vulkan.h"

#include "core/base/log.h"

// Whether the code is the loader's, which implements some functions itself, or a layer's. A loader
// that is also a driver, as NVIDIA's is, counts as a driver.
static bool is_between(const void *code)
{
    return (rg_library_exports(code, "vkNegotiateLoaderLayerInterfaceVersion") ||
            rg_library_exports(code, "vkEnumerateInstanceLayerProperties")) &&
           !rg_library_exports(code, "vk_icdGetInstanceProcAddr");
}

static bool is_driver(const char *path, const void *code)
{
    (void)path;
    return rg_library_exports(code, "vk_icdGetInstanceProcAddr");
}

// Without layers, the loader returns the driver's own functions. A driver on top of another
// replaces some of these, so several are asked for. A layer that replaces all, such as validation,
// hides the driver, which is then known only if there is just one.
int vk_functions(struct rg_device *device, const void **functions, int max)
{
    static const char *const names[] = {
        "vkCreateComputePipelines", "vkQueueSubmit",   "vkCreateShaderModule",
        "vkCreateBuffer",           "vkCmdDispatch",   "vkWaitForFences",
        "vkAllocateMemory",         "vkDestroyDevice", "vkCreateGraphicsPipelines",
        "vkCmdDrawIndirect"};
    const VkDevice handle = ((struct vk_device *)device)->handle;
    int count = 0;
    for (size_t i = 0; i < sizeof(names) / sizeof(*names) && count < max; i++) {
        const PFN_vkVoidFunction function = vkGetDeviceProcAddr(handle, names[i]);
        const void *code = *(const void *const *)&function;
        if (!code) {
            rg_driver_error("device '%s': vkGetDeviceProcAddr finds no %s", device->info.name,
                            names[i]);
            return -1;
        }
        if (!is_between(code))
            functions[count++] = code;
    }
    const void *drivers[2];
    if (!count && rg_libraries_find(is_driver, drivers, 2) == 1)
        functions[count++] = drivers[0];
    return count;
}
