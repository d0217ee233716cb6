#include "backends/vulkan/vulkan.h"

#include <stdlib.h>

#include "core/base/alloc.h"

// Whether a native device may sample an image as a cube.
static bool is_cube(const struct vk_device *device, const struct rg_image_desc *desc)
{
    return device->pub.info.native && desc->layers == 6 && desc->width == desc->height &&
           desc->format != RG_D32F;
}

static VkImageCreateInfo image_info(const struct vk_device *device,
                                    const struct rg_image_desc *desc)
{
    return (VkImageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .flags = is_cube(device, desc) ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = vk_format(desc->format),
        .extent = {(uint32_t)desc->width, (uint32_t)desc->height, 1},
        .mipLevels = (uint32_t)desc->levels,
        .arrayLayers = (uint32_t)desc->layers,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        // The usage flags for everything that this backend does with images of the format.
        .usage = vk_usage(desc->format, device->pub.info.limits.formats[desc->format].uses) |
                 vk_input_usage(device, desc->format),
        .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
        .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
    };
}

static bool create_view(struct vk_device *device, const struct vk_image *image,
                        const VkImageCreateInfo *info, VkImageViewType type, uint32_t levels,
                        const char *name, VkImageView *view)
{
    const VkImageAspectFlags aspect = info->format == VK_FORMAT_D32_SFLOAT
                                          ? VK_IMAGE_ASPECT_DEPTH_BIT
                                          : VK_IMAGE_ASPECT_COLOR_BIT;
    const VkImageViewCreateInfo view_info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image->handle,
        .viewType = type,
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

// Images stay in the general layout, which all commands may read and write.
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
    if (!vk_try("image", name, vkCreateImage, device->handle, &info, NULL, &image->handle))
        return false;
    vk_name(device, VK_OBJECT_TYPE_IMAGE, VK_HANDLE(image->handle), name);
    const VkImageAspectFlags aspect = vk_aspect(desc->format);
    const VkImageViewType array = VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    bool storage = info.usage & VK_IMAGE_USAGE_STORAGE_BIT;
    return create_memory(device, image, name) &&
           create_view(device, image, &info, array, info.mipLevels, name, &image->sampled) &&
           (!storage || create_view(device, image, &info, array, 1, name, &image->stored)) &&
           (!info.flags || create_view(device, image, &info, VK_IMAGE_VIEW_TYPE_CUBE,
                                       info.mipLevels, name, &image->cube)) &&
           make_general(device, image, aspect);
}

static void destroy(struct vk_device *device, struct vk_image *image)
{
    vk_target_forget(device, image);
    vkDestroyImageView(device->handle, image->cube, NULL);
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
    vk_wait(vk); // the layout change may still be recorded
    destroy(vk, image);
    return NULL;
}

void vk_image_destroy(struct rg_image *image)
{
    destroy((struct vk_device *)image->device, (struct vk_image *)image);
}
