// The graphics pipelines of a DRAW program, or of texels that are drawn: one for each draw state,
// made on first use.
#include "backends/vulkan/vulkan.h"

// A draw state.
struct draw_state {
    struct vk_target target;
    enum rg_blend blend;
    enum rg_depth_mode depth_mode;
    bool items; // else triangles: packed ones, which packing has culled, or one over the target
    enum rg_cull cull;
};

static struct draw_state draw_state_of(const struct vk_device *device,
                                       const struct rg_kernel *kernel, const struct rg_draw *draw)
{
    const struct vk_target target = vk_target_of(device, draw);
    const bool items = kernel->draw && !rg_draw_packs(&device->pub, draw);
    return (struct draw_state){
        .target = target,
        .blend = target.colour == RG_FORMAT_NONE ? RG_BLEND_OFF : draw->blend,
        .depth_mode = target.depth ? draw->depth_mode : RG_DEPTH_OFF,
        .items = items,
        .cull = items ? draw->cull : RG_CULL_NONE,
    };
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

static VkPipelineShaderStageCreateInfo stage(const struct vk_device *device,
                                             VkShaderStageFlagBits bit, VkShaderModule module)
{
    return (VkPipelineShaderStageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
        .stage = bit,
        .module = module,
        .pName = "main",
        .pSpecializationInfo = vk_constants(device),
    };
}

// There are no vertex attributes, because corners come from packed primitives or from items.
static VkGraphicsPipelineCreateInfo plain_pipeline(void)
{
    static const VkPipelineVertexInputStateCreateInfo no_input = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    static const VkPipelineViewportStateCreateInfo viewport = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
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
        .pViewportState = &viewport,
        .pMultisampleState = &one_sample,
        .pDynamicState = &dynamic,
    };
}

// Culls as the viewer sees it, to whom row 0 is the top.
static VkPipelineRasterizationStateCreateInfo fill_state(enum rg_cull cull)
{
    return (VkPipelineRasterizationStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .polygonMode = VK_POLYGON_MODE_FILL,
        .cullMode = cull == RG_CULL_NONE   ? VK_CULL_MODE_NONE
                    : cull == RG_CULL_BACK ? VK_CULL_MODE_BACK_BIT
                                           : VK_CULL_MODE_FRONT_BIT,
        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .lineWidth = 1.0f};
}

static bool create_pipeline(struct vk_device *device, struct vk_pass *pass,
                            const struct draw_state *state, VkPipeline *pipeline)
{
    const char *name = pass->pub.kernel->name;
    const struct vk_shaders *all = pass->drawing->shaders;
    const struct vk_shaders *shaders = &all[state->blend != RG_BLEND_OFF && all[1].vertex];
    const VkPipelineShaderStageCreateInfo stages[] = {
        stage(device, VK_SHADER_STAGE_VERTEX_BIT, shaders->vertex),
        stage(device, VK_SHADER_STAGE_FRAGMENT_BIT, shaders->fragment),
        stage(device, VK_SHADER_STAGE_GEOMETRY_BIT, shaders->geometry)};
    const VkPipelineInputAssemblyStateCreateInfo assembly = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology =
            state->items ? VK_PRIMITIVE_TOPOLOGY_POINT_LIST : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineRasterizationStateCreateInfo fill = fill_state(state->cull);
    const VkPipelineColorBlendAttachmentState attachment =
        blend_state(state->target.blends ? RG_BLEND_OFF : state->blend);
    const VkPipelineColorBlendStateCreateInfo blend = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .flags =
            state->target.blends
                ? VK_PIPELINE_COLOR_BLEND_STATE_CREATE_RASTERIZATION_ORDER_ATTACHMENT_ACCESS_BIT_EXT
                : 0,
        .attachmentCount = 1,
        .pAttachments = &attachment,
    };
    const VkPipelineDepthStencilStateCreateInfo depth = depth_state(state->depth_mode);
    VkGraphicsPipelineCreateInfo info = plain_pipeline();
    info.stageCount = state->items ? 3 : 2;
    info.pStages = stages;
    info.pInputAssemblyState = &assembly;
    info.pRasterizationState = &fill;
    info.pColorBlendState = &blend;
    info.pDepthStencilState = &depth;
    info.layout = pass->layout;
    info.renderPass = vk_render_pass(device, state->target, name);
    if (!info.renderPass || !vk_try("kernel", name, vkCreateGraphicsPipelines, device->handle,
                                    pass->cache, 1, &info, NULL, pipeline)) {
        *pipeline = VK_NULL_HANDLE;
        return false;
    }
    vk_name(device, VK_OBJECT_TYPE_PIPELINE, VK_HANDLE(*pipeline), name);
    return true;
}

VkPipeline vk_pipeline_of(struct vk_device *device, struct vk_pass *pass,
                          const struct rg_draw *draw)
{
    const struct draw_state state = draw_state_of(device, pass->pub.kernel, draw);
    VkPipeline *kept =
        &pass->drawing->pipelines[state.target.colour][state.blend][state.depth_mode][state.cull];
    if (!*kept)
        create_pipeline(device, pass, &state, kept);
    return *kept;
}
