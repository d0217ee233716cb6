#include "backends/vulkan/vulkan.h"

#include <stdlib.h>
#include <string.h>

#include "core/alloc.h"
#include "core/log.h"

// The uniform block of shaders/grid.glsl: where the items lie, then the kernel's parameters.
struct run_block {
    int32_t origin[4], end[4];
};

static VkDescriptorType descriptor_type(enum rg_slot_kind kind)
{
    if (kind == RG_SLOT_IMAGE)
        return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    if (kind == RG_SLOT_OUT_IMAGE)
        return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

static bool check_slots(const struct vk_device *device, const struct rg_kernel *kernel)
{
    uint32_t buffers = 0, sampled = 0, stored = 0;
    for (int i = 0; i < kernel->slot_count; i++) {
        VkDescriptorType type = descriptor_type(kernel->slots[i].kind);
        buffers += type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        sampled += type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        stored += type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    }
    const VkPhysicalDeviceLimits *most = &device->limits;
    uint32_t max_sampled = most->maxPerStageDescriptorSampledImages;
    if (max_sampled > most->maxPerStageDescriptorSamplers)
        max_sampled = most->maxPerStageDescriptorSamplers;
    if (buffers > most->maxPerStageDescriptorStorageBuffers || sampled > max_sampled ||
        stored > most->maxPerStageDescriptorStorageImages)
        return rg_error("kernel '%s': %u buffers, %u images and %u images to store to; %s allows "
                        "%u, %u and %u",
                        kernel->name, buffers, sampled, stored, device->pub.info.name,
                        most->maxPerStageDescriptorStorageBuffers, max_sampled,
                        most->maxPerStageDescriptorStorageImages);
    return true;
}

static bool create_set_layout(struct vk_device *device, const struct rg_kernel *kernel,
                              struct vk_pass *pass)
{
    VkDescriptorSetLayoutBinding bindings[RG_MAX_SLOTS] = {
        {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL}};
    for (int i = 0; i < kernel->slot_count; i++)
        bindings[i + 1] = (VkDescriptorSetLayoutBinding){
            .binding = (uint32_t)kernel->slots[i].slot,
            .descriptorType = descriptor_type(kernel->slots[i].kind),
            .descriptorCount = 1,
            .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT,
        };
    const VkDescriptorSetLayoutCreateInfo set = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = (uint32_t)kernel->slot_count + 1,
        .pBindings = bindings,
    };
    if (!vk_try("kernel", kernel->name, vkCreateDescriptorSetLayout, device->handle, &set, NULL,
                &pass->set_layout))
        return false;
    const VkPipelineLayoutCreateInfo layout = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
        .setLayoutCount = 1,
        .pSetLayouts = &pass->set_layout,
    };
    return vk_try("kernel", kernel->name, vkCreatePipelineLayout, device->handle, &layout, NULL,
                  &pass->layout);
}

static bool create_update(struct vk_device *device, const struct rg_kernel *kernel,
                          struct vk_pass *pass)
{
    VkDescriptorUpdateTemplateEntry entries[RG_MAX_SLOTS] = {
        {.descriptorCount = 1, .descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC}};
    for (int i = 0; i < kernel->slot_count; i++)
        entries[i + 1] = (VkDescriptorUpdateTemplateEntry){
            .dstBinding = (uint32_t)kernel->slots[i].slot,
            .descriptorCount = 1,
            .descriptorType = descriptor_type(kernel->slots[i].kind),
            .offset = (size_t)kernel->slots[i].slot * sizeof(union vk_descriptor),
        };
    const VkDescriptorUpdateTemplateCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_UPDATE_TEMPLATE_CREATE_INFO,
        .descriptorUpdateEntryCount = (uint32_t)kernel->slot_count + 1,
        .pDescriptorUpdateEntries = entries,
        .templateType = VK_DESCRIPTOR_UPDATE_TEMPLATE_TYPE_DESCRIPTOR_SET,
        .descriptorSetLayout = pass->set_layout,
    };
    return vk_try("kernel", kernel->name, vkCreateDescriptorUpdateTemplate, device->handle, &info,
                  NULL, &pass->update);
}

static bool create_module(struct vk_device *device, const struct rg_kernel *kernel,
                          VkShaderModule *module)
{
    struct rg_kernel_code code;
    void *owned;
    if (!rg_kernel_code(kernel, RG_CODE_SPIRV, &code, &owned))
        return false;
    const uint32_t spirv_magic = 0x07230203, header_bytes = 20;
    bool ok = code.size >= header_bytes && code.size % 4 == 0 &&
              !memcmp(code.bytes, &spirv_magic, sizeof(spirv_magic));
    if (!ok)
        rg_error("kernel '%s': its %zu bytes are no SPIR-V; build it with glslc", kernel->name,
                 code.size);
    const VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .codeSize = code.size,
        .pCode = (const uint32_t *)(const void *)code.bytes,
    };
    ok = ok &&
         vk_try("kernel", kernel->name, vkCreateShaderModule, device->handle, &info, NULL, module);
    free(owned);
    return ok;
}

static bool create_pipeline(struct vk_device *device, const struct rg_kernel *kernel,
                            struct vk_pass *pass)
{
    VkShaderModule module;
    if (!create_module(device, kernel, &module))
        return false;
    const VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module,
                  .pName = "main"},
        .layout = pass->layout,
    };
    bool ok = vk_try("kernel", kernel->name, vkCreateComputePipelines, device->handle,
                     VK_NULL_HANDLE, 1, &info, NULL, &pass->pipeline);
    vkDestroyShaderModule(device->handle, module, NULL);
    if (ok)
        vk_name(device, VK_OBJECT_TYPE_PIPELINE, VK_HANDLE(pass->pipeline), kernel->name);
    return ok;
}

static void destroy(struct vk_device *device, struct vk_pass *pass)
{
    vkDestroyPipeline(device->handle, pass->pipeline, NULL);
    vkDestroyDescriptorUpdateTemplate(device->handle, pass->update, NULL);
    vkDestroyPipelineLayout(device->handle, pass->layout, NULL);
    vkDestroyDescriptorSetLayout(device->handle, pass->set_layout, NULL);
    free(pass);
}

static VkDeviceSize aligned(VkDeviceSize size, VkDeviceSize alignment)
{
    return (size + alignment - 1) / alignment * alignment;
}

struct rg_pass *vk_pass_create(struct rg_device *device, const struct rg_kernel *kernel)
{
    struct vk_device *vk = (struct vk_device *)device;
    struct vk_pass *pass = rg_alloc(1, sizeof(*pass), kernel->name);
    if (!pass)
        return NULL;
    const VkDeviceSize std140_struct = 16;
    pass->run_bytes =
        aligned(sizeof(struct run_block) + (VkDeviceSize)kernel->params_size, std140_struct);
    bool created = check_slots(vk, kernel) && create_set_layout(vk, kernel, pass) &&
                   create_update(vk, kernel, pass) && create_pipeline(vk, kernel, pass);
    if (vk_healthy(vk) && created)
        return &pass->pub;
    destroy(vk, pass);
    return NULL;
}

void vk_pass_destroy(struct rg_pass *pass)
{
    destroy((struct vk_device *)pass->device, (struct vk_pass *)pass);
}

// --- running ---

// A batch with room for one more run.
static struct vk_batch *record_run(struct vk_device *device, const struct vk_pass *pass)
{
    struct vk_batch *batch = vk_record(device);
    if (batch && (batch->runs == VK_BATCH_RUNS ||
                  batch->descriptors + pass->pub.kernel->slot_count > VK_BATCH_DESCRIPTORS ||
                  batch->params_used + pass->run_bytes > VK_PARAMS_BYTES))
        batch = vk_submit(device) ? vk_record(device) : NULL;
    return batch;
}

static uint32_t put_params(struct vk_device *device, struct vk_batch *batch,
                           const struct vk_pass *pass, const struct rg_run *run)
{
    const struct run_block block = {
        {run->origin.width, run->origin.height, run->origin.depth, 0},
        {run->origin.width + run->extent.width, run->origin.height + run->extent.height,
         run->origin.depth + run->extent.depth, 0},
    };
    VkDeviceSize offset = batch->params_used;
    char *to = (char *)batch->params.memory.mapped + offset;
    memcpy(to, &block, sizeof(block));
    memcpy(to + sizeof(block), run->params, (size_t)pass->pub.kernel->params_size);
    batch->params_used += aligned(pass->run_bytes, device->limits.minUniformBufferOffsetAlignment);
    return (uint32_t)offset;
}

static bool is_bound(const struct vk_device *device, const struct vk_pass *pass,
                     const struct rg_run *run)
{
    return pass->set_serial == device->serial &&
           !memcmp(pass->bound, run->slots, sizeof(pass->bound));
}

// Makes pass->set a descriptor set with the run's objects.
static bool bind_objects(struct vk_device *device, struct vk_batch *batch, struct vk_pass *pass,
                         const struct rg_run *run)
{
    const struct rg_kernel *kernel = pass->pub.kernel;
    const VkDescriptorSetAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = batch->descriptor_pool,
        .descriptorSetCount = 1,
        .pSetLayouts = &pass->set_layout,
    };
    pass->set_serial = 0;
    if (!vk_try("kernel", kernel->name, vkAllocateDescriptorSets, device->handle, &info,
                &pass->set))
        return false;
    batch->descriptors += kernel->slot_count;
    union vk_descriptor descriptors[RG_MAX_SLOTS];
    descriptors[0].buffer = (VkDescriptorBufferInfo){batch->params.buffer, 0, pass->run_bytes};
    for (int i = 0; i < kernel->slot_count; i++) {
        int slot = kernel->slots[i].slot;
        const struct vk_buf *buf = (const struct vk_buf *)run->slots[slot].buf;
        const struct vk_image *image = (const struct vk_image *)run->slots[slot].image;
        if (buf)
            descriptors[slot].buffer =
                (VkDescriptorBufferInfo){buf->block.buffer, 0, VK_WHOLE_SIZE};
        else
            descriptors[slot].image = (VkDescriptorImageInfo){
                device->sampler,
                kernel->slots[i].kind == RG_SLOT_IMAGE ? image->sampled : image->stored,
                VK_IMAGE_LAYOUT_GENERAL};
    }
    vkUpdateDescriptorSetWithTemplate(device->handle, pass->set, pass->update, descriptors);
    memcpy(pass->bound, run->slots, sizeof(pass->bound));
    pass->set_serial = device->serial;
    return true;
}

bool vk_pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    struct vk_device *device = (struct vk_device *)pass->device;
    struct vk_pass *vk = (struct vk_pass *)pass;
    struct vk_batch *batch = record_run(device, vk);
    if (!batch || (!is_bound(device, vk, run) && !bind_objects(device, batch, vk, run)))
        return false;
    uint32_t params_offset = put_params(device, batch, vk, run);
    batch->runs++;
    vk_barrier(batch);
    if (device->bound != vk->pipeline)
        vkCmdBindPipeline(batch->commands, VK_PIPELINE_BIND_POINT_COMPUTE, vk->pipeline);
    device->bound = vk->pipeline;
    vkCmdBindDescriptorSets(batch->commands, VK_PIPELINE_BIND_POINT_COMPUTE, vk->layout, 0, 1,
                            &vk->set, 1, &params_offset);
    const uint32_t group = (uint32_t)device->pub.info.limits.group_items;
    vkCmdDispatch(batch->commands, ((uint32_t)run->extent.width + group - 1) / group,
                  (uint32_t)run->extent.height, (uint32_t)run->extent.depth);
    return vk_healthy(device);
}
