#include "backends/vulkan/api/fixed/fixed.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "shaders/fixed/bounds/bounds.h"

// --- buffers and queries ---

static bool make_buffer(struct vk_fixed_job *job, enum vk_fixed_buffer buffer,
                        VkBufferUsageFlags usage, const void *data, size_t size)
{
    struct vk_block *block = &job->buffers[buffer];
    if (!vk_block_create(&job->fixed->own, size, usage, VK_USE_HOST, job->feature, block))
        return false;
    if (data)
        memcpy(block->memory.mapped, data, size);
    else
        memset(block->memory.mapped, 0, size);
    return true;
}

static bool make_buffers(struct vk_fixed_job *job)
{
    const struct rg_fixed_state *state = job->state;
    const struct rg_fixed_vertices *v = &job->vertices;
    const struct rg_fixed_params params = {state->nudge, state->shift, state->value, 0};
    const struct rg_fixed_arguments arguments = rg_fixed_arguments(state, v);
    const VkBufferUsageFlags vertices = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
    return make_buffer(job, VK_FIXED_PARAMS, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, &params,
                       sizeof(params)) &&
           make_buffer(job, VK_FIXED_VERTICES, vertices, v->vertices, sizeof(v->vertices)) &&
           make_buffer(job, VK_FIXED_OFFSETS, vertices, v->offsets, sizeof(v->offsets)) &&
           make_buffer(job, VK_FIXED_FORMATS, vertices, v->formats, sizeof(v->formats)) &&
           make_buffer(job, VK_FIXED_INDICES, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, v->indices,
                       sizeof(v->indices)) &&
           make_buffer(job, VK_FIXED_ARGUMENTS, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, &arguments,
                       sizeof(arguments)) &&
           make_buffer(job, VK_FIXED_COUNTS, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, NULL,
                       RG_FIXED_COUNTS * sizeof(uint32_t)) &&
           (!state->feedback ||
            make_buffer(job, VK_FIXED_FEEDBACK, VK_BUFFER_USAGE_TRANSFORM_FEEDBACK_BUFFER_BIT_EXT,
                        NULL, (size_t)3 * RG_FIXED_MAX_VERTICES * RG_FIXED_CAUGHT_BYTES)) &&
           make_buffer(job, VK_FIXED_RESULT, VK_BUFFER_USAGE_TRANSFER_DST_BIT, NULL,
                       RG_FIXED_PICTURE_BYTES);
}

static bool make_queries(struct vk_fixed_job *job)
{
    const VkDevice device = job->fixed->own.handle;
    const VkQueryPoolCreateInfo occlusion = {
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
        .queryType = VK_QUERY_TYPE_OCCLUSION,
        .queryCount = 1,
    };
    const VkQueryPoolCreateInfo statistics = {
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
        .queryType = VK_QUERY_TYPE_PIPELINE_STATISTICS,
        .queryCount = 1,
        .pipelineStatistics = VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_VERTICES_BIT |
                              VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_PRIMITIVES_BIT |
                              VK_QUERY_PIPELINE_STATISTIC_CLIPPING_INVOCATIONS_BIT |
                              VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT,
    };
    return vk_fixed_try(job, vkCreateQueryPool, device, &occlusion, NULL, &job->occlusion) &&
           vk_fixed_try(job, vkCreateQueryPool, device, &statistics, NULL, &job->statistics);
}

// --- a draw ---

static bool execute(struct vk_fixed_job *job)
{
    rg_fixed_make_vertices(job->state, &job->vertices);
    return make_buffers(job) && (!job->state->texels || vk_fixed_texture(job)) &&
           (!job->state->queries || make_queries(job)) && vk_fixed_targets(job) &&
           vk_fixed_slots(job) && vk_fixed_pipeline(job) && vk_fixed_run(job);
}

static void release(struct vk_fixed_job *job)
{
    struct vk_device *own = &job->fixed->own;
    const VkDevice device = own->handle;
    vkDeviceWaitIdle(device);
    vkDestroyQueryPool(device, job->occlusion, NULL);
    vkDestroyQueryPool(device, job->statistics, NULL);
    vkDestroyPipeline(device, job->pipeline, NULL);
    for (int i = 0; i < RG_FIXED_STAGES; i++)
        vkDestroyShaderModule(device, job->modules[i], NULL);
    vkDestroyPipelineLayout(device, job->layout, NULL);
    vkDestroyDescriptorPool(device, job->set_pool, NULL);
    vkDestroyDescriptorSetLayout(device, job->set_layout, NULL);
    vkDestroyFramebuffer(device, job->framebuffer, NULL);
    vkDestroyRenderPass(device, job->render_pass, NULL);
    vkDestroySampler(device, job->sampler, NULL);
    vk_fixed_image_destroy(job, &job->texture);
    for (int i = 0; i < RG_FIXED_STORES; i++)
        vk_fixed_image_destroy(job, &job->stores[i]);
    for (int i = 0; i < RG_FIXED_EQUATIONS; i++)
        vk_fixed_image_destroy(job, &job->colours[i]);
    vk_fixed_image_destroy(job, &job->depth);
    vk_fixed_image_destroy(job, &job->copy);
    for (int i = 0; i < VK_FIXED_BUFFERS; i++)
        vk_block_destroy(own, &job->buffers[i]);
}

static void note_precision(const struct vk_fixed *fixed, struct rg_fixed_picture *picture)
{
    const VkPhysicalDeviceLimits *limits = &fixed->own.limits;
    picture->precision = rg_fixed_precision_least;
    picture->precision.subpixel_bits = (int)limits->subPixelPrecisionBits;
    picture->precision.subtexel_bits = (int)limits->subTexelPrecisionBits;
    picture->precision.mip_bits = (int)limits->mipmapPrecisionBits;
    picture->precision.has_places = limits->standardSampleLocations;
}

bool vk_fixed_draw(struct rg_device *device, const char *feature,
                   const struct rg_fixed_state *state, struct rg_fixed_picture *picture)
{
    struct vk_device *vk = (struct vk_device *)device;
    struct vk_fixed *fixed = vk->fixed ? vk->fixed : vk_fixed_open(vk);
    if (!fixed)
        return false;
    note_precision(fixed, picture);
    const char *lack = vk_fixed_lacked(fixed, state);
    if (lack)
        return rg_fixed_lacks(picture, lack);
    struct vk_fixed_job *job = rg_alloc(1, sizeof(*job), feature);
    if (!job)
        return false;
    *job = (struct vk_fixed_job){
        .fixed = fixed, .state = state, .feature = feature, .picture = picture};
    const bool ok = execute(job);
    release(job);
    free(job);
    return vk_healthy(vk) && ok;
}
