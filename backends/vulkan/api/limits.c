// A device's limits, which core/device checks.
#include "backends/vulkan/vulkan.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "kernels/dialect/draw/clip.h"

static int at_most_int(uint64_t value)
{
    return value < INT_MAX ? (int)value : INT_MAX;
}

static int64_t at_most_int64(uint64_t value)
{
    return value < INT64_MAX ? (int64_t)value : INT64_MAX;
}

// Depth images need a queue that draws: another queue cannot even write to them.
static unsigned uses_of(VkPhysicalDevice device, enum rg_format format, bool draws)
{
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(device, vk_format(format), &properties);
    const VkFormatFeatureFlags able = properties.optimalTilingFeatures;
    const VkFormatFeatureFlags drawn_to = format == RG_D32F
                                              ? VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT
                                              : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
    unsigned uses = format != RG_D32F || draws ? RG_USE_FETCH : 0;
    if (uses && able & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT)
        uses |= RG_USE_STORE;
    if (uses && able & drawn_to)
        uses |= RG_USE_DRAW;
    if (uses && able & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT)
        uses |= RG_USE_BLEND;
    const VkFormatFeatureFlags filtered =
        VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT |
        (format != RG_D32F ? VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT : 0);
    if (uses && (able & filtered) == filtered)
        uses |= RG_USE_FILTER;
    return uses;
}

// A driver may allow less for one format than for images in general. `*result` keeps an error.
static struct rg_format_limits format_limits(VkPhysicalDevice device, enum rg_format format,
                                             bool draws, VkResult *result)
{
    const unsigned uses = uses_of(device, format, draws);
    VkImageFormatProperties most;
    VkResult found = VK_ERROR_FORMAT_NOT_SUPPORTED;
    if (uses)
        found = vkGetPhysicalDeviceImageFormatProperties(device, vk_format(format),
                                                         VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL,
                                                         vk_usage(format, uses), 0, &most);
    if (found < 0 && found != VK_ERROR_FORMAT_NOT_SUPPORTED)
        *result = found;
    if (found != VK_SUCCESS)
        return (struct rg_format_limits){0};
    const uint32_t side =
        most.maxExtent.width < most.maxExtent.height ? most.maxExtent.width : most.maxExtent.height;
    return (struct rg_format_limits){
        .uses = uses,
        .max_px = at_most_int(side),
        .max_layers = at_most_int(most.maxArrayLayers),
        .max_levels = at_most_int(most.maxMipLevels),
        .max_bytes = at_most_int64(most.maxResourceSize),
    };
}

// Says why the device cannot draw: corners stay on their grid only in a viewport of the size in
// kernels/dialect/draw/clip.h.
static void say_no_draws(VkPhysicalDevice device, const VkPhysicalDeviceLimits *l, bool draws,
                         char *why, size_t size)
{
    VkPhysicalDeviceFeatures able;
    vkGetPhysicalDeviceFeatures(device, &able);
    const uint32_t *px = l->maxViewportDimensions;
    if (!draws)
        snprintf(why, size, "has no queue that draws");
    else if (!able.fragmentStoresAndAtomics)
        snprintf(why, size, "lets no fragment write (fragmentStoresAndAtomics is false)");
    else if (px[0] < RG_VIEWPORT_PX || px[1] < RG_VIEWPORT_PX || l->subPixelPrecisionBits < 8)
        snprintf(why, size,
                 "has viewports of %ux%u px and %u bits below a pixel; %d px and 8 bits are needed",
                 px[0], px[1], l->subPixelPrecisionBits, RG_VIEWPORT_PX);
}

static bool counts_exactly(VkPhysicalDevice device)
{
    VkPhysicalDeviceFeatures able;
    vkGetPhysicalDeviceFeatures(device, &able);
    return able.occlusionQueryPrecise;
}

bool vk_find_extension(const struct vk_device *device, const char *name, bool *is_there)
{
    uint32_t count = 0;
    const char *own = device->pub.info.name;
    *is_there = false;
    if (!vk_try("device", own, vkEnumerateDeviceExtensionProperties, device->physical, NULL, &count,
                NULL))
        return false;
    VkExtensionProperties *all = rg_alloc(count + 1, sizeof(*all), "extensions");
    const bool ok = all && vk_try("device", own, vkEnumerateDeviceExtensionProperties,
                                  device->physical, NULL, &count, all);
    for (uint32_t i = 0; ok && i < count; i++)
        *is_there = *is_there || !strcmp(all[i].extensionName, name);
    free(all);
    return ok;
}

// Says why no native device can be opened: its geometry stage draws items, which are not packed.
static void say_no_native(VkPhysicalDevice device, bool draws, char *why, size_t size)
{
    VkPhysicalDeviceFeatures able;
    vkGetPhysicalDeviceFeatures(device, &able);
    if (!draws)
        snprintf(why, size, "has no queue that draws");
    else if (!able.geometryShader)
        snprintf(why, size, "lacks geometryShader");
}

struct rg_limits vk_limits(VkPhysicalDevice device, const struct vk_family *family,
                           const VkPhysicalDeviceLimits *l, uint64_t max_allocation_bytes,
                           VkResult *result)
{
    const uint64_t max_bytes = l->maxStorageBufferRange < max_allocation_bytes
                                   ? l->maxStorageBufferRange
                                   : max_allocation_bytes;
    const uint32_t sampled = l->maxPerStageDescriptorSampledImages,
                   samplers = l->maxPerStageDescriptorSamplers;
    struct rg_limits limits = {
        .max_objects = at_most_int(l->maxMemoryAllocationCount) - VK_OWN_ALLOCATIONS,
        .max_buffer_bytes = (int64_t)(max_bytes / 4 * 4),
        .max_image_px = at_most_int(l->maxImageDimension2D),
        .max_image_layers = at_most_int(l->maxImageArrayLayers),
        .group_items = 64,
        .slot_count = {.buffers = at_most_int(l->maxPerStageDescriptorStorageBuffers),
                       .images = at_most_int(sampled < samplers ? sampled : samplers),
                       .out_images = at_most_int(l->maxPerStageDescriptorStorageImages)},
        .slot_end = {RG_MAX_SLOTS, RG_MAX_SLOTS, RG_MAX_SLOTS},
        .has_clock = family->timestamp_bits > 0,
    };
    for (int i = 0; i < 3; i++)
        limits.max_groups[i] = at_most_int(l->maxComputeWorkGroupCount[i]);
    for (int f = RG_FORMAT_NONE + 1; f < RG_FORMAT_COUNT; f++)
        limits.formats[f] = format_limits(device, (enum rg_format)f, family->draws, result);
    limits.has_queries = family->draws && counts_exactly(device);
    say_no_native(device, family->draws, limits.no_native, sizeof(limits.no_native));
    say_no_draws(device, l, family->draws, limits.no_draws, sizeof(limits.no_draws));
    return limits;
}
