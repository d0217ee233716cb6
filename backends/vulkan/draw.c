// DRAW passes: the primitives that core/device/packing.c has packed, through the graphics pipeline.
// Nothing is left to it that a driver may round: shaders/draw.vert says how corners stay on their
// grid.
#include "backends/vulkan/vulkan.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/device/formats.h"
#include "kernels/dialect/draw/clip.h"

// --- slots ---

void vk_draw_slots(struct vk_pass *pass)
{
    static const struct rg_slot_info stages[] = {
        {"packed primitives", RG_SLOT_PRIMS, RG_SLOT_IN, 4, RG_FORMAT_NONE},
        {"visible samples", RG_SLOT_SAMPLES, RG_SLOT_ATOMIC, 4, RG_FORMAT_NONE},
        {"depth behind", RG_SLOT_BEHIND, RG_SLOT_IMAGE, 0, RG_D32F},
    };
    for (size_t i = 0; i < sizeof(stages) / sizeof(stages[0]); i++)
        pass->slots[pass->slot_count++] = stages[i];
}

// A shader's slots must be bound, also where this draw counts nothing.
static bool create_dummies(struct vk_device *device)
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
    const bool behind = draw->samples && draw->depth_mode != RG_DEPTH_OFF;
    VkImageView depth = behind ? vk_place(device, draw->depth, draw->layer, draw->level)
                               : ((struct vk_image *)device->no_depth)->sampled;
    vk_slot_buffer(&descriptors[RG_SLOT_PRIMS], run->packed->prims);
    vk_slot_buffer(&descriptors[RG_SLOT_SAMPLES],
                   draw->samples ? draw->samples : device->no_samples);
    vk_slot_image(&descriptors[RG_SLOT_BEHIND], device, depth);
    return depth != VK_NULL_HANDLE;
}

// --- creation ---

// What a device may lack. Corners keep their place on the grid only in a viewport as large as
// kernels/dialect/draw/clip.h says.
static bool check_able(const struct vk_device *device, const struct rg_kernel *kernel)
{
    const VkPhysicalDeviceLimits *limits = &device->limits;
    const char *name = device->pub.info.name, *says = "unsupported: kernel '%s': %s %s";
    if (!device->family.draws)
        return rg_unsupported(says, kernel->name, name, "has no queue that draws");
    if (!device->counts_samples)
        return rg_error(says, kernel->name, name,
                        "lets no fragment write (fragmentStoresAndAtomics is false)");
    if (limits->maxViewportDimensions[0] < RG_VIEWPORT_PX ||
        limits->maxViewportDimensions[1] < RG_VIEWPORT_PX || limits->subPixelPrecisionBits < 8)
        return rg_error("unsupported: kernel '%s': %s has viewports of %ux%u px and %u bits below "
                        "a pixel; %d px and 8 bits are needed",
                        kernel->name, name, limits->maxViewportDimensions[0],
                        limits->maxViewportDimensions[1], limits->subPixelPrecisionBits,
                        RG_VIEWPORT_PX);
    return true;
}

bool vk_draw_create(struct vk_device *device, const struct rg_kernel *kernel, struct vk_pass *pass)
{
    struct vk_drawing *drawing = rg_alloc(1, sizeof(*drawing), kernel->name);
    pass->drawing = drawing;
    return drawing && check_able(device, kernel) && create_dummies(device) &&
           vk_module_create(device, kernel, RG_CODE_VERTEX_SPIRV, &drawing->vertex) &&
           vk_module_create(device, kernel, RG_CODE_FRAGMENT_SPIRV, &drawing->fragment);
}

void vk_draw_destroy(struct vk_device *device, struct vk_pass *pass)
{
    struct vk_drawing *drawing = pass->drawing;
    if (!drawing)
        return;
    const int count = sizeof(drawing->pipelines) / sizeof(VkPipeline);
    for (int i = 0; i < count; i++)
        vkDestroyPipeline(device->handle, (&drawing->pipelines[0][0][0])[i], NULL);
    vkDestroyShaderModule(device->handle, drawing->fragment, NULL);
    vkDestroyShaderModule(device->handle, drawing->vertex, NULL);
    free(drawing);
}

void vk_draw_close(struct vk_device *device)
{
    if (device->no_samples)
        vk_buf_destroy(device->no_samples);
    if (device->no_depth)
        vk_image_destroy(device->no_depth);
    vk_targets_close(device);
}

// --- pipelines ---

// One way to draw.
struct look {
    struct vk_target target;
    enum rg_blend blend;
    enum rg_depth_mode depth_mode;
};

static struct look look_of(const struct rg_draw *draw)
{
    const struct vk_target target = vk_target_of(draw);
    return (struct look){
        .target = target,
        .blend = target.colour == RG_FORMAT_NONE ? RG_BLEND_OFF : draw->blend,
        .depth_mode = target.depth ? draw->depth_mode : RG_DEPTH_OFF,
    };
}

// Drivers need not draw to every format, nor blend.
static bool check_formats(const struct vk_device *device, const struct look *look, const char *name)
{
    const enum rg_format formats[] = {look->target.colour,
                                      look->target.depth ? RG_D32F : RG_FORMAT_NONE};
    const VkFormatFeatureFlags needed[] = {
        VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT |
            (look->blend == RG_BLEND_OFF ? 0 : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT),
        VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT};
    for (int i = 0; i < 2; i++) {
        VkFormatProperties able;
        if (formats[i] == RG_FORMAT_NONE)
            continue;
        vkGetPhysicalDeviceFormatProperties(device->physical, vk_format(formats[i]), &able);
        if ((able.optimalTilingFeatures & needed[i]) != needed[i])
            return rg_error("unsupported: kernel '%s': %s does not %s to %s", name,
                            device->pub.info.name, look->blend == RG_BLEND_OFF ? "draw" : "blend",
                            rg_format_name(formats[i]));
    }
    return true;
}

static VkPipelineColorBlendAttachmentState blend_state(enum rg_blend blend)
{
    const VkBlendFactor kept =
        blend == RG_BLEND_OVER ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
    return (VkPipelineColorBlendAttachmentState){
        .blendEnable = blend != RG_BLEND_OFF,
        .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstColorBlendFactor = kept,
        .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstAlphaBlendFactor = kept,
        .colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                          VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT,
    };
}

static VkPipelineDepthStencilStateCreateInfo depth_state(enum rg_depth_mode mode)
{
    return (VkPipelineDepthStencilStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = mode != RG_DEPTH_OFF,
        .depthWriteEnable = mode == RG_DEPTH_WRITE,
        .depthCompareOp = VK_COMPARE_OP_LESS,
    };
}

static VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit, VkShaderModule module)
{
    return (VkPipelineShaderStageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
        .stage = bit,
        .module = module,
        .pName = "main",
    };
}

// Both faces are filled: packing has culled. Corners come from the packed primitives alone.
static VkGraphicsPipelineCreateInfo plain_pipeline(void)
{
    static const VkPipelineVertexInputStateCreateInfo no_input = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    static const VkPipelineInputAssemblyStateCreateInfo triangles = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    static const VkPipelineViewportStateCreateInfo viewport = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    static const VkPipelineRasterizationStateCreateInfo fill = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .polygonMode = VK_POLYGON_MODE_FILL,
        .cullMode = VK_CULL_MODE_NONE,
        .lineWidth = 1.0f};
    static const VkPipelineMultisampleStateCreateInfo one_sample = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    static const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    static const VkPipelineDynamicStateCreateInfo dynamic = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = 2,
        .pDynamicStates = states};
    return (VkGraphicsPipelineCreateInfo){
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pVertexInputState = &no_input,
        .pInputAssemblyState = &triangles,
        .pViewportState = &viewport,
        .pRasterizationState = &fill,
        .pMultisampleState = &one_sample,
        .pDynamicState = &dynamic,
    };
}

static bool create_pipeline(struct vk_device *device, struct vk_pass *pass, const struct look *look,
                            VkPipeline *pipeline)
{
    const char *name = pass->pub.kernel->name;
    const VkPipelineShaderStageCreateInfo stages[] = {
        stage(VK_SHADER_STAGE_VERTEX_BIT, pass->drawing->vertex),
        stage(VK_SHADER_STAGE_FRAGMENT_BIT, pass->drawing->fragment)};
    const VkPipelineColorBlendAttachmentState attachment = blend_state(look->blend);
    const VkPipelineColorBlendStateCreateInfo blend = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &attachment,
    };
    const VkPipelineDepthStencilStateCreateInfo depth = depth_state(look->depth_mode);
    VkGraphicsPipelineCreateInfo info = plain_pipeline();
    info.stageCount = 2;
    info.pStages = stages;
    info.pColorBlendState = &blend;
    info.pDepthStencilState = &depth;
    info.layout = pass->layout;
    info.renderPass = vk_render_pass(device, look->target, name);
    if (!info.renderPass || !vk_try("kernel", name, vkCreateGraphicsPipelines, device->handle,
                                    VK_NULL_HANDLE, 1, &info, NULL, pipeline)) {
        *pipeline = VK_NULL_HANDLE;
        return false;
    }
    vk_name(device, VK_OBJECT_TYPE_PIPELINE, VK_HANDLE(*pipeline), name);
    return true;
}

static VkPipeline pipeline_for(struct vk_device *device, struct vk_pass *pass,
                               const struct look *look)
{
    VkPipeline *kept =
        &pass->drawing->pipelines[look->target.colour][look->blend][look->depth_mode];
    if (!*kept && check_formats(device, look, pass->pub.kernel->name))
        create_pipeline(device, pass, look, kept);
    return *kept;
}

// --- running ---

// The viewport that shaders/draw.vert places corners in, and the scissor.
static void set_area(const struct vk_batch *batch, const struct rg_draw *draw, int width,
                     int height)
{
    const VkViewport viewport = {
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

bool vk_draw(struct vk_device *device, const struct vk_batch *batch, struct vk_pass *pass,
             const struct rg_run *run, uint32_t params_offset)
{
    const struct rg_draw *draw = run->draw;
    const struct look look = look_of(draw);
    const struct rg_image *sized = draw->colour ? draw->colour : draw->depth;
    const int width = rg_level_size(sized->desc.width, draw->level);
    const int height = rg_level_size(sized->desc.height, draw->level);
    VkPipeline pipeline = pipeline_for(device, pass, &look);
    const VkRenderPassBeginInfo begin = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
        .renderPass = vk_render_pass(device, look.target, pass->pub.kernel->name),
        .framebuffer = pipeline ? vk_framebuffer(device, draw) : VK_NULL_HANDLE,
        .renderArea = {{0, 0}, {(uint32_t)width, (uint32_t)height}},
    };
    if (!pipeline || !begin.framebuffer)
        return false;
    VkCommandBuffer commands = batch->commands;
    vk_barrier_before_draw(batch);
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pass->layout, 0, 1,
                            &pass->set, 1, &params_offset);
    set_area(batch, draw, width, height);
    vkCmdDrawIndirect(commands, ((struct vk_buf *)run->packed->args)->block.buffer, 0, 1, 0);
    vkCmdEndRenderPass(commands);
    vk_barrier_after_draw(batch);
    return true;
}
