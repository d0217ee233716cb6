// Tells whether a machine without a Vulkan device lacks a driver, or has one that fails.
#include "backends/vulkan/vulkan.h"

#include <dlfcn.h>
#include <stdio.h>

#include <vulkan/vk_icd.h>

static int say(char *why, size_t why_size, const char *call, VkResult result)
{
    snprintf(why, why_size, "%s failed with %s", call, vk_result_name(result));
    return -1;
}

// The loader skips a driver that cannot list its devices, so the driver is asked directly, as the
// loader does it.
static int ask_driver(void *library, char *why, size_t why_size)
{
    uint32_t version = 5, count = 0;
    PFN_vkNegotiateLoaderICDInterfaceVersion negotiate =
        (PFN_vkNegotiateLoaderICDInterfaceVersion)dlsym(library,
                                                        "vk_icdNegotiateLoaderICDInterfaceVersion");
    VkResult result = negotiate ? negotiate(&version) : VK_SUCCESS;
    if (result < 0)
        return say(why, why_size, "vk_icdNegotiateLoaderICDInterfaceVersion", result);
    PFN_vkGetInstanceProcAddr get =
        (PFN_vkGetInstanceProcAddr)dlsym(library, "vk_icdGetInstanceProcAddr");
    PFN_vkCreateInstance create =
        get ? (PFN_vkCreateInstance)get(VK_NULL_HANDLE, "vkCreateInstance") : NULL;
    if (!create)
        return 0; // an old driver, with another interface to the loader
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = VK_API_VERSION_1_2};
    const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                       .pApplicationInfo = &application};
    VkInstance instance = VK_NULL_HANDLE;
    result = create(&info, NULL, &instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        return 0;
    if (result < 0)
        return say(why, why_size, "vkCreateInstance", result);
    PFN_vkEnumeratePhysicalDevices enumerate =
        (PFN_vkEnumeratePhysicalDevices)get(instance, "vkEnumeratePhysicalDevices");
    PFN_vkDestroyInstance destroy = (PFN_vkDestroyInstance)get(instance, "vkDestroyInstance");
    result = enumerate ? enumerate(instance, &count, NULL) : VK_SUCCESS;
    if (destroy)
        destroy(instance, NULL);
    return result < 0 ? say(why, why_size, "vkEnumeratePhysicalDevices", result) : (int)count;
}

const struct rg_manifest_rules vk_manifests = {
    .instead = {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"},
    .beside = {"VK_ADD_DRIVER_FILES"},
    .places = {{"XDG_CONFIG_HOME", "~/.config"},
               {"XDG_CONFIG_DIRS", "/etc/xdg"},
               {NULL, "/etc"},
               {"XDG_DATA_HOME", "~/.local/share"},
               {"XDG_DATA_DIRS", "/usr/local/share:/usr/share"}},
    .below = "/vulkan/icd.d",
    .ending = ".json",
    .beside_file = true,
    .functions = {"vk_icdGetInstanceProcAddr", "vkGetInstanceProcAddr"},
    .ask = ask_driver,
    .package = VK_PACKAGE,
};

int vk_judge(const struct vk_instance *instance, int count, char *why, size_t why_size)
{
    enum rg_manifest_state state = RG_MANIFEST_NONE;
    // Debian 12's loader reports a failed initialisation when there is no device at all.
    if (instance->result == VK_ERROR_INITIALIZATION_FAILED)
        state = RG_MANIFEST_UNCLEAR;
    else if (instance->result < 0 && instance->result != VK_ERROR_INCOMPATIBLE_DRIVER)
        state = RG_MANIFEST_FAILED;
    return rg_manifests_judge(&vk_manifests, count, state, why, why_size);
}
