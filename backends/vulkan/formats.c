#include "backends/vulkan/vulkan.h"

static const VkFormat formats[RG_FORMAT_COUNT] = {
    [RG_RGBA8] = VK_FORMAT_R8G8B8A8_UNORM,
    [RG_RGBA16F] = VK_FORMAT_R16G16B16A16_SFLOAT,
    [RG_RGBA32F] = VK_FORMAT_R32G32B32A32_SFLOAT,
    [RG_R32F] = VK_FORMAT_R32_SFLOAT,
    [RG_R16F] = VK_FORMAT_R16_SFLOAT,
    [RG_RG11B10F] = VK_FORMAT_B10G11R11_UFLOAT_PACK32,
    [RG_D32F] = VK_FORMAT_D32_SFLOAT,
};

VkFormat vk_format(enum rg_format format)
{
    return formats[format];
}

VkImageUsageFlags vk_usage(enum rg_format format, unsigned uses)
{
    VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                              VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (uses & RG_USE_STORE)
        usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    if (uses & RG_USE_DRAW)
        usage |= format == RG_D32F ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                   : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    return usage;
}

VkImageUsageFlags vk_input_usage(const struct vk_device *device, enum rg_format format)
{
    const unsigned uses = device->pub.info.limits.formats[format].uses;
    return device->pub.blends && format != RG_D32F && (uses & RG_USE_DRAW)
               ? VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT
               : 0;
}

VkImageAspectFlags vk_aspect(enum rg_format format)
{
    return format == RG_D32F ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}
