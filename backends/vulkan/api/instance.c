#include "backends/vulkan/vulkan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

enum { MAX_PHYSICAL = 64 };

static VKAPI_ATTR VkBool32 VKAPI_CALL complain(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                               VkDebugUtilsMessageTypeFlagsEXT types,
                                               const VkDebugUtilsMessengerCallbackDataEXT *data,
                                               void *user)
{
    (void)severity;
    (void)types;
    struct vk_instance *instance = user;
    instance->complaints++;
    if (data->cmdBufLabelCount)
        rg_driver_error("Vulkan validation: kernel '%s': %s", data->pCmdBufLabels[0].pLabelName,
                        data->pMessage);
    else
        rg_driver_error("Vulkan validation: %s", data->pMessage);
    return VK_FALSE;
}

// Receives validation messages only. The loader's messages are about missing drivers, and
// performance hints object to the general layout, which we chose.
static VkDebugUtilsMessengerCreateInfoEXT messenger_info(struct vk_instance *instance)
{
    return (VkDebugUtilsMessengerCreateInfoEXT){
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = complain,
        .pUserData = instance,
    };
}

static VkResult create_instance(struct vk_instance *instance, enum vk_debug debug)
{
    const bool validate = debug == VK_VALIDATED;
    static const char *const layers[] = {"VK_LAYER_KHRONOS_validation"};
    static const char *const extensions[] = {"VK_EXT_debug_utils", "VK_EXT_validation_features"};
    static const VkValidationFeatureEnableEXT enabled[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(instance);
    const VkValidationFeaturesEXT features = {
        .sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
        .pNext = &messenger,
        .enabledValidationFeatureCount = 1,
        .pEnabledValidationFeatures = enabled,
    };
    const VkApplicationInfo application = {
        .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
        .pApplicationName = "raingauge",
        .apiVersion = VK_API_VERSION_1_2,
    };
    const VkInstanceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
        .pNext = validate ? &features : NULL,
        .pApplicationInfo = &application,
        .enabledLayerCount = validate,
        .ppEnabledLayerNames = layers,
        .enabledExtensionCount = debug,
        .ppEnabledExtensionNames = extensions,
    };
    VkResult result = vkCreateInstance(&info, NULL, &instance->handle);
    char paths[4096];
    // Debian 12's loader gives up all drivers for one damaged file.
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY &&
        rg_manifests_sound(&vk_manifests, paths, sizeof(paths))) {
        setenv("VK_DRIVER_FILES", paths, 1);
        result = vkCreateInstance(&info, NULL, &instance->handle);
        unsetenv("VK_DRIVER_FILES");
    }
    return result;
}

static void say_no_instance(VkResult result, enum vk_debug debug, char *why, size_t why_size)
{
    if (result == VK_ERROR_EXTENSION_NOT_PRESENT && debug == VK_NAMED)
        snprintf(why, why_size,
                 "no VK_EXT_debug_utils for RG_LABELS=1: vkCreateInstance failed with %s; unset it",
                 vk_result_name(result));
    else if (result == VK_ERROR_LAYER_NOT_PRESENT || result == VK_ERROR_EXTENSION_NOT_PRESENT)
        snprintf(why, why_size,
                 "no validation layer for RG_VK_VALIDATION=1: vkCreateInstance failed with %s; "
                 "the Debian package vulkan-validationlayers brings it",
                 vk_result_name(result));
    else
        snprintf(why, why_size, "no Vulkan driver: vkCreateInstance failed with %s",
                 vk_result_name(result));
}

bool vk_instance_open(struct vk_instance *instance, enum vk_debug debug, char *why, size_t why_size)
{
    // Keeps lavapipe and others from announcing themselves on stderr. The 0 keeps the user's own
    // value.
    setenv("MESA_VK_IGNORE_CONFORMANCE_WARNING", "1", 0);
    memset(instance, 0, sizeof(*instance));
    uint32_t version = VK_API_VERSION_1_0;
    instance->result = vkEnumerateInstanceVersion(&version);
    if (instance->result == VK_SUCCESS && version < VK_API_VERSION_1_2) {
        snprintf(why, why_size, "the Vulkan loader is %u.%u and 1.2 is needed",
                 VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version));
        return false;
    }
    if (instance->result == VK_SUCCESS)
        instance->result = create_instance(instance, debug);
    if (instance->result != VK_SUCCESS) {
        say_no_instance(instance->result, debug, why, why_size);
        instance->handle = VK_NULL_HANDLE;
        return false;
    }
    PFN_vkCreateDebugUtilsMessengerEXT create =
        debug == VK_VALIDATED ? (PFN_vkCreateDebugUtilsMessengerEXT)vkGetInstanceProcAddr(
                                    instance->handle, "vkCreateDebugUtilsMessengerEXT")
                              : NULL;
    const VkDebugUtilsMessengerCreateInfoEXT info = messenger_info(instance);
    if (create)
        create(instance->handle, &info, NULL, &instance->messenger);
    return true;
}

void vk_instance_close(struct vk_instance *instance)
{
    PFN_vkDestroyDebugUtilsMessengerEXT destroy =
        instance->messenger ? (PFN_vkDestroyDebugUtilsMessengerEXT)vkGetInstanceProcAddr(
                                  instance->handle, "vkDestroyDebugUtilsMessengerEXT")
                            : NULL;
    if (destroy)
        destroy(instance->handle, instance->messenger, NULL);
    if (instance->handle)
        vkDestroyInstance(instance->handle, NULL);
}

bool vk_queue_family(VkPhysicalDevice device, struct vk_family *family)
{
    static const VkQueueFlags wishes[] = {VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT,
                                          VK_QUEUE_COMPUTE_BIT};
    VkQueueFamilyProperties families[32];
    uint32_t count = 32;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families);
    for (int wish = 0; wish < 2; wish++) {
        for (uint32_t i = 0; i < count; i++) {
            if ((families[i].queueFlags & wishes[wish]) == wishes[wish]) {
                *family = (struct vk_family){i, families[i].timestampValidBits, wish == 0};
                return true;
            }
        }
    }
    return false;
}

static bool is_usable(VkPhysicalDevice device, const VkPhysicalDeviceProperties *properties)
{
    struct vk_family family;
    return properties->apiVersion >= VK_API_VERSION_1_2 && vk_queue_family(device, &family);
}

int vk_physical_devices(struct vk_instance *instance, VkPhysicalDevice *devices, int max, char *why,
                        size_t why_size)
{
    VkPhysicalDevice all[MAX_PHYSICAL];
    VkPhysicalDeviceProperties properties[MAX_PHYSICAL];
    uint32_t all_count = MAX_PHYSICAL;
    const VkResult result = vkEnumeratePhysicalDevices(instance->handle, &all_count, all);
    instance->result = result;
    if (result < 0 || all_count == 0) {
        snprintf(why, why_size, "no Vulkan device: vkEnumeratePhysicalDevices %s%s",
                 result < 0 ? "failed with " : "found none",
                 result < 0 ? vk_result_name(result) : "");
        return 0;
    }
    for (uint32_t i = 0; i < all_count; i++)
        vkGetPhysicalDeviceProperties(all[i], &properties[i]);
    int count = 0;
    for (int software = 0; software < 2; software++)
        for (uint32_t i = 0; i < all_count && count < max; i++)
            if ((properties[i].deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU) == software &&
                is_usable(all[i], &properties[i]))
                devices[count++] = all[i];
    if (count == 0)
        snprintf(why, why_size, "'%.80s' has Vulkan %u.%u or no compute queue; 1.2 is needed",
                 properties[0].deviceName, VK_API_VERSION_MAJOR(properties[0].apiVersion),
                 VK_API_VERSION_MINOR(properties[0].apiVersion));
    return count;
}

bool vk_describe(VkPhysicalDevice device, int index, struct rg_device_info *info, char *why,
                 size_t why_size)
{
    VkResult result = VK_SUCCESS;
    VkPhysicalDeviceDriverProperties driver = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceMaintenance3Properties allocation = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES, .pNext = &driver};
    VkPhysicalDeviceProperties2 all = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                       .pNext = &allocation};
    vkGetPhysicalDeviceProperties2(device, &all);
    const VkPhysicalDeviceProperties *p = &all.properties;
    memset(info, 0, sizeof(*info));
    if (index == 0)
        snprintf(info->name, sizeof(info->name), "vulkan");
    else
        snprintf(info->name, sizeof(info->name), "vulkan:%d", index);
    snprintf(info->device, sizeof(info->device), "%.*s", (int)sizeof(info->device) - 1,
             p->deviceName);
    // NVIDIA's driverInfo is a bare version, Mesa's begins with "Mesa".
    snprintf(info->driver, sizeof(info->driver), "%.70s %.80s", driver.driverName,
             driver.driverInfo);
    snprintf(info->api, sizeof(info->api), "Vulkan %u.%u.%u", VK_API_VERSION_MAJOR(p->apiVersion),
             VK_API_VERSION_MINOR(p->apiVersion), VK_API_VERSION_PATCH(p->apiVersion));
    info->software = p->deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    info->tier = info->software ? RG_T0 : RG_T1;
    struct vk_family family = {0};
    vk_queue_family(device, &family);
    info->limits =
        vk_limits(device, &family, &p->limits, allocation.maxMemoryAllocationSize, &result);
    if (result < 0)
        snprintf(why, why_size,
                 "no Vulkan device: vkGetPhysicalDeviceImageFormatProperties failed with %s",
                 vk_result_name(result));
    return result >= 0;
}
