static void run(void) {
    EACH_SLOT make_slot(s);
    wait_for_all(NULL);
    record_shaders();
    wait_for_all(NULL);
    EACH_SLOT if (OF(s).image && *s->expected != '-') copy(s, 1);
    wait_for_all(NULL);
    TRY(vkEndCommandBuffer(commands));
    TRY(vkQueueSubmit(queue, 1, INFO(SubmitInfo, SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands), NULL));
    TRY(vkQueueWaitIdle(queue));
}

