#include "backends/vulkan/vulkan.h"

#include "core/base/log.h"

static const VkMemoryPropertyFlags host_flags =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

// The first type among `allowed` that has all of `wanted`, or -1.
static int find_type(const VkPhysicalDeviceMemoryProperties *memory, uint32_t allowed,
                     VkMemoryPropertyFlags wanted)
{
    for (uint32_t i = 0; i < memory->memoryTypeCount; i++)
        if ((allowed & 1u << i) && (memory->memoryTypes[i].propertyFlags & wanted) == wanted)
            return (int)i;
    return -1;
}

static const VkMemoryPropertyFlags direct_flags =
    VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
    VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

bool vk_memory_is_direct(const VkPhysicalDeviceMemoryProperties *memory)
{
    return find_type(memory, UINT32_MAX, direct_flags) >= 0;
}

static int choose_type(const struct vk_device *device, uint32_t allowed, enum vk_memory_use use)
{
    const VkMemoryPropertyFlags wishes[2][3] = {
        [VK_USE_DEVICE] = {device->direct ? direct_flags : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                           VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0},
        [VK_USE_HOST] = {host_flags | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, host_flags, host_flags},
    };
    int type = -1;
    for (int i = 0; i < 3 && type < 0; i++)
        type = find_type(&device->memory, allowed, wishes[use][i]);
    return type;
}

static bool allocate(struct vk_device *device, VkDeviceSize size, uint32_t type, const char *noun,
                     const char *name, struct vk_memory *memory)
{
    const VkMemoryType *chosen = &device->memory.memoryTypes[type];
    VkDeviceSize most = device->memory.memoryHeaps[chosen->heapIndex].size;
    if (most > device->max_allocation_bytes)
        most = device->max_allocation_bytes;
    if (size > most)
        return rg_driver_error(
            "%s '%s': %llu bytes exceed the %llu bytes that %s allows an allocation", noun, name,
            (unsigned long long)size, (unsigned long long)most, device->pub.info.name);
    const VkMemoryAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .allocationSize = size,
        .memoryTypeIndex = type,
    };
    if (!vk_try(noun, name, vkAllocateMemory, device->handle, &info, NULL, &memory->handle)) {
        memory->handle = VK_NULL_HANDLE;
        return false;
    }
    if ((chosen->propertyFlags & host_flags) == host_flags &&
        !vk_try(noun, name, vkMapMemory, device->handle, memory->handle, 0, VK_WHOLE_SIZE, 0,
                &memory->mapped)) {
        vk_memory_destroy(device, memory);
        return false;
    }
    return true;
}

bool vk_memory_create(struct vk_device *device, const VkMemoryRequirements *needs,
                      enum vk_memory_use use, const char *noun, const char *name,
                      struct vk_memory *memory)
{
    int type = choose_type(device, needs->memoryTypeBits, use);
    if (type < 0)
        return rg_driver_error("%s '%s': %s has no memory type for it", noun, name,
                               device->pub.info.name);
    return allocate(device, needs->size, (uint32_t)type, noun, name, memory);
}

void vk_memory_destroy(struct vk_device *device, struct vk_memory *memory)
{
    if (!memory->handle)
        return;
    vkFreeMemory(device->handle, memory->handle, NULL);
    *memory = (struct vk_memory){0};
}

bool vk_block_create(struct vk_device *device, VkDeviceSize size, VkBufferUsageFlags usage,
                     enum vk_memory_use use, const char *name, struct vk_block *block)
{
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = size,
        .usage = usage,
        .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
    };
    *block = (struct vk_block){.size = size};
    if (!vk_try("buffer", name, vkCreateBuffer, device->handle, &info, NULL, &block->buffer)) {
        block->buffer = VK_NULL_HANDLE;
        return false;
    }
    vk_name(device, VK_OBJECT_TYPE_BUFFER, VK_HANDLE(block->buffer), name);
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device->handle, block->buffer, &needs);
    if (vk_memory_create(device, &needs, use, "buffer", name, &block->memory) &&
        vk_try("buffer", name, vkBindBufferMemory, device->handle, block->buffer,
               block->memory.handle, 0))
        return true;
    vk_block_destroy(device, block);
    return false;
}

void vk_block_destroy(struct vk_device *device, struct vk_block *block)
{
    vkDestroyBuffer(device->handle, block->buffer, NULL);
    vk_memory_destroy(device, &block->memory);
    *block = (struct vk_block){0};
}
