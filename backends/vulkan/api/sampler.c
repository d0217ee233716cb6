// The samplers: one that fetches texels, and those by which native devices filter and compare.
#include "backends/vulkan/vulkan.h"

static VkSamplerCreateInfo sampler_info(enum rg_sampler sampling, bool filters_depth)
{
    const bool compares = sampling == RG_SAMPLED_SHADOW;
    const bool filters = compares ? filters_depth : sampling != RG_TEXELS;
    const VkFilter filter = filters ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    const VkSamplerAddressMode wrap = sampling == RG_SAMPLED_TILED
                                          ? VK_SAMPLER_ADDRESS_MODE_REPEAT
                                          : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    return (VkSamplerCreateInfo){
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = filter,
        .minFilter = filter,
        .mipmapMode = filters ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
        .addressModeU = wrap,
        .addressModeV = wrap,
        .addressModeW = wrap,
        .compareEnable = compares,
        .compareOp = VK_COMPARE_OP_LESS_OR_EQUAL,
        .maxLod = VK_LOD_CLAMP_NONE,
    };
}

bool vk_filters_depth(const struct vk_device *device)
{
    return device->pub.info.limits.formats[RG_D32F].uses & RG_USE_FILTER;
}

bool vk_samplers_create(struct vk_device *device)
{
    bool ok = true;
    for (int i = 0; ok && i < RG_SAMPLERS; i++) {
        const VkSamplerCreateInfo info = sampler_info((enum rg_sampler)i, vk_filters_depth(device));
        ok = vk_try("device", device->pub.info.name, vkCreateSampler, device->handle, &info, NULL,
                    &device->samplers[i]);
    }
    return ok;
}

void vk_samplers_destroy(struct vk_device *device)
{
    for (int i = 0; i < RG_SAMPLERS; i++)
        vkDestroySampler(device->handle, device->samplers[i], NULL);
}
