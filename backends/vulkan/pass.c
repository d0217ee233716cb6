#include "backends/vulkan/vulkan.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

// The uniform block of shaders/grid.glsl: the range of items, then the kernel's parameters.
struct run_block {
    int32_t origin[4], end[4];
};

static void destroy(struct vk_device *device, struct vk_pass *pass)
{
    vk_program_destroy(device, pass);
    vk_slots_destroy(device, pass);
    free(pass);
}

static VkDeviceSize aligned(VkDeviceSize size, VkDeviceSize alignment)
{
    return (size + alignment - 1) / alignment * alignment;
}

// Takes over the kernel's slots, but for an image that is drawn to.
static void take_slots(const struct vk_device *device, const struct rg_kernel *kernel,
                       struct vk_pass *pass)
{
    const bool is_drawn = rg_is_drawn(&device->pub, kernel);
    for (int i = 0; i < kernel->slot_count; i++)
        if (!is_drawn || kernel->slots[i].kind != RG_SLOT_OUT_IMAGE)
            pass->slots[pass->slot_count++] = kernel->slots[i];
}

struct rg_pass *vk_pass_create(struct rg_device *device, const struct rg_kernel *kernel)
{
    struct vk_device *vk = (struct vk_device *)device;
    struct vk_pass *pass = rg_alloc(1, sizeof(*pass), kernel->name);
    if (!pass)
        return NULL;
    const VkDeviceSize std140_struct = 16;
    pass->params_bytes = (size_t)(kernel->draw ? kernel->draw->call_size : kernel->params_size);
    pass->run_bytes = aligned(sizeof(struct run_block) + pass->params_bytes, std140_struct);
    take_slots(vk, kernel, pass);
    if (kernel->draw)
        vk_draw_slots(pass);
    const bool created = vk_slots_create(vk, pass, kernel) && vk_program_create(vk, kernel, pass) &&
                         (!kernel->draw || vk_draw_prepare(vk));
    if (vk_healthy(vk) && created)
        return &pass->pub;
    destroy(vk, pass);
    return NULL;
}

void vk_pass_destroy(struct rg_pass *pass)
{
    destroy((struct vk_device *)pass->device, (struct vk_pass *)pass);
}

// A pipeline cache begins with a header that identifies the driver's build. A driver that caches no
// code, such as lavapipe, returns only the header.
bool vk_pass_code(struct rg_pass *pass, void **bytes, size_t *size)
{
    const VkDevice device = ((struct vk_device *)pass->device)->handle;
    const VkPipelineCache cache = ((struct vk_pass *)pass)->cache;
    *bytes = NULL;
    *size = 0;
    VkResult result = vkGetPipelineCacheData(device, cache, size, NULL);
    if (result == VK_SUCCESS && *size > sizeof(VkPipelineCacheHeaderVersionOne))
        *bytes = malloc(*size);
    if (result == VK_SUCCESS && *size > sizeof(VkPipelineCacheHeaderVersionOne) && !*bytes)
        return rg_harness_error("kernel '%s': no memory for its program", pass->kernel->name);
    if (*bytes)
        result = vkGetPipelineCacheData(device, cache, size, *bytes);
    return vk_check(result, "vkGetPipelineCacheData", "kernel", pass->kernel->name);
}

// --- running ---

// Gets a batch with room for one more run.
static struct vk_batch *record_run(struct vk_device *device, const struct vk_pass *pass)
{
    struct vk_batch *batch = vk_record(device);
    if (batch && (batch->runs == VK_BATCH_RUNS ||
                  batch->descriptors + pass->slot_count > VK_BATCH_DESCRIPTORS ||
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
    memcpy(to + sizeof(block), run->params, pass->params_bytes);
    batch->params_used += aligned(pass->run_bytes, device->limits.minUniformBufferOffsetAlignment);
    return (uint32_t)offset;
}

static void dispatch(struct vk_device *device, const struct vk_batch *batch, struct vk_pass *pass,
                     const struct rg_run *run, uint32_t params_offset)
{
    vk_barrier(batch);
    if (device->bound != pass->pipeline)
        vkCmdBindPipeline(batch->commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass->pipeline);
    device->bound = pass->pipeline;
    vkCmdBindDescriptorSets(batch->commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass->layout, 0, 1,
                            &pass->set, 1, &params_offset);
    const uint32_t group = (uint32_t)device->pub.info.limits.group_items;
    vkCmdDispatch(batch->commands, ((uint32_t)run->extent.width + group - 1) / group,
                  (uint32_t)run->extent.height, (uint32_t)run->extent.depth);
}

bool vk_pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    struct vk_device *device = (struct vk_device *)pass->device;
    struct vk_pass *vk = (struct vk_pass *)pass;
    struct vk_batch *batch = record_run(device, vk);
    union vk_descriptor descriptors[RG_MAX_SLOTS];
    vk_slots_fill(device, pass->kernel, run, descriptors);
    if (!batch || (pass->kernel->draw && !vk_draw_fill(device, run, descriptors)) ||
        !vk_slots_bind(device, batch, vk, descriptors))
        return false;
    const uint32_t params_offset = put_params(device, batch, vk, run);
    batch->runs++;
    bool recorded = true;
    vk_group_begin(device, batch->commands, pass->kernel->name);
    if (run->draw)
        recorded = vk_draw(device, batch, vk, run, params_offset);
    else
        dispatch(device, batch, vk, run, params_offset);
    vk_group_end(device, batch->commands);
    return vk_healthy(device) && recorded;
}
