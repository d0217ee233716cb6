#include "backends/vulkan/api/fixed/fixed.h"

VkFormat vk_fixed_colour(int format)
{
    static const VkFormat all[RG_FIXED_FORMAT_COUNT] = {
        VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT};
    return all[format];
}

VkFormat vk_fixed_depth(int depth)
{
    static const VkFormat all[] = {VK_FORMAT_UNDEFINED, VK_FORMAT_D16_UNORM, VK_FORMAT_D32_SFLOAT,
                                   VK_FORMAT_D32_SFLOAT_S8_UINT};
    return all[depth];
}

VkFormat vk_fixed_store(int store)
{
    static const VkFormat all[RG_FIXED_STORES] = {
        VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_A2B10G10R10_UNORM_PACK32,
        VK_FORMAT_B10G11R11_UFLOAT_PACK32};
    return all[store];
}

VkFormat vk_fixed_texels(int texels)
{
    static const VkFormat all[] = {VK_FORMAT_UNDEFINED,
                                   VK_FORMAT_R8G8B8A8_UNORM,
                                   VK_FORMAT_R8G8B8A8_SRGB,
                                   VK_FORMAT_D32_SFLOAT,
                                   VK_FORMAT_BC1_RGBA_UNORM_BLOCK,
                                   VK_FORMAT_BC3_UNORM_BLOCK,
                                   VK_FORMAT_ETC2_R8G8B8_UNORM_BLOCK};
    return all[texels];
}

static VkImageAspectFlags aspect_of(VkFormat format)
{
    return format == VK_FORMAT_D32_SFLOAT_S8_UINT
               ? VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT
           : format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM
               ? VK_IMAGE_ASPECT_DEPTH_BIT
               : VK_IMAGE_ASPECT_COLOR_BIT;
}

bool vk_fixed_image(struct vk_fixed_job *job, const VkImageCreateInfo *info, VkImageViewType type,
                    struct vk_fixed_image *image)
{
    struct vk_device *own = &job->fixed->own;
    VkMemoryRequirements needs;
    image->aspect = aspect_of(info->format);
    image->layers = info->arrayLayers;
    if (!vk_fixed_try(job, vkCreateImage, own->handle, info, NULL, &image->handle))
        return false;
    vk_name(own, VK_OBJECT_TYPE_IMAGE, VK_HANDLE(image->handle), job->feature);
    vkGetImageMemoryRequirements(own->handle, image->handle, &needs);
    if (!vk_memory_create(own, &needs, VK_USE_DEVICE, "feature", job->feature, &image->memory) ||
        !vk_fixed_try(job, vkBindImageMemory, own->handle, image->handle, image->memory.handle, 0))
        return false;
    const VkImageViewCreateInfo view = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image->handle,
        .viewType = type,
        .format = info->format,
        .subresourceRange = {image->aspect, 0, info->mipLevels, 0, info->arrayLayers},
    };
    return vk_fixed_try(job, vkCreateImageView, own->handle, &view, NULL, &image->view);
}

void vk_fixed_image_destroy(struct vk_fixed_job *job, struct vk_fixed_image *image)
{
    struct vk_device *own = &job->fixed->own;
    vkDestroyImageView(own->handle, image->view, NULL);
    vkDestroyImage(own->handle, image->handle, NULL);
    vk_memory_destroy(own, &image->memory);
}

void vk_fixed_turn(VkCommandBuffer commands, const struct vk_fixed_image *image, VkImageLayout from,
                   VkImageLayout to)
{
    const VkAccessFlags all = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    const VkImageMemoryBarrier barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
        .srcAccessMask = all,
        .dstAccessMask = all,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image->handle,
        .subresourceRange = {image->aspect, 0, VK_REMAINING_MIP_LEVELS, 0,
                             VK_REMAINING_ARRAY_LAYERS},
    };
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, NULL, 0, NULL, 1, &barrier);
}

void vk_fixed_barrier(VkCommandBuffer commands)
{
    const VkMemoryBarrier barrier = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
        .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
    };
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                         &barrier, 0, NULL, 0, NULL);
}
