#include "backends/vulkan/vulkan.h"

#include <stdlib.h>
#include <string.h>

#include "backends/labels.h"
#include "core/base/alloc.h"
#include "core/base/log.h"

static int vk_list(struct rg_device_info *infos, int max, char *why, size_t why_size)
{
    struct vk_instance instance;
    VkPhysicalDevice devices[RG_MAX_DEVICES];
    int count = 0;
    rg_manifests_begin(&vk_manifests);
    if (vk_instance_open(&instance, VK_UNNAMED, why, why_size))
        count = vk_physical_devices(&instance, devices, max < RG_MAX_DEVICES ? max : RG_MAX_DEVICES,
                                    why, why_size);
    for (int i = 0; i < count; i++)
        if (!vk_describe(devices[i], i, &infos[i], why, why_size)) {
            instance.result = VK_ERROR_UNKNOWN;
            count = 0;
        }
    count = vk_judge(&instance, count, why, why_size); // while the drivers are still loaded
    vk_instance_close(&instance);
    return count;
}

static enum vk_debug debug_wanted(void)
{
    const char *wanted = getenv("RG_VK_VALIDATION");
    return wanted && !strcmp(wanted, "1") ? VK_VALIDATED
           : rg_labels_are_asked()        ? VK_NAMED
                                          : VK_UNNAMED;
}

static bool choose_physical(struct vk_device *device, int index)
{
    char why[160];
    VkPhysicalDevice devices[RG_MAX_DEVICES];
    int count = vk_physical_devices(&device->instance, devices, RG_MAX_DEVICES, why, sizeof(why));
    if (count == 0)
        return rg_driver_error("device 'vulkan': %s", why);
    if (index >= count)
        return rg_driver_error("device 'vulkan:%d': it is gone; %d are left", index, count);
    device->physical = devices[index];
    if (!vk_describe(device->physical, index, &device->pub.info, why, sizeof(why)))
        return rg_driver_error("device '%s': %s", device->pub.info.name, why);
    VkPhysicalDeviceMaintenance3Properties allocation = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceProperties2 properties = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &allocation};
    vkGetPhysicalDeviceProperties2(device->physical, &properties);
    device->limits = properties.properties.limits;
    device->max_allocation_bytes = allocation.maxMemoryAllocationSize;
    vkGetPhysicalDeviceMemoryProperties(device->physical, &device->memory);
    device->direct = vk_memory_is_direct(&device->memory);
    vk_queue_family(device->physical, &device->family);
    const uint32_t bits = device->family.timestamp_bits;
    device->ticks_mask = bits == 0 ? 0 : UINT64_MAX >> (64 - bits);
    return true;
}

// Finds out whether a pixel's fragments may run in the order of items and read what it holds.
static bool find_order(struct vk_device *device,
                       VkPhysicalDeviceRasterizationOrderAttachmentAccessFeaturesEXT *order)
{
    VkPhysicalDeviceFeatures2 able = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                      .pNext = order};
    if (!vk_find_extension(device, VK_EXT_RASTERIZATION_ORDER_ATTACHMENT_ACCESS_EXTENSION_NAME,
                           &device->ordered))
        return false;
    if (!device->ordered)
        return true;
    vkGetPhysicalDeviceFeatures2(device->physical, &able);
    order->rasterizationOrderDepthAttachmentAccess = VK_FALSE;
    order->rasterizationOrderStencilAttachmentAccess = VK_FALSE;
    device->ordered = order->rasterizationOrderColorAttachmentAccess;
    return true;
}

static void find_names(struct vk_device *device)
{
    const VkInstance instance = device->instance.handle;
    device->set_name = (PFN_vkSetDebugUtilsObjectNameEXT)vkGetInstanceProcAddr(
        instance, "vkSetDebugUtilsObjectNameEXT");
    device->begin_group = (PFN_vkCmdBeginDebugUtilsLabelEXT)vkGetInstanceProcAddr(
        instance, "vkCmdBeginDebugUtilsLabelEXT");
    device->end_group = (PFN_vkCmdEndDebugUtilsLabelEXT)vkGetInstanceProcAddr(
        instance, "vkCmdEndDebugUtilsLabelEXT");
}

static bool create_logical(struct vk_device *device)
{
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
        .queueFamilyIndex = device->family.index,
        .queueCount = 1,
        .pQueuePriorities = &priority,
    };
    VkPhysicalDeviceFeatures able;
    vkGetPhysicalDeviceFeatures(device->physical, &able);
    const VkPhysicalDeviceFeatures wanted = {
        .fragmentStoresAndAtomics = able.fragmentStoresAndAtomics,
        .occlusionQueryPrecise = able.occlusionQueryPrecise,
        .geometryShader = able.geometryShader, // of native devices
    };
    static const char *const extensions[] = {
        VK_EXT_RASTERIZATION_ORDER_ATTACHMENT_ACCESS_EXTENSION_NAME};
    VkPhysicalDeviceRasterizationOrderAttachmentAccessFeaturesEXT order = {
        .sType =
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RASTERIZATION_ORDER_ATTACHMENT_ACCESS_FEATURES_EXT};
    if (!find_order(device, &order))
        return false;
    const VkDeviceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .pNext = device->ordered ? &order : NULL,
        .enabledExtensionCount = device->ordered,
        .ppEnabledExtensionNames = extensions,
        .queueCreateInfoCount = 1,
        .pQueueCreateInfos = &queue,
        .pEnabledFeatures = &wanted,
    };
    if (!vk_try("device", device->pub.info.name, vkCreateDevice, device->physical, &info, NULL,
                &device->handle))
        return false;
    vkGetDeviceQueue(device->handle, device->family.index, 0, &device->queue);
    if (debug_wanted() != VK_UNNAMED)
        find_names(device);
    return true;
}

static bool create_shared_objects(struct vk_device *device)
{
    const VkQueryPoolCreateInfo queries = {
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
        .queryType = VK_QUERY_TYPE_TIMESTAMP,
        .queryCount = 1,
    };
    const char *name = device->pub.info.name;
    return vk_samplers_create(device) &&
           (!device->ticks_mask || vk_try("device", name, vkCreateQueryPool, device->handle,
                                          &queries, NULL, &device->timestamp)) &&
           vk_batches_create(device);
}

static bool vk_destroy(struct rg_device *device)
{
    struct vk_device *vk = (struct vk_device *)device;
    bool is_idle = true;
    if (vk->handle) {
        is_idle =
            vk_close_check(vkDeviceWaitIdle(vk->handle), "vkDeviceWaitIdle", device->info.name);
        vk_fixed_close(vk);
        vk_draw_close(vk);
        vk_batches_destroy(vk);
        vkDestroyQueryPool(vk->handle, vk->timestamp, NULL);
        vk_samplers_destroy(vk);
        vkDestroyDevice(vk->handle, NULL);
    }
    vk_instance_close(&vk->instance);
    free(vk);
    return is_idle;
}

static struct rg_device *vk_create(int index)
{
    struct vk_device *device = rg_alloc(1, sizeof(*device), "device 'vulkan'");
    if (!device)
        return NULL;
    char why[256];
    if (!vk_instance_open(&device->instance, debug_wanted(), why, sizeof(why))) {
        free(device);
        return rg_driver_error_null("device 'vulkan': %s", why);
    }
    bool created =
        choose_physical(device, index) && create_logical(device) && create_shared_objects(device);
    if (vk_healthy(device) && created)
        return &device->pub;
    vk_destroy(&device->pub);
    return NULL;
}

const struct rg_backend rg_backend_vulkan = {
    .name = "vulkan",
    .package = VK_PACKAGE,
    .rough = true,
    .packed = true,
    .list = vk_list,
    .create = vk_create,
    .can_blend = vk_can_blend,
    .functions = vk_functions,
    .destroy = vk_destroy,
    .buf_create = vk_buf_create,
    .buf_destroy = vk_buf_destroy,
    .buf_write = vk_buf_write,
    .buf_read = vk_buf_read,
    .image_create = vk_image_create,
    .image_destroy = vk_image_destroy,
    .image_write = vk_image_write,
    .image_read = vk_image_read,
    .image_clear = vk_image_clear,
    .image_make_levels = vk_image_make_levels,
    .pass_create = vk_pass_create,
    .pass_destroy = vk_pass_destroy,
    .pass_code = vk_pass_code,
    .pass_run = vk_pass_run,
    .fixed_draw = vk_fixed_draw,
    .sync = vk_sync,
    .time = vk_time,
};
