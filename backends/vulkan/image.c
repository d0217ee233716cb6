#include "backends/vulkan/vulkan.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/device/formats.h"
#include "kernels/dialect/image/memory.h"

// All that this backend may do with images of the format.
static VkImageUsageFlags usage(const struct vk_device *device, enum rg_format format)
{
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(device->physical, vk_format(format), &properties);
    const VkFormatFeatureFlags able = properties.optimalTilingFeatures;
    VkImageUsageFlags flags = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                              VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (able & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT)
        flags |= VK_IMAGE_USAGE_STORAGE_BIT;
    if (able & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT)
        flags |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (able & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT)
        flags |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    return flags;
}

static VkImageCreateInfo image_info(const struct vk_device *device,
                                    const struct rg_image_desc *desc)
{
    return (VkImageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = vk_format(desc->format),
        .extent = {(uint32_t)desc->width, (uint32_t)desc->height, 1},
        .mipLevels = (uint32_t)desc->levels,
        .arrayLayers = (uint32_t)desc->layers,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = usage(device, desc->format),
        .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
        .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
    };
}

// A driver may allow less for a format than for images in general.
static bool check_supported(const struct vk_device *device, const VkImageCreateInfo *info,
                            const struct rg_image_desc *desc, const char *name)
{
    VkImageFormatProperties most;
    if (desc->format == RG_D32F && !device->family.draws)
        return rg_unsupported("image '%s': %s has no queue that draws, and so no images of depth",
                              name, device->pub.info.name);
    if (!vk_try("image", name, vkGetPhysicalDeviceImageFormatProperties, device->physical,
                info->format, info->imageType, info->tiling, info->usage, info->flags, &most))
        return false;
    uint32_t header[RG_MAX_LEVELS];
    int64_t bytes = rg_image_layout(desc, header) * 4;
    if (info->extent.width > most.maxExtent.width || info->extent.height > most.maxExtent.height ||
        info->mipLevels > most.maxMipLevels || info->arrayLayers > most.maxArrayLayers ||
        (uint64_t)bytes > most.maxResourceSize)
        return rg_error("image '%s': %dx%d of %s with %d layers and %d levels; %s allows %ux%u, %u "
                        "layers, %u levels and %llu bytes",
                        name, desc->width, desc->height, rg_format_name(desc->format), desc->layers,
                        desc->levels, device->pub.info.name, most.maxExtent.width,
                        most.maxExtent.height, most.maxArrayLayers, most.maxMipLevels,
                        (unsigned long long)most.maxResourceSize);
    return true;
}

static bool create_view(struct vk_device *device, const struct vk_image *image,
                        const VkImageCreateInfo *info, uint32_t levels, VkImageAspectFlags aspect,
                        const char *name, VkImageView *view)
{
    const VkImageViewCreateInfo view_info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image->handle,
        .viewType = VK_IMAGE_VIEW_TYPE_2D_ARRAY,
        .format = info->format,
        .subresourceRange = {aspect, 0, levels, 0, info->arrayLayers},
    };
    return vk_try("image", name, vkCreateImageView, device->handle, &view_info, NULL, view);
}

static bool create_memory(struct vk_device *device, struct vk_image *image, const char *name)
{
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device->handle, image->handle, &needs);
    return vk_memory_create(device, &needs, VK_USE_DEVICE, "image", name, &image->memory) &&
           vk_try("image", name, vkBindImageMemory, device->handle, image->handle,
                  image->memory.handle, 0);
}

// Images stay in the general layout, which everything may read and write.
static bool make_general(struct vk_device *device, const struct vk_image *image,
                         VkImageAspectFlags aspect)
{
    struct vk_batch *batch = vk_record(device);
    if (!batch)
        return false;
    const VkImageMemoryBarrier general = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
        .dstAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
        .oldLayout = VK_IMAGE_LAYOUT_UNDEFINED,
        .newLayout = VK_IMAGE_LAYOUT_GENERAL,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image->handle,
        .subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS},
    };
    vkCmdPipelineBarrier(batch->commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                         VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT, 0,
                         0, NULL, 0, NULL, 1, &general);
    return true;
}

static bool create(struct vk_device *device, struct vk_image *image,
                   const struct rg_image_desc *desc, const char *name)
{
    const VkImageCreateInfo info = image_info(device, desc);
    if (!check_supported(device, &info, desc, name) ||
        !vk_try("image", name, vkCreateImage, device->handle, &info, NULL, &image->handle))
        return false;
    vk_name(device, VK_OBJECT_TYPE_IMAGE, VK_HANDLE(image->handle), name);
    const VkImageAspectFlags aspect = vk_aspect(desc->format);
    bool storage = info.usage & VK_IMAGE_USAGE_STORAGE_BIT;
    return create_memory(device, image, name) &&
           create_view(device, image, &info, info.mipLevels, aspect, name, &image->sampled) &&
           (!storage || create_view(device, image, &info, 1, aspect, name, &image->stored)) &&
           make_general(device, image, aspect);
}

static void destroy(struct vk_device *device, struct vk_image *image)
{
    vk_target_forget(device, image);
    vkDestroyImageView(device->handle, image->stored, NULL);
    vkDestroyImageView(device->handle, image->sampled, NULL);
    vkDestroyImage(device->handle, image->handle, NULL);
    vk_memory_destroy(device, &image->memory);
    free(image);
}

struct rg_image *vk_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                 const char *name)
{
    struct vk_device *vk = (struct vk_device *)device;
    struct vk_image *image = rg_alloc(1, sizeof(*image), name);
    if (!image)
        return NULL;
    bool created = create(vk, image, desc, name);
    if (vk_healthy(vk) && created)
        return &image->pub;
    vk_wait(vk); // the change of layout may be recorded
    destroy(vk, image);
    return NULL;
}

void vk_image_destroy(struct rg_image *image)
{
    destroy((struct vk_device *)image->device, (struct vk_image *)image);
}
