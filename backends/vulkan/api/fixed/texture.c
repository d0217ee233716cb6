#include "backends/vulkan/api/fixed/fixed.h"

// Texels lie in the buffer in the order of layers, then levels, each at a whole level's size.
static VkDeviceSize place_of(const struct rg_fixed_state *state, int layer, int level)
{
    return (VkDeviceSize)(layer * rg_fixed_levels(state) + level) * RG_FIXED_LEVEL_BYTES;
}

static void fill(struct vk_fixed_job *job)
{
    const struct rg_fixed_state *state = job->state;
    uint8_t *mapped = job->buffers[VK_FIXED_TEXELS].memory.mapped;
    for (int layer = 0; layer < rg_fixed_layers(state); layer++)
        for (int level = 0; level < rg_fixed_levels(state); level++)
            rg_fixed_make_texels(state, layer, level, mapped + place_of(state, layer, level));
}

static bool make_sampler(struct vk_fixed_job *job)
{
    static const VkSamplerAddressMode wraps[] = {
        VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT,
        VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER};
    static const VkBorderColor borders[] = {VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK,
                                            VK_BORDER_COLOR_FLOAT_OPAQUE_BLACK,
                                            VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE};
    const struct rg_fixed_state *s = job->state;
    const VkSamplerCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = s->mag ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
        .minFilter = s->min ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
        .mipmapMode = s->mip == RG_FIXED_MIP_LINEAR ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                    : VK_SAMPLER_MIPMAP_MODE_NEAREST,
        .addressModeU = wraps[s->wrap_u],
        .addressModeV = wraps[s->wrap_v],
        .mipLodBias = (float)s->bias_16 / 16,
        .anisotropyEnable = s->anisotropy != 0,
        .maxAnisotropy = (float)s->anisotropy,
        .compareEnable = s->compare != 0,
        .compareOp = vk_fixed_compare(s->compare),
        .minLod = (float)s->lod_least_16 / 16,
        // Without levels a quarter stands for level 0: it keeps the choice of the two filters.
        .maxLod = s->lod_most_16 ? (float)s->lod_most_16 / 16
                  : s->mip       ? VK_LOD_CLAMP_NONE
                                 : 0.25f,
        .borderColor = borders[s->border],
    };
    return vk_fixed_try(job, vkCreateSampler, job->fixed->own.handle, &info, NULL, &job->sampler);
}

bool vk_fixed_texture(struct vk_fixed_job *job)
{
    static const VkImageViewType types[] = {VK_IMAGE_VIEW_TYPE_2D, VK_IMAGE_VIEW_TYPE_2D_ARRAY,
                                            VK_IMAGE_VIEW_TYPE_CUBE};
    const struct rg_fixed_state *state = job->state;
    const int layers = rg_fixed_layers(state), levels = rg_fixed_levels(state);
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .flags = state->texture == RG_FIXED_CUBE ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = vk_fixed_texels(state->texels),
        .extent = {RG_FIXED_TEXTURE_PX, RG_FIXED_TEXTURE_PX, 1},
        .mipLevels = (uint32_t)levels,
        .arrayLayers = (uint32_t)layers,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
    };
    if (!vk_fixed_image(job, &info, types[state->texture], &job->texture) ||
        !vk_block_create(&job->fixed->own, place_of(state, layers, 0),
                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT, VK_USE_HOST, job->feature,
                         &job->buffers[VK_FIXED_TEXELS]))
        return false;
    fill(job);
    return make_sampler(job);
}

void vk_fixed_upload(struct vk_fixed_job *job)
{
    const struct rg_fixed_state *state = job->state;
    const VkCommandBuffer commands = job->fixed->commands;
    vk_fixed_turn(commands, &job->texture, VK_IMAGE_LAYOUT_UNDEFINED,
                  VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    for (int layer = 0; layer < rg_fixed_layers(state); layer++)
        for (int level = 0; level < rg_fixed_levels(state); level++) {
            const uint32_t px = RG_FIXED_TEXTURE_PX >> level;
            const VkBufferImageCopy copy = {
                .bufferOffset = place_of(state, layer, level),
                .imageSubresource = {job->texture.aspect, (uint32_t)level, (uint32_t)layer, 1},
                .imageExtent = {px, px, 1},
            };
            vkCmdCopyBufferToImage(commands, job->buffers[VK_FIXED_TEXELS].buffer,
                                   job->texture.handle, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                                   &copy);
        }
    vk_fixed_turn(commands, &job->texture, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                  VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}
