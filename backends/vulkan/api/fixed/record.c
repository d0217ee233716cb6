// Records a draw, waits for it, and reads what it left.
#include "backends/vulkan/api/fixed/fixed.h"

#include <string.h>

#include "core/base/log.h"

// --- drawing ---

static void clear_stores(const struct vk_fixed_job *job)
{
    const VkClearColorValue zero = {{0}};
    const VkImageSubresourceRange all = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    for (int i = 0; i < RG_FIXED_STORES; i++) {
        vk_fixed_turn(job->fixed->commands, &job->stores[i], VK_IMAGE_LAYOUT_UNDEFINED,
                      VK_IMAGE_LAYOUT_GENERAL);
        vkCmdClearColorImage(job->fixed->commands, job->stores[i].handle, VK_IMAGE_LAYOUT_GENERAL,
                             &zero, 1, &all);
    }
}

static void begin_pass(const struct vk_fixed_job *job)
{
    const struct rg_fixed_state *state = job->state;
    VkClearValue values[RG_FIXED_EQUATIONS + 2];
    const uint32_t colours = 1 + (uint32_t)state->more_targets + (state->samples ? 1 : 0);
    for (uint32_t i = 0; i < colours; i++)
        memcpy(values[i].color.float32, rg_fixed_before, sizeof(values[i].color.float32));
    values[colours].depthStencil = (VkClearDepthStencilValue){1, 0};
    const VkRenderPassBeginInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
        .renderPass = job->render_pass,
        .framebuffer = job->framebuffer,
        .renderArea = {{0, 0}, {RG_FIXED_PX, RG_FIXED_PX}},
        .clearValueCount = colours + 1,
        .pClearValues = values,
    };
    vkCmdBeginRenderPass(job->fixed->commands, &info, VK_SUBPASS_CONTENTS_INLINE);
}

static void bind(const struct vk_fixed_job *job)
{
    const VkCommandBuffer commands = job->fixed->commands;
    const VkBuffer buffers[] = {job->buffers[VK_FIXED_VERTICES].buffer,
                                job->buffers[VK_FIXED_OFFSETS].buffer,
                                job->buffers[VK_FIXED_FORMATS].buffer};
    const VkDeviceSize offsets[] = {0, 0, 0};
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, job->pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, job->layout, 0, 1, &job->set,
                            0, NULL);
    vkCmdBindVertexBuffers(commands, 0, 3, buffers, offsets);
    vkCmdBindIndexBuffer(commands, job->buffers[VK_FIXED_INDICES].buffer, 0, VK_INDEX_TYPE_UINT16);
}

static void call(const struct vk_fixed_job *job)
{
    const struct rg_fixed_state *state = job->state;
    const VkCommandBuffer commands = job->fixed->commands;
    const struct rg_fixed_arguments a = rg_fixed_arguments(state, &job->vertices);
    if (state->indexed && state->indirect)
        vkCmdDrawIndexedIndirect(commands, job->buffers[VK_FIXED_ARGUMENTS].buffer, 0, 1,
                                 sizeof(a));
    else if (state->indexed)
        vkCmdDrawIndexed(commands, a.count, a.instances, 0, a.base_vertex, a.first_instance);
    else
        vkCmdDraw(commands, a.count, a.instances, 0, a.first_instance);
}

static void record_draw(const struct vk_fixed_job *job)
{
    const struct vk_fixed *fixed = job->fixed;
    const VkCommandBuffer commands = fixed->commands;
    const VkDeviceSize zero = 0;
    if (job->state->queries) {
        vkCmdResetQueryPool(commands, job->occlusion, 0, 1);
        vkCmdResetQueryPool(commands, job->statistics, 0, 1);
    }
    begin_pass(job);
    bind(job);
    if (job->state->queries) {
        vkCmdBeginQuery(commands, job->occlusion, 0, VK_QUERY_CONTROL_PRECISE_BIT);
        vkCmdBeginQuery(commands, job->statistics, 0, 0);
    }
    if (job->state->feedback) {
        fixed->bind_feedback(commands, 0, 1, &job->buffers[VK_FIXED_FEEDBACK].buffer, &zero, NULL);
        fixed->begin_feedback(commands, 0, 0, NULL, NULL);
    }
    call(job);
    if (job->state->feedback)
        fixed->end_feedback(commands, 0, 0, NULL, NULL);
    if (job->state->queries) {
        vkCmdEndQuery(commands, job->statistics, 0);
        vkCmdEndQuery(commands, job->occlusion, 0);
    }
    vkCmdEndRenderPass(commands);
    vk_fixed_barrier(commands);
}

// --- taking images ---

static void take(struct vk_fixed_job *job, const struct vk_fixed_image *image, VkImageLayout layout,
                 VkImageAspectFlags aspect, uint32_t px, size_t texel)
{
    const VkBufferImageCopy copy = {
        .bufferOffset = job->result_used,
        .imageSubresource = {aspect, 0, 0, image->layers},
        .imageExtent = {px, px, 1},
    };
    vkCmdCopyImageToBuffer(job->fixed->commands, image->handle, layout,
                           job->buffers[VK_FIXED_RESULT].buffer, 1, &copy);
    job->result_used += (VkDeviceSize)px * px * image->layers * texel;
}

static void make_smaller(const struct vk_fixed_job *job)
{
    const VkCommandBuffer commands = job->fixed->commands;
    const VkImageSubresourceLayers layer = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const VkImageBlit blit = {
        .srcSubresource = layer,
        .srcOffsets = {{0, 0, 0}, {RG_FIXED_PX, RG_FIXED_PX, 1}},
        .dstSubresource = layer,
        .dstOffsets = {{0, 0, 0}, {RG_FIXED_BLIT_PX, RG_FIXED_BLIT_PX, 1}},
    };
    vk_fixed_turn(commands, &job->copy, VK_IMAGE_LAYOUT_UNDEFINED,
                  VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdBlitImage(commands, job->colours[0].handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                   job->copy.handle, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit,
                   job->state->blit == 1 + RG_FIXED_LINEAR ? VK_FILTER_LINEAR : VK_FILTER_NEAREST);
    vk_fixed_turn(commands, &job->copy, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                  VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
}

static const size_t colour_bytes[RG_FIXED_FORMAT_COUNT] = {4, 8, 16};
static const size_t depth_bytes[] = {0, 2, 4, 4};
static const size_t store_bytes[RG_FIXED_STORES] = {4, 8, 4, 4};

// The images in the order of parts: colours, depth, stencil, stores.
static void record_taking(struct vk_fixed_job *job)
{
    const struct rg_fixed_state *state = job->state;
    const VkImageLayout source = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    const VkImageAspectFlags colour = VK_IMAGE_ASPECT_COLOR_BIT;
    if (state->blit)
        make_smaller(job);
    if (job->copy.handle)
        take(job, &job->copy, source, colour, state->blit ? RG_FIXED_BLIT_PX : RG_FIXED_PX,
             colour_bytes[state->format]);
    for (int i = 0; !job->copy.handle && i <= state->more_targets; i++)
        take(job, &job->colours[i], source, colour, RG_FIXED_PX, colour_bytes[state->format]);
    if (state->depth)
        take(job, &job->depth, source, VK_IMAGE_ASPECT_DEPTH_BIT, RG_FIXED_PX,
             depth_bytes[state->depth]);
    if (state->depth == RG_FIXED_D32F_S8)
        take(job, &job->depth, source, VK_IMAGE_ASPECT_STENCIL_BIT, RG_FIXED_PX, 1);
    for (int i = 0; state->stores && i < RG_FIXED_STORES; i++)
        take(job, &job->stores[i], VK_IMAGE_LAYOUT_GENERAL, colour, RG_FIXED_PX, store_bytes[i]);
    vk_fixed_barrier(job->fixed->commands);
}

// --- submitting ---

static bool submit(struct vk_fixed_job *job)
{
    struct vk_fixed *fixed = job->fixed;
    const VkDevice device = fixed->own.handle;
    const VkSubmitInfo info = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
        .commandBufferCount = 1,
        .pCommandBuffers = &fixed->commands,
    };
    return vk_fixed_try(job, vkEndCommandBuffer, fixed->commands) &&
           vk_fixed_try(job, vkQueueSubmit, fixed->own.queue, 1, &info, fixed->fence) &&
           vk_fixed_try(job, vkWaitForFences, device, 1, &fixed->fence, VK_TRUE, UINT64_MAX) &&
           vk_fixed_try(job, vkResetFences, device, 1, &fixed->fence);
}

// --- reading ---

static bool add(struct vk_fixed_job *job, const void *bytes, size_t size, size_t texel)
{
    void *part = rg_fixed_part(job->picture, size);
    if (!part)
        return rg_harness_error("feature '%s': no room for its picture", job->feature);
    memcpy(part, bytes, size);
    rg_fixed_look(job->picture, size, texel);
    return true;
}

// The next part of what was taken of images.
static bool add_taken(struct vk_fixed_job *job, int texels, size_t texel)
{
    const uint8_t *mapped = job->buffers[VK_FIXED_RESULT].memory.mapped;
    const size_t size = (size_t)texels * texel;
    const bool ok = add(job, mapped + job->result_used, size, texel);
    job->result_used += size;
    return ok;
}

static bool add_images(struct vk_fixed_job *job)
{
    const struct rg_fixed_state *state = job->state;
    const int px = state->blit ? RG_FIXED_BLIT_PX : RG_FIXED_PX, all = RG_FIXED_PX * RG_FIXED_PX;
    bool ok = true;
    job->result_used = 0;
    for (int i = 0; ok && i <= state->more_targets; i++)
        ok = add_taken(job, px * px * (state->layers ? state->layers : 1),
                       colour_bytes[state->format]);
    ok = ok && (!state->depth || add_taken(job, all, depth_bytes[state->depth])) &&
         (state->depth != RG_FIXED_D32F_S8 || add_taken(job, all, 1));
    for (int i = 0; ok && state->stores && i < RG_FIXED_STORES; i++)
        ok = add_taken(job, all, store_bytes[i]);
    return ok;
}

static bool add_queries(struct vk_fixed_job *job)
{
    const VkDevice device = job->fixed->own.handle;
    const VkQueryResultFlags flags = VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT;
    uint64_t counts[1 + RG_FIXED_STATISTICS] = {0};
    if (!vk_fixed_try(job, vkGetQueryPoolResults, device, job->occlusion, 0, 1, sizeof(counts[0]),
                      &counts[0], sizeof(counts[0]), flags) ||
        !vk_fixed_try(job, vkGetQueryPoolResults, device, job->statistics, 0, 1,
                      RG_FIXED_STATISTICS * sizeof(counts[0]), &counts[1],
                      RG_FIXED_STATISTICS * sizeof(counts[0]), flags))
        return false;
    for (int i = 0; i < 1 + RG_FIXED_STATISTICS; i++)
        job->picture->is_constant = job->picture->is_constant || !counts[i];
    return add(job, counts, sizeof(counts), sizeof(counts));
}

static bool read_all(struct vk_fixed_job *job)
{
    const struct rg_fixed_state *state = job->state;
    return add_images(job) &&
           (!state->counts || add(job, job->buffers[VK_FIXED_COUNTS].memory.mapped,
                                  RG_FIXED_COUNTS * sizeof(uint32_t), sizeof(uint32_t))) &&
           (!state->feedback ||
            add(job, job->buffers[VK_FIXED_FEEDBACK].memory.mapped,
                3 * RG_FIXED_MAX_VERTICES * RG_FIXED_CAUGHT_BYTES, RG_FIXED_CAUGHT_BYTES)) &&
           (!state->queries || add_queries(job));
}

bool vk_fixed_run(struct vk_fixed_job *job)
{
    const VkCommandBuffer commands = job->fixed->commands;
    const VkCommandBufferBeginInfo begin = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
    };
    if (!vk_fixed_try(job, vkBeginCommandBuffer, commands, &begin))
        return false;
    vk_group_begin(&job->fixed->own, commands, job->feature);
    if (job->state->texels)
        vk_fixed_upload(job);
    if (job->state->stores)
        clear_stores(job);
    vk_fixed_barrier(commands);
    record_draw(job);
    record_taking(job);
    vk_group_end(&job->fixed->own, commands);
    return submit(job) && read_all(job);
}
