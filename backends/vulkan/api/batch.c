#include "backends/vulkan/vulkan.h"

static const char *object_name(const struct vk_device *device)
{
    return device->pub.info.name;
}

static bool create_descriptor_pool(struct vk_device *device, struct vk_batch *batch)
{
    static const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, VK_BATCH_RUNS},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_BATCH_DESCRIPTORS},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_BATCH_DESCRIPTORS},
        {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_BATCH_DESCRIPTORS},
        {VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, VK_BATCH_RUNS},
    };
    const VkDescriptorPoolCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = 2 * VK_BATCH_RUNS, // one for a pass's slots, one for the colour of its target
        .poolSizeCount = sizeof(sizes) / sizeof(sizes[0]),
        .pPoolSizes = sizes,
    };
    return vk_try("device", object_name(device), vkCreateDescriptorPool, device->handle, &info,
                  NULL, &batch->descriptor_pool);
}

static bool create_batch(struct vk_device *device, struct vk_batch *batch)
{
    const VkCommandPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
        .queueFamilyIndex = device->family.index,
    };
    const VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    const char *name = object_name(device);
    if (!vk_try("device", name, vkCreateCommandPool, device->handle, &pool, NULL, &batch->pool) ||
        !vk_try("device", name, vkCreateFence, device->handle, &fence, NULL, &batch->fence))
        return false;
    const VkCommandBufferAllocateInfo commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = batch->pool,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1,
    };
    return vk_try("device", name, vkAllocateCommandBuffers, device->handle, &commands,
                  &batch->commands) &&
           create_descriptor_pool(device, batch) &&
           vk_block_create(device, VK_PARAMS_BYTES, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, VK_USE_HOST,
                           "parameters", &batch->params);
}

bool vk_batches_create(struct vk_device *device)
{
    for (int i = 0; i < VK_BATCHES; i++)
        if (!create_batch(device, &device->batches[i]))
            return false;
    return true;
}

void vk_batches_destroy(struct vk_device *device)
{
    for (int i = 0; i < VK_BATCHES; i++) {
        struct vk_batch *batch = &device->batches[i];
        vk_block_destroy(device, &batch->params);
        vk_block_destroy(device, &batch->staging);
        vkDestroyDescriptorPool(device->handle, batch->descriptor_pool, NULL);
        vkDestroyFence(device->handle, batch->fence, NULL);
        vkDestroyCommandPool(device->handle, batch->pool, NULL);
    }
}

// Waits for a batch and empties it.
static bool retire(struct vk_device *device, struct vk_batch *batch)
{
    if (!batch->in_flight)
        return true;
    batch->in_flight = false;
    const char *name = object_name(device);
    return vk_try("device", name, vkWaitForFences, device->handle, 1, &batch->fence, VK_TRUE,
                  UINT64_MAX) &&
           vk_try("device", name, vkResetFences, device->handle, 1, &batch->fence);
}

struct vk_batch *vk_record(struct vk_device *device)
{
    struct vk_batch *batch = &device->batches[device->current];
    if (batch->recording)
        return batch;
    const VkCommandBufferBeginInfo begin = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
    };
    const char *name = object_name(device);
    if (!retire(device, batch) ||
        !vk_try("device", name, vkResetCommandPool, device->handle, batch->pool, 0) ||
        !vk_try("device", name, vkResetDescriptorPool, device->handle, batch->descriptor_pool, 0) ||
        !vk_try("device", name, vkBeginCommandBuffer, batch->commands, &begin))
        return NULL;
    batch->params_used = batch->staging_used = 0;
    batch->runs = batch->descriptors = 0;
    batch->recording = true;
    device->bound = VK_NULL_HANDLE;
    device->serial++;
    return batch;
}

// Replaces the staging memory of a batch that has not used it, so that no recorded command refers
// to it.
static bool grow_staging(struct vk_device *device, struct vk_batch *batch, size_t size)
{
    VkDeviceSize grown = VK_MIN_STAGING_BYTES;
    while (grown < size)
        grown *= 2;
    vk_block_destroy(device, &batch->staging);
    return vk_block_create(device, grown,
                           VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                           VK_USE_HOST, "staging", &batch->staging);
}

struct vk_batch *vk_record_staged(struct vk_device *device, size_t size, VkDeviceSize *offset,
                                  void **memory)
{
    struct vk_batch *batch = vk_record(device);
    if (batch && batch->staging_used && batch->staging_used + size > batch->staging.size)
        batch = vk_submit(device) ? vk_record(device) : NULL;
    if (!batch || (size > batch->staging.size && !grow_staging(device, batch, size)))
        return NULL;
    const VkDeviceSize largest_texel = 16; // copies begin at a multiple of a texel
    *offset = batch->staging_used;
    *memory = (char *)batch->staging.memory.mapped + batch->staging_used;
    batch->staging_used += (size + largest_texel - 1) / largest_texel * largest_texel;
    return batch;
}

static void barrier(const struct vk_batch *batch, VkPipelineStageFlags to, VkAccessFlags access)
{
    const VkMemoryBarrier memory = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
        .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
        .dstAccessMask = access,
    };
    vkCmdPipelineBarrier(batch->commands,
                         VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT, to,
                         0, 1, &memory, 0, NULL, 0, NULL);
}

void vk_barrier(const struct vk_batch *batch)
{
    barrier(batch, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                VK_ACCESS_TRANSFER_WRITE_BIT);
}

// Only draws have barriers for the drawing stages, because a queue that only computes does not
// support these stages.
enum {
    DRAW_STAGES =
        VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
        VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
        VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
    OTHER_STAGES = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
};

static VkPipelineStageFlags draw_stages(const struct vk_device *device)
{
    return DRAW_STAGES | (device->pub.info.native ? VK_PIPELINE_STAGE_GEOMETRY_SHADER_BIT : 0);
}

void vk_barrier_before_draw(const struct vk_device *device, const struct vk_batch *batch)
{
    barrier(batch, draw_stages(device),
            VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_SHADER_READ_BIT |
                VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_COLOR_ATTACHMENT_READ_BIT |
                VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
}

void vk_barrier_after_draw(const struct vk_device *device, const struct vk_batch *batch)
{
    const VkMemoryBarrier memory = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
        .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
                         VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT |
                         VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
    };
    vkCmdPipelineBarrier(batch->commands, draw_stages(device), OTHER_STAGES, 0, 1, &memory, 0, NULL,
                         0, NULL);
}

bool vk_submit(struct vk_device *device)
{
    struct vk_batch *batch = &device->batches[device->current];
    if (!batch->recording)
        return true;
    batch->recording = false;
    barrier(batch, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT | VK_ACCESS_HOST_WRITE_BIT);
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
        .commandBufferCount = 1,
        .pCommandBuffers = &batch->commands,
    };
    const char *name = object_name(device);
    if (!vk_try("device", name, vkEndCommandBuffer, batch->commands) ||
        !vk_try("device", name, vkQueueSubmit, device->queue, 1, &submit, batch->fence))
        return false;
    batch->in_flight = true;
    device->current = (device->current + 1) % VK_BATCHES;
    return true;
}

bool vk_wait(struct vk_device *device)
{
    bool ok = vk_submit(device);
    for (int i = 0; i < VK_BATCHES; i++)
        ok = retire(device, &device->batches[i]) && ok;
    return ok;
}

bool vk_is_idle(const struct vk_device *device)
{
    for (int i = 0; i < VK_BATCHES; i++)
        if (device->batches[i].recording || device->batches[i].in_flight)
            return false;
    return true;
}
