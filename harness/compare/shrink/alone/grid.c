static unsigned groups[3]; static void read_run(const char *line) { sscanf(line, "groups %u %u %u", &groups[0], &groups[1], &groups[2]); }

static void record_shaders(void) {
    VkPipeline pipeline;
    make_set(VK_SHADER_STAGE_COMPUTE_BIT);
    TRY(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, INFO(ComputePipelineCreateInfo, COMPUTE_PIPELINE_CREATE_INFO,
        .layout = layout, .stage = make_stage(VK_SHADER_STAGE_COMPUTE_BIT, "kernel.spv")), NULL, &pipeline));
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, NULL);
    vkCmdDispatch(commands, groups[0], groups[1], groups[2]);
}

