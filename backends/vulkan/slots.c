// A pass's slots as a Vulkan descriptor set, whose binding 0 is the uniform block.
#include "backends/vulkan/vulkan.h"

#include <string.h>

static VkDescriptorType descriptor_type(enum rg_slot_kind kind)
{
    if (kind == RG_SLOT_IMAGE)
        return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    if (kind == RG_SLOT_OUT_IMAGE)
        return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

// The shader stages that read the uniform block, and those that read a slot: only fragments read a
// program's own slots, but native devices have all stages read them.
static VkShaderStageFlags block_stages(const struct vk_device *device,
                                       const struct rg_kernel *kernel)
{
    const VkShaderStageFlags native = device->pub.info.native ? VK_SHADER_STAGE_GEOMETRY_BIT : 0;
    return rg_is_drawn(&device->pub, kernel)
               ? VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | native
               : VK_SHADER_STAGE_COMPUTE_BIT;
}

static VkShaderStageFlags slot_stages(const struct vk_device *device,
                                      const struct rg_kernel *kernel, int slot)
{
    const bool is_own = device->pub.info.native ? slot <= RG_SLOT_PRIMS : slot == RG_SLOT_PRIMS;
    return kernel->draw && !is_own ? VK_SHADER_STAGE_FRAGMENT_BIT : block_stages(device, kernel);
}

// The layout of the set with a target's colour, for fragments that blend by themselves.
static bool prepare_before(struct vk_device *device, const struct rg_kernel *kernel)
{
    const VkDescriptorSetLayoutBinding held = {0, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, 1,
                                               VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
    const VkDescriptorSetLayoutCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = 1,
        .pBindings = &held,
    };
    return !device->pub.blends || device->before ||
           vk_try("kernel", kernel->name, vkCreateDescriptorSetLayout, device->handle, &info, NULL,
                  &device->before);
}

static bool create_set_layout(struct vk_device *device, const struct rg_kernel *kernel,
                              struct vk_pass *pass)
{
    VkDescriptorSetLayoutBinding bindings[RG_MAX_SLOTS] = {
        {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1, block_stages(device, kernel), NULL}};
    for (int i = 0; i < pass->slot_count; i++)
        bindings[i + 1] = (VkDescriptorSetLayoutBinding){
            .binding = (uint32_t)pass->slots[i].slot,
            .descriptorType = descriptor_type(pass->slots[i].kind),
            .descriptorCount = 1,
            .stageFlags = slot_stages(device, kernel, pass->slots[i].slot),
        };
    const VkDescriptorSetLayoutCreateInfo set = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = (uint32_t)pass->slot_count + 1,
        .pBindings = bindings,
    };
    if (!vk_try("kernel", kernel->name, vkCreateDescriptorSetLayout, device->handle, &set, NULL,
                &pass->set_layout))
        return false;
    const VkDescriptorSetLayout sets[] = {pass->set_layout, device->before};
    const VkPipelineLayoutCreateInfo layout = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
        .setLayoutCount = kernel->draw && device->pub.blends ? 2 : 1,
        .pSetLayouts = sets,
    };
    return vk_try("kernel", kernel->name, vkCreatePipelineLayout, device->handle, &layout, NULL,
                  &pass->layout);
}

static bool create_update(struct vk_device *device, const struct rg_kernel *kernel,
                          struct vk_pass *pass)
{
    VkDescriptorUpdateTemplateEntry entries[RG_MAX_SLOTS] = {
        {.descriptorCount = 1, .descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC}};
    for (int i = 0; i < pass->slot_count; i++)
        entries[i + 1] = (VkDescriptorUpdateTemplateEntry){
            .dstBinding = (uint32_t)pass->slots[i].slot,
            .descriptorCount = 1,
            .descriptorType = descriptor_type(pass->slots[i].kind),
            .offset = (size_t)pass->slots[i].slot * sizeof(union vk_descriptor),
        };
    const VkDescriptorUpdateTemplateCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_UPDATE_TEMPLATE_CREATE_INFO,
        .descriptorUpdateEntryCount = (uint32_t)pass->slot_count + 1,
        .pDescriptorUpdateEntries = entries,
        .templateType = VK_DESCRIPTOR_UPDATE_TEMPLATE_TYPE_DESCRIPTOR_SET,
        .descriptorSetLayout = pass->set_layout,
    };
    return vk_try("kernel", kernel->name, vkCreateDescriptorUpdateTemplate, device->handle, &info,
                  NULL, &pass->update);
}

bool vk_slots_create(struct vk_device *device, struct vk_pass *pass, const struct rg_kernel *kernel)
{
    return prepare_before(device, kernel) && create_set_layout(device, kernel, pass) &&
           create_update(device, kernel, pass);
}

void vk_slots_destroy(struct vk_device *device, struct vk_pass *pass)
{
    vkDestroyDescriptorUpdateTemplate(device->handle, pass->update, NULL);
    vkDestroyPipelineLayout(device->handle, pass->layout, NULL);
    vkDestroyDescriptorSetLayout(device->handle, pass->set_layout, NULL);
}

// --- binding ---

bool vk_slot_before(struct vk_device *device, const struct vk_batch *batch,
                    const struct vk_pass *pass, const struct rg_draw *draw, VkDescriptorSet *set)
{
    const VkDescriptorImageInfo held = {
        .imageView = vk_place(device, draw->colour, draw->layer, draw->level),
        .imageLayout = VK_IMAGE_LAYOUT_GENERAL,
    };
    const VkDescriptorSetAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = batch->descriptor_pool,
        .descriptorSetCount = 1,
        .pSetLayouts = &device->before,
    };
    if (!held.imageView || !vk_try("kernel", pass->pub.kernel->name, vkAllocateDescriptorSets,
                                   device->handle, &info, set))
        return false;
    const VkWriteDescriptorSet write = {
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
        .dstSet = *set,
        .descriptorCount = 1,
        .descriptorType = VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT,
        .pImageInfo = &held,
    };
    vkUpdateDescriptorSets(device->handle, 1, &write, 0, NULL);
    return true;
}

// Assigns members one by one, so that padding stays zero and descriptors can be compared.
void vk_slot_buffer(union vk_descriptor *descriptor, const struct rg_buf *buf)
{
    descriptor->buffer.buffer = ((const struct vk_buf *)buf)->block.buffer;
    descriptor->buffer.range = VK_WHOLE_SIZE;
}

void vk_slot_image(union vk_descriptor *descriptor, const struct vk_device *device,
                   enum rg_sampler sampling, VkImageView view)
{
    descriptor->image.sampler = device->samplers[sampling];
    descriptor->image.imageView = view;
    descriptor->image.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
}

static void fill_image(union vk_descriptor *descriptor, const struct vk_device *device,
                       bool sampled, const struct rg_slot_info *slot, const struct vk_image *image)
{
    const enum rg_sampler sampling = sampled ? slot->sampler : RG_TEXELS;
    vk_slot_image(descriptor, device, sampling,
                  slot->kind != RG_SLOT_IMAGE   ? image->stored
                  : sampling == RG_SAMPLED_CUBE ? image->cube
                                                : image->sampled);
}

void vk_slots_fill(const struct vk_device *device, const struct rg_kernel *kernel,
                   const struct rg_run *run, union vk_descriptor descriptors[RG_MAX_SLOTS])
{
    const bool sampled = rg_run_features(&device->pub, run->draw) & RG_FEATURE_SAMPLERS;
    memset(descriptors, 0, RG_MAX_SLOTS * sizeof(*descriptors));
    for (int i = 0; i < kernel->slot_count; i++) {
        const struct rg_binding *bound = &run->slots[kernel->slots[i].slot];
        union vk_descriptor *descriptor = &descriptors[kernel->slots[i].slot];
        if (bound->buf)
            vk_slot_buffer(descriptor, bound->buf);
        else
            fill_image(descriptor, device, sampled, &kernel->slots[i],
                       (struct vk_image *)bound->image);
    }
}

bool vk_slots_bind(struct vk_device *device, struct vk_batch *batch, struct vk_pass *pass,
                   union vk_descriptor descriptors[RG_MAX_SLOTS])
{
    if (pass->set_serial == device->serial &&
        !memcmp(pass->bound, descriptors, sizeof(pass->bound)))
        return true;
    const VkDescriptorSetAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = batch->descriptor_pool,
        .descriptorSetCount = 1,
        .pSetLayouts = &pass->set_layout,
    };
    pass->set_serial = 0;
    if (!vk_try("kernel", pass->pub.kernel->name, vkAllocateDescriptorSets, device->handle, &info,
                &pass->set))
        return false;
    batch->descriptors += pass->slot_count;
    memcpy(pass->bound, descriptors, sizeof(pass->bound));
    descriptors[0].buffer = (VkDescriptorBufferInfo){batch->params.buffer, 0, pass->run_bytes};
    vkUpdateDescriptorSetWithTemplate(device->handle, pass->set, pass->update, descriptors);
    pass->set_serial = device->serial;
    return true;
}
