// Runs DRAW passes: draws the primitives that core/device has packed through the graphics pipeline.
// The driver rounds nothing: shaders/draw.vert explains how corners stay on their grid.
#include "backends/vulkan/vulkan.h"

#include "backends/formats.h"
#include "kernels/dialect/draw/clip.h"

// --- the slots of a draw's own buffers ---

void vk_draw_slots(struct vk_pass *pass)
{
    for (int i = 0; i < RG_DRAWN_SLOTS; i++)
        pass->slots[pass->slot_count++] = rg_drawn_slots[i];
}

bool vk_draw_prepare(struct vk_device *device)
{
    const struct rg_image_desc texel = {RG_D32F, 1, 1, 1, 1};
    if (!device->no_samples && (device->no_samples = vk_buf_create(&device->pub, 4, "no samples")))
        device->no_samples->device = &device->pub;
    if (!device->no_depth &&
        (device->no_depth = vk_image_create(&device->pub, &texel, "no depth"))) {
        device->no_depth->device = &device->pub;
        device->no_depth->desc = texel;
    }
    return device->no_samples && device->no_depth;
}

bool vk_draw_fill(struct vk_device *device, const struct rg_run *run,
                  union vk_descriptor descriptors[RG_MAX_SLOTS])
{
    const struct rg_draw *draw = run->draw;
    const bool behind = rg_draw_counts(draw) && draw->depth_mode != RG_DEPTH_OFF;
    VkImageView depth = behind ? vk_place(device, draw->depth, draw->layer, draw->level)
                               : ((struct vk_image *)device->no_depth)->sampled;
    vk_slot_buffer(&descriptors[RG_SLOT_PRIMS],
                   run->packed ? run->packed->prims : device->no_samples);
    vk_slot_buffer(&descriptors[RG_SLOT_SAMPLES],
                   rg_draw_counts(draw) ? draw->samples : device->no_samples);
    vk_slot_image(&descriptors[RG_SLOT_BEHIND], device, RG_TEXELS, depth);
    return depth != VK_NULL_HANDLE;
}

void vk_draw_close(struct vk_device *device)
{
    if (device->no_samples)
        vk_buf_destroy(device->no_samples);
    if (device->no_depth)
        vk_image_destroy(device->no_depth);
    vkDestroyDescriptorSetLayout(device->handle, device->before, NULL);
    vk_queries_close(device);
    vk_targets_close(device);
}

bool vk_can_blend(const struct rg_device *device, const char **word)
{
    *word = VK_EXT_RASTERIZATION_ORDER_ATTACHMENT_ACCESS_EXTENSION_NAME;
    return ((const struct vk_device *)device)->ordered;
}

// --- running ---

// Sets the viewport, which shaders/draw.vert assumes for packed primitives, and the scissor.
static void set_area(const struct vk_batch *batch, const struct rg_run *run, int width, int height)
{
    const struct rg_draw *draw = run->draw;
    VkViewport viewport = {.width = (float)width, .height = (float)height, .maxDepth = 1.0f};
    if (run->packed)
        viewport = (VkViewport){
            .x = (float)-((RG_VIEWPORT_PX - width) / 2),
            .y = (float)-((RG_VIEWPORT_PX - height) / 2),
            .width = RG_VIEWPORT_PX,
            .height = RG_VIEWPORT_PX,
            .maxDepth = 1.0f,
        };
    const bool whole = !draw->x1;
    const VkRect2D scissor = {
        {draw->x0, draw->y0},
        {(uint32_t)(whole ? width : draw->x1 - draw->x0),
         (uint32_t)(whole ? height : draw->y1 - draw->y0)},
    };
    vkCmdSetViewport(batch->commands, 0, 1, &viewport);
    vkCmdSetScissor(batch->commands, 0, 1, &scissor);
}

// shaders/native.vert takes a vertex for each item, shaders/pass.vert three for all texels.
static void draw_once(VkCommandBuffer commands, const struct rg_kernel *kernel,
                      const struct rg_run *run)
{
    const rg_draw_state *state = run->params; // an rg_draw_call begins with it
    if (!kernel->draw)
        vkCmdDraw(commands, 3, 1, 0, 0);
    else if (run->packed)
        vkCmdDrawIndirect(commands, ((struct vk_buf *)run->packed->args)->block.buffer, 0, 1, 0);
    else
        vkCmdDraw(commands, (uint32_t)(state->item_end - state->item_begin), 1,
                  (uint32_t)state->item_begin, 0);
}

bool vk_draw(struct vk_device *device, const struct vk_batch *batch, struct vk_pass *pass,
             const struct rg_run *run, uint32_t params_offset)
{
    const struct rg_draw *draw = run->draw;
    const struct rg_image *sized = draw->colour ? draw->colour : draw->depth;
    const int width = rg_level_size(sized->desc.width, draw->level);
    const int height = rg_level_size(sized->desc.height, draw->level);
    const struct vk_target target = vk_target_of(device, draw);
    VkDescriptorSet sets[2] = {pass->set, VK_NULL_HANDLE};
    VkPipeline pipeline = vk_pipeline_of(device, pass, draw);
    const VkRenderPassBeginInfo begin = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
        .renderPass = vk_render_pass(device, target, pass->pub.kernel->name),
        .framebuffer = pipeline ? vk_framebuffer(device, draw) : VK_NULL_HANDLE,
        .renderArea = {{0, 0}, {(uint32_t)width, (uint32_t)height}},
    };
    if (!pipeline || !begin.framebuffer || !vk_queries_prepare(device, batch, run->queries) ||
        (target.blends && !vk_slot_before(device, batch, pass, draw, &sets[1])))
        return false;
    VkCommandBuffer commands = batch->commands;
    vk_barrier_before_draw(device, batch);
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pass->layout, 0,
                            target.blends ? 2 : 1, sets, 1, &params_offset);
    set_area(batch, run, width, height);
    if (run->queries)
        vk_draw_queries(device, batch, run);
    else
        draw_once(commands, pass->pub.kernel, run);
    vkCmdEndRenderPass(commands);
    if (run->queries)
        vk_answer_queries(device, batch, run);
    vk_barrier_after_draw(device, batch);
    return true;
}
