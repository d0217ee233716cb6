#include "backends/vulkan/vulkan.h"

bool vk_sync(struct rg_device *device)
{
    struct vk_device *vk = (struct vk_device *)device;
    bool ended = vk_wait(vk);
    return vk_healthy(vk) && ended;
}

static bool read_ticks(struct vk_device *device, uint64_t *ticks)
{
    struct vk_batch *batch = vk_record(device);
    if (!batch)
        return false;
    vk_barrier(batch);
    vkCmdResetQueryPool(batch->commands, device->timestamp, 0, 1);
    vkCmdWriteTimestamp(batch->commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, device->timestamp,
                        0);
    return vk_wait(device) &&
           vk_try("device", device->pub.info.name, vkGetQueryPoolResults, device->handle,
                  device->timestamp, 0, 1, sizeof(*ticks), ticks, sizeof(*ticks),
                  VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
}

bool vk_time(struct rg_device *device, int64_t *time_ns)
{
    struct vk_device *vk = (struct vk_device *)device;
    uint64_t ticks;
    if (!read_ticks(vk, &ticks))
        return false;
    // Counters of few bits wrap within minutes, so intervals between readings are added up.
    vk->ticks_total += (ticks - vk->ticks_last) & vk->ticks_mask;
    vk->ticks_last = ticks;
    *time_ns = (int64_t)((long double)vk->ticks_total * vk->limits.timestampPeriod);
    return vk_healthy(vk);
}
