// Where the driver's code lies that serves a device.
#include "backends/vulkan/vulkan.h"

// The loader itself, which keeps some functions for itself, or a layer. One that is a driver as
// well, as NVIDIA's is, counts as that.
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

// Without a layer between, the loader hands out the driver's own functions. A driver in front of
// another takes some of them itself, so that several are asked for. A layer that takes all of them,
// such as validation, hides the driver: it is known then where there is but one.
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
        if (code && !is_between(code))
            functions[count++] = code;
    }
    const void *drivers[2];
    if (!count && rg_libraries_find(is_driver, drivers, 2) == 1)
        functions[count++] = drivers[0];
    return count;
}
