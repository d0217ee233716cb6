static VkAttachmentReference targets[2]; // colour, then depth
static VkImageView views[2];
static unsigned target_count;

static VkRenderPass make_pass(void) { // keeps what the targets hold
    VkAttachmentDescription held[2];
    VkRenderPass pass;
    for (int i = 0; i < 2; i++) targets[i] = (VkAttachmentReference){VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_GENERAL};
    EACH_SLOT
        if (s->type == TARGET) {
            targets[s->aspect == VK_IMAGE_ASPECT_DEPTH_BIT].attachment = target_count;
            NEW(ImageView, IMAGE_VIEW, &views[target_count], .image = OF(s).image, .viewType = VK_IMAGE_VIEW_TYPE_2D, .format = s->format,
                .subresourceRange = {s->aspect, draw.level, 1, draw.layer, 1});
            held[target_count++] = (VkAttachmentDescription){.format = s->format, .samples = 1, .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
                .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE, .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                .initialLayout = VK_IMAGE_LAYOUT_GENERAL, .finalLayout = VK_IMAGE_LAYOUT_GENERAL};
        }
    NEW(RenderPass, RENDER_PASS, &pass, .attachmentCount = target_count, .pAttachments = held, .subpassCount = 1,
        .pSubpasses = &(VkSubpassDescription){.colorAttachmentCount = 1, .pColorAttachments = &targets[0],
            .pDepthStencilAttachment = &targets[1]});
    return pass;
}

static VkPipeline make_pipeline(VkRenderPass pass) {
    VkPipelineShaderStageCreateInfo stages[3] = {make_stage(VK_SHADER_STAGE_VERTEX_BIT, "kernel.vert.spv"),
        make_stage(VK_SHADER_STAGE_FRAGMENT_BIT, "kernel.frag.spv")};
    if (draw.points) stages[2] = make_stage(VK_SHADER_STAGE_GEOMETRY_BIT, "kernel.geom.spv");
    const VkViewport viewport = {0, 0, (float)draw.width, (float)draw.height, 0, 1};
    const VkRect2D scissor = {{(int)draw.x, (int)draw.y}, {draw.across, draw.down}};
    const VkPipelineColorBlendAttachmentState blend = {.blendEnable = draw.blend != 0, .srcColorBlendFactor = 1,
        .dstColorBlendFactor = draw.blend, .srcAlphaBlendFactor = 1, .dstAlphaBlendFactor = draw.blend, .colorWriteMask = 0xf};
    VkPipeline pipeline;
    TRY(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, INFO(GraphicsPipelineCreateInfo, GRAPHICS_PIPELINE_CREATE_INFO,
        .stageCount = draw.points ? 3 : 2, .pStages = stages, .layout = layout, .renderPass = pass,
        .pVertexInputState = INFO(PipelineVertexInputStateCreateInfo, PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO, .flags = 0),
        .pInputAssemblyState = INFO(PipelineInputAssemblyStateCreateInfo, PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
            .topology = draw.points ? VK_PRIMITIVE_TOPOLOGY_POINT_LIST : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST),
        .pViewportState = INFO(PipelineViewportStateCreateInfo, PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1,
            .pViewports = &viewport, .scissorCount = 1, .pScissors = &scissor),
        .pRasterizationState = INFO(PipelineRasterizationStateCreateInfo, PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
            .cullMode = draw.cull, .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE, .lineWidth = 1),
        .pMultisampleState = INFO(PipelineMultisampleStateCreateInfo, PIPELINE_MULTISAMPLE_STATE_CREATE_INFO, .rasterizationSamples = 1),
        .pDepthStencilState = INFO(PipelineDepthStencilStateCreateInfo, PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
            .depthTestEnable = draw.depth > 0, .depthWriteEnable = draw.depth > 1, .depthCompareOp = VK_COMPARE_OP_LESS),
        .pColorBlendState = INFO(PipelineColorBlendStateCreateInfo, PIPELINE_COLOR_BLEND_STATE_CREATE_INFO, .attachmentCount = 1,
            .pAttachments = &blend)), NULL, &pipeline));
    return pipeline;
}

static void record_shaders(void) {
    make_set(VK_SHADER_STAGE_ALL_GRAPHICS);
    const VkRenderPass pass = make_pass();
    const VkPipeline pipeline = make_pipeline(pass);
    VkFramebuffer framebuffer;
    NEW(Framebuffer, FRAMEBUFFER, &framebuffer, .renderPass = pass, .attachmentCount = target_count, .pAttachments = views,
        .width = draw.width, .height = draw.height, .layers = 1);
    vkCmdBeginRenderPass(commands, INFO(RenderPassBeginInfo, RENDER_PASS_BEGIN_INFO, .renderPass = pass, .framebuffer = framebuffer,
        .renderArea = {{0, 0}, {draw.width, draw.height}}), VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, NULL);
    vkCmdDraw(commands, items, 1, draw.first, 0);
    vkCmdEndRenderPass(commands);
}

