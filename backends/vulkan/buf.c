#include "backends/vulkan/vulkan.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"

struct rg_buf *vk_buf_create(struct rg_device *device, size_t size, const char *name)
{
    struct vk_device *vk = (struct vk_device *)device;
    struct vk_buf *buf = rg_alloc(1, sizeof(*buf), name);
    if (!buf)
        return NULL;
    const VkBufferUsageFlags usage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
        VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    bool created = vk_block_create(vk, size, usage, VK_USE_DEVICE, name, &buf->block);
    if (created && vk_healthy(vk))
        return &buf->pub;
    if (created)
        vk_block_destroy(vk, &buf->block);
    free(buf);
    return NULL;
}

void vk_buf_destroy(struct rg_buf *buf)
{
    struct vk_buf *vk = (struct vk_buf *)buf;
    vk_block_destroy((struct vk_device *)buf->device, &vk->block);
    free(vk);
}

static size_t part_of(size_t size)
{
    return size < VK_MAX_STAGING_BYTES ? size : VK_MAX_STAGING_BYTES;
}

// While the queue holds commands, writes go through it too, which keeps the order of the calls.
static bool write_staged(struct vk_device *device, struct vk_buf *buf, size_t offset,
                         const char *data, size_t size)
{
    for (size_t done = 0, part; done < size; done += part) {
        part = part_of(size - done);
        VkBufferCopy copy = {.dstOffset = offset + done, .size = part};
        void *staged;
        struct vk_batch *batch = vk_record_staged(device, part, &copy.srcOffset, &staged);
        if (!batch)
            return false;
        memcpy(staged, data + done, part);
        vk_barrier(batch);
        vkCmdCopyBuffer(batch->commands, batch->staging.buffer, buf->block.buffer, 1, &copy);
    }
    return true;
}

bool vk_buf_write(struct rg_buf *buf, size_t offset, const void *data, size_t size)
{
    struct vk_device *device = (struct vk_device *)buf->device;
    struct vk_buf *vk = (struct vk_buf *)buf;
    if (device->direct && vk->block.memory.mapped && vk_is_idle(device)) {
        memcpy((char *)vk->block.memory.mapped + offset, data, size);
        return true;
    }
    return write_staged(device, vk, offset, data, size) && vk_healthy(device);
}

static bool read_staged(struct vk_device *device, struct vk_buf *buf, size_t offset, char *data,
                        size_t size)
{
    for (size_t done = 0, part; done < size; done += part) {
        part = part_of(size - done);
        VkBufferCopy copy = {.srcOffset = offset + done, .size = part};
        void *staged;
        struct vk_batch *batch = vk_record_staged(device, part, &copy.dstOffset, &staged);
        if (!batch)
            return false;
        vk_barrier(batch);
        vkCmdCopyBuffer(batch->commands, buf->block.buffer, batch->staging.buffer, 1, &copy);
        if (!vk_wait(device))
            return false;
        memcpy(data + done, staged, part);
    }
    return true;
}

bool vk_buf_read(struct rg_buf *buf, size_t offset, void *data, size_t size)
{
    struct vk_device *device = (struct vk_device *)buf->device;
    struct vk_buf *vk = (struct vk_buf *)buf;
    if (!device->direct || !vk->block.memory.mapped)
        return read_staged(device, vk, offset, data, size) && vk_healthy(device);
    if (!vk_wait(device))
        return false;
    memcpy(data, (const char *)vk->block.memory.mapped + offset, size);
    return vk_healthy(device);
}
