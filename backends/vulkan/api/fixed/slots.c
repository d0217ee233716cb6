// The descriptor set: parameters at 0, and what a draw has of a texture at 1, counts at 2 and
// stored images from 3 on.
#include "backends/vulkan/api/fixed/fixed.h"

enum { MAX_SLOTS = 3 + RG_FIXED_STORES };

struct slots {
    uint32_t count;
    VkDescriptorSetLayoutBinding bindings[MAX_SLOTS];
    VkDescriptorBufferInfo buffers[MAX_SLOTS];
    VkDescriptorImageInfo images[MAX_SLOTS];
};

static uint32_t add(struct slots *slots, uint32_t binding, VkDescriptorType type)
{
    slots->bindings[slots->count] =
        (VkDescriptorSetLayoutBinding){binding, type, 1, VK_SHADER_STAGE_ALL_GRAPHICS, NULL};
    return slots->count++;
}

static void fill(const struct vk_fixed_job *job, struct slots *slots)
{
    const struct rg_fixed_state *state = job->state;
    uint32_t at = add(slots, 0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
    slots->buffers[at] =
        (VkDescriptorBufferInfo){job->buffers[VK_FIXED_PARAMS].buffer, 0, VK_WHOLE_SIZE};
    if (state->texels) {
        at = add(slots, 1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
        slots->images[at] = (VkDescriptorImageInfo){job->sampler, job->texture.view,
                                                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    }
    if (state->counts) {
        at = add(slots, 2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
        slots->buffers[at] =
            (VkDescriptorBufferInfo){job->buffers[VK_FIXED_COUNTS].buffer, 0, VK_WHOLE_SIZE};
    }
    for (uint32_t i = 0; state->stores && i < RG_FIXED_STORES; i++) {
        at = add(slots, 3 + i, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
        slots->images[at] =
            (VkDescriptorImageInfo){VK_NULL_HANDLE, job->stores[i].view, VK_IMAGE_LAYOUT_GENERAL};
    }
}

static bool make_set(struct vk_fixed_job *job, const struct slots *slots)
{
    const VkDevice device = job->fixed->own.handle;
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1},
        {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, RG_FIXED_STORES},
    };
    const VkDescriptorPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = 1,
        .poolSizeCount = sizeof(sizes) / sizeof(sizes[0]),
        .pPoolSizes = sizes,
    };
    const VkDescriptorSetLayoutCreateInfo layout = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = slots->count,
        .pBindings = slots->bindings,
    };
    VkDescriptorSetAllocateInfo set = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorSetCount = 1,
        .pSetLayouts = &job->set_layout,
    };
    if (!vk_fixed_try(job, vkCreateDescriptorSetLayout, device, &layout, NULL, &job->set_layout) ||
        !vk_fixed_try(job, vkCreateDescriptorPool, device, &pool, NULL, &job->set_pool))
        return false;
    set.descriptorPool = job->set_pool;
    return vk_fixed_try(job, vkAllocateDescriptorSets, device, &set, &job->set);
}

bool vk_fixed_slots(struct vk_fixed_job *job)
{
    struct slots slots = {0};
    VkWriteDescriptorSet writes[MAX_SLOTS];
    fill(job, &slots);
    if (!make_set(job, &slots))
        return false;
    for (uint32_t i = 0; i < slots.count; i++)
        writes[i] = (VkWriteDescriptorSet){
            .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
            .dstSet = job->set,
            .dstBinding = slots.bindings[i].binding,
            .descriptorCount = 1,
            .descriptorType = slots.bindings[i].descriptorType,
            .pImageInfo = &slots.images[i],
            .pBufferInfo = &slots.buffers[i],
        };
    vkUpdateDescriptorSets(job->fixed->own.handle, slots.count, writes, 0, NULL);
    return true;
}
