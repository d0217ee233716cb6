// Draws whose visible samples are counted by the API's occlusion queries.
#include "backends/vulkan/vulkan.h"

bool vk_queries_prepare(struct vk_device *device, const struct vk_batch *batch, int count)
{
    const VkQueryPoolCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
        .queryType = VK_QUERY_TYPE_OCCLUSION,
        .queryCount = RG_MAX_QUERIES,
    };
    if (!count)
        return true;
    if (!device->occlusion && !vk_try("device", device->pub.info.name, vkCreateQueryPool,
                                      device->handle, &info, NULL, &device->occlusion))
        return false;
    vkCmdResetQueryPool(batch->commands, device->occlusion, 0, (uint32_t)count);
    return true;
}

static void draw_query(VkCommandBuffer commands, const struct rg_run *run, uint32_t query)
{
    const struct rg_items items = rg_query_items(run, (int)query);
    if (run->packed)
        vkCmdDrawIndirect(commands, ((const struct vk_buf *)run->packed->query_args)->block.buffer,
                          sizeof(VkDrawIndirectCommand) * query, 1, 0);
    else
        vkCmdDraw(commands, (uint32_t)items.count, 1, (uint32_t)items.first, 0);
}

void vk_draw_queries(const struct vk_device *device, const struct vk_batch *batch,
                     const struct rg_run *run)
{
    for (uint32_t i = 0; i < (uint32_t)run->queries; i++) {
        vkCmdBeginQuery(batch->commands, device->occlusion, i, VK_QUERY_CONTROL_PRECISE_BIT);
        draw_query(batch->commands, run, i);
        vkCmdEndQuery(batch->commands, device->occlusion, i);
    }
}

void vk_answer_queries(const struct vk_device *device, const struct vk_batch *batch,
                       const struct rg_run *run)
{
    const VkDeviceSize word = sizeof(uint32_t);
    vk_barrier(batch); // the copy of results is a transfer
    vkCmdCopyQueryPoolResults(batch->commands, device->occlusion, 0, (uint32_t)run->queries,
                              ((const struct vk_buf *)run->draw->samples)->block.buffer,
                              word * (VkDeviceSize)run->first_query, word,
                              VK_QUERY_RESULT_WAIT_BIT);
}

void vk_queries_close(struct vk_device *device)
{
    vkDestroyQueryPool(device->handle, device->occlusion, NULL);
}
