#include "backends/vulkan/api/fixed/fixed.h"

enum { ATTRIBUTES = RG_FIXED_FORMATS_AT + RG_FIXED_FORMATS };

// All that a pipeline is made of, since its description points to its parts.
struct description {
    uint32_t stage_count;
    VkPipelineShaderStageCreateInfo stages[RG_FIXED_STAGES];
    VkVertexInputBindingDescription bindings[3];
    VkVertexInputAttributeDescription attributes[ATTRIBUTES];
    VkPipelineVertexInputStateCreateInfo input;
    VkPipelineInputAssemblyStateCreateInfo assembly;
    VkPipelineTessellationStateCreateInfo tessellation;
    VkViewport viewports[RG_FIXED_LAYERS];
    VkRect2D scissors[RG_FIXED_LAYERS];
    VkPipelineViewportStateCreateInfo places;
    VkPipelineRasterizationProvokingVertexStateCreateInfoEXT provoking;
    VkPipelineRasterizationStateCreateInfo rasterization;
    VkSampleMask samples;
    VkPipelineMultisampleStateCreateInfo multisample;
    VkPipelineDepthStencilStateCreateInfo depth;
    VkPipelineColorBlendAttachmentState targets[RG_FIXED_EQUATIONS];
    VkPipelineColorBlendStateCreateInfo blend;
};

VkCompareOp vk_fixed_compare(int compare)
{
    static const VkCompareOp all[] = {VK_COMPARE_OP_ALWAYS,        VK_COMPARE_OP_LESS,
                                      VK_COMPARE_OP_LESS_OR_EQUAL, VK_COMPARE_OP_GREATER,
                                      VK_COMPARE_OP_NOT_EQUAL,     VK_COMPARE_OP_ALWAYS};
    return all[compare];
}

static bool add_stages(struct vk_fixed_job *job, struct description *d)
{
    static const VkShaderStageFlagBits bits[RG_FIXED_STAGES] = {
        VK_SHADER_STAGE_VERTEX_BIT, VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT,
        VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT, VK_SHADER_STAGE_GEOMETRY_BIT,
        VK_SHADER_STAGE_FRAGMENT_BIT};
    for (enum rg_fixed_stage stage = 0; stage < RG_FIXED_STAGES; stage++) {
        const struct rg_fixed_code *code = rg_fixed_code_of(job->state, stage);
        if (!code)
            continue;
        const VkShaderModuleCreateInfo info = {
            .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
            .codeSize = code->size,
            .pCode = code->words,
        };
        if (!vk_fixed_try(job, vkCreateShaderModule, job->fixed->own.handle, &info, NULL,
                          &job->modules[stage]))
            return false;
        d->stages[d->stage_count++] = (VkPipelineShaderStageCreateInfo){
            .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
            .stage = bits[stage],
            .module = job->modules[stage],
            .pName = "main",
        };
    }
    return true;
}

static void describe_vertices(struct description *d)
{
    static const VkFormat formats[RG_FIXED_FORMATS] = {
        VK_FORMAT_R8G8B8A8_UNORM,      VK_FORMAT_R8G8B8A8_SNORM,
        VK_FORMAT_R16G16B16A16_UNORM,  VK_FORMAT_R16G16B16A16_SNORM,
        VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_A2B10G10R10_UNORM_PACK32};
    const uint32_t quad = 4 * sizeof(float);
    d->bindings[0] = (VkVertexInputBindingDescription){0, sizeof(struct rg_fixed_vertex),
                                                       VK_VERTEX_INPUT_RATE_VERTEX};
    d->bindings[1] = (VkVertexInputBindingDescription){1, quad, VK_VERTEX_INPUT_RATE_INSTANCE};
    d->bindings[2] =
        (VkVertexInputBindingDescription){2, RG_FIXED_FORMATS_STRIDE, VK_VERTEX_INPUT_RATE_VERTEX};
    for (uint32_t i = 0; i < RG_FIXED_OFFSETS_AT; i++)
        d->attributes[i] =
            (VkVertexInputAttributeDescription){i, 0, VK_FORMAT_R32G32B32A32_SFLOAT, i * quad};
    d->attributes[RG_FIXED_OFFSETS_AT] = (VkVertexInputAttributeDescription){
        RG_FIXED_OFFSETS_AT, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 0};
    for (uint32_t i = 0; i < RG_FIXED_FORMATS; i++)
        d->attributes[RG_FIXED_FORMATS_AT + i] = (VkVertexInputAttributeDescription){
            RG_FIXED_FORMATS_AT + i, 2, formats[i], (uint32_t)rg_fixed_format_offsets[i]};
    d->input = (VkPipelineVertexInputStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = 3,
        .pVertexBindingDescriptions = d->bindings,
        .vertexAttributeDescriptionCount = ATTRIBUTES,
        .pVertexAttributeDescriptions = d->attributes,
    };
}

static void describe_primitives(const struct rg_fixed_state *s, struct description *d)
{
    static const VkPrimitiveTopology topologies[] = {
        VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
        VK_PRIMITIVE_TOPOLOGY_LINE_LIST, VK_PRIMITIVE_TOPOLOGY_POINT_LIST,
        VK_PRIMITIVE_TOPOLOGY_PATCH_LIST};
    d->assembly = (VkPipelineInputAssemblyStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = topologies[s->topology],
        .primitiveRestartEnable = s->indexed,
    };
    d->tessellation = (VkPipelineTessellationStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_TESSELLATION_STATE_CREATE_INFO,
        .patchControlPoints = 3,
    };
    for (int i = 0; i < RG_FIXED_LAYERS; i++) {
        int v[4], c[4];
        rg_fixed_viewport(s, i, v);
        rg_fixed_scissor(s, i, c);
        d->viewports[i] = (VkViewport){(float)v[0], (float)v[1], (float)v[2], (float)v[3], 0, 1};
        d->scissors[i] = (VkRect2D){{c[0], c[1]}, {(uint32_t)c[2], (uint32_t)c[3]}};
    }
    const uint32_t places = s->viewports ? RG_FIXED_LAYERS : 1;
    d->places = (VkPipelineViewportStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = places,
        .pViewports = d->viewports,
        .scissorCount = places,
        .pScissors = d->scissors,
    };
}

static void describe_rasterization(const struct rg_fixed_state *s, struct description *d)
{
    static const VkCullModeFlags culls[] = {VK_CULL_MODE_NONE, VK_CULL_MODE_BACK_BIT,
                                            VK_CULL_MODE_FRONT_BIT};
    d->provoking = (VkPipelineRasterizationProvokingVertexStateCreateInfoEXT){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_PROVOKING_VERTEX_STATE_CREATE_INFO_EXT,
        .provokingVertexMode = VK_PROVOKING_VERTEX_MODE_LAST_VERTEX_EXT,
    };
    d->rasterization = (VkPipelineRasterizationStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .pNext = s->provokes_last ? &d->provoking : NULL,
        .depthClampEnable = s->depth_clamp,
        .polygonMode = VK_POLYGON_MODE_FILL,
        .cullMode = culls[s->cull],
        .frontFace = VK_FRONT_FACE_CLOCKWISE, // counter-clockwise where y points up
        .depthBiasEnable = s->offset_units || s->offset_slope_16,
        .depthBiasConstantFactor = (float)s->offset_units,
        .depthBiasSlopeFactor = (float)s->offset_slope_16 / 16,
        .lineWidth = 1,
    };
    d->samples = ~(VkSampleMask)s->samples_off;
    d->multisample = (VkPipelineMultisampleStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = s->samples ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT,
        .pSampleMask = &d->samples,
        .alphaToCoverageEnable = s->alpha_to_coverage,
    };
}

static VkStencilOpState stencil(int operation)
{
    static const VkStencilOp operations[] = {VK_STENCIL_OP_KEEP, VK_STENCIL_OP_INCREMENT_AND_WRAP,
                                             VK_STENCIL_OP_DECREMENT_AND_WRAP,
                                             VK_STENCIL_OP_INVERT};
    return (VkStencilOpState){VK_STENCIL_OP_KEEP,
                              operations[operation],
                              VK_STENCIL_OP_KEEP,
                              VK_COMPARE_OP_ALWAYS,
                              0xff,
                              0xff,
                              0};
}

static void describe_depth(const struct rg_fixed_state *s, struct description *d)
{
    d->depth = (VkPipelineDepthStencilStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = s->depth_test != 0,
        .depthWriteEnable = s->depth_test != 0,
        .depthCompareOp = vk_fixed_compare(s->depth_test),
        .stencilTestEnable = s->stencil_front || s->stencil_back,
        .front = stencil(s->stencil_front),
        .back = stencil(s->stencil_back),
    };
}

static void describe_blend(const struct rg_fixed_state *s, struct description *d)
{
    static const VkBlendOp equations[RG_FIXED_EQUATIONS] = {VK_BLEND_OP_ADD, VK_BLEND_OP_SUBTRACT,
                                                            VK_BLEND_OP_REVERSE_SUBTRACT,
                                                            VK_BLEND_OP_MIN, VK_BLEND_OP_MAX};
    static const VkBlendFactor factors[][2] = {
        [RG_FIXED_BLEND_OFF] = {VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ZERO},
        [RG_FIXED_BLEND_OVER] = {VK_BLEND_FACTOR_SRC_ALPHA, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA},
        [RG_FIXED_BLEND_EQUATIONS] = {VK_BLEND_FACTOR_SRC_ALPHA,
                                      VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA},
        [RG_FIXED_BLEND_SRC1_COLOUR] = {VK_BLEND_FACTOR_SRC1_COLOR,
                                        VK_BLEND_FACTOR_ONE_MINUS_SRC1_COLOR},
        [RG_FIXED_BLEND_SRC1_ALPHA] = {VK_BLEND_FACTOR_SRC1_ALPHA,
                                       VK_BLEND_FACTOR_ONE_MINUS_SRC1_ALPHA}};
    const VkBlendFactor *factor = factors[s->blend];
    for (int i = 0; i <= s->more_targets; i++) {
        const VkBlendOp equation = equations[s->blend == RG_FIXED_BLEND_EQUATIONS ? i : 0];
        d->targets[i] = (VkPipelineColorBlendAttachmentState){
            s->blend != 0, factor[0], factor[1], equation,
            factor[0],     factor[1], equation,  0xf & ~(VkColorComponentFlags)s->write_off};
    }
    d->blend = (VkPipelineColorBlendStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1 + (uint32_t)s->more_targets,
        .pAttachments = d->targets,
    };
}

static bool make_pipeline(struct vk_fixed_job *job, const struct description *d)
{
    const VkGraphicsPipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .stageCount = d->stage_count,
        .pStages = d->stages,
        .pVertexInputState = &d->input,
        .pInputAssemblyState = &d->assembly,
        .pTessellationState =
            job->state->between == RG_FIXED_TESSELLATION_STAGE ? &d->tessellation : NULL,
        .pViewportState = &d->places,
        .pRasterizationState = &d->rasterization,
        .pMultisampleState = &d->multisample,
        .pDepthStencilState = &d->depth,
        .pColorBlendState = &d->blend,
        .layout = job->layout,
        .renderPass = job->render_pass,
    };
    struct vk_device *own = &job->fixed->own;
    if (!vk_fixed_try(job, vkCreateGraphicsPipelines, own->handle, VK_NULL_HANDLE, 1, &info, NULL,
                      &job->pipeline))
        return false;
    vk_name(own, VK_OBJECT_TYPE_PIPELINE, VK_HANDLE(job->pipeline), job->feature);
    return true;
}

bool vk_fixed_pipeline(struct vk_fixed_job *job)
{
    const VkPipelineLayoutCreateInfo layout = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
        .setLayoutCount = 1,
        .pSetLayouts = &job->set_layout,
    };
    struct description d = {0};
    if (!vk_fixed_try(job, vkCreatePipelineLayout, job->fixed->own.handle, &layout, NULL,
                      &job->layout) ||
        !add_stages(job, &d))
        return false;
    describe_vertices(&d);
    describe_primitives(job->state, &d);
    describe_rasterization(job->state, &d);
    describe_depth(job->state, &d);
    describe_blend(job->state, &d);
    return make_pipeline(job, &d);
}
