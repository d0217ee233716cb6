#include <vulkan/vulkan.h>
#define TRY(call) ((call) == VK_SUCCESS ? (void)0 : FAIL(2, "failed: %s\n", #call))
#define INFO(Type, TYPE, ...) (&(Vk##Type){.sType = VK_STRUCTURE_TYPE_##TYPE, __VA_ARGS__})
#define NEW(Type, TYPE, to, ...) TRY(vkCreate##Type(device, INFO(Type##CreateInfo, TYPE##_CREATE_INFO, __VA_ARGS__), NULL, to))
#define TARGET VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT // of a draw: bound to no descriptor
#define OF(s) objects[(s) - slots]
static struct { VkBuffer buffer; VkImage image; VkImageView view; VkSampler sampler; } objects[16]; // buffers hold images' texels, too
static VkPhysicalDeviceMemoryProperties memory; static VkDevice device; static VkQueue queue; static VkCommandBuffer commands;
static VkPipelineLayout layout; static VkDescriptorSet set;

static void open_device(unsigned index) {
    VkInstance instance; VkPhysicalDevice all[16]; VkQueueFamilyProperties families[16]; VkCommandPool pool;
    uint32_t found = 16, family = 0, family_count = 16, draws = items > 0, wanted = draws ? VK_QUEUE_GRAPHICS_BIT : VK_QUEUE_COMPUTE_BIT;
    VkApplicationInfo *app = INFO(ApplicationInfo, APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_2);
    if (vkCreateInstance(INFO(InstanceCreateInfo, INSTANCE_CREATE_INFO, .pApplicationInfo = app), NULL, &instance) ||
        vkEnumeratePhysicalDevices(instance, &found, all) < 0 || index >= found) FAIL(77, "there is no Vulkan device %u\n", index);
    vkGetPhysicalDeviceMemoryProperties(all[index], &memory);
    vkGetPhysicalDeviceQueueFamilyProperties(all[index], &family_count, families);
    while (family + 1 < family_count && !(families[family].queueFlags & wanted)) family++;
    TRY(vkCreateDevice(all[index], INFO(DeviceCreateInfo, DEVICE_CREATE_INFO, .queueCreateInfoCount = 1, .pQueueCreateInfos =
        INFO(DeviceQueueCreateInfo, DEVICE_QUEUE_CREATE_INFO, .queueFamilyIndex = family, .queueCount = 1, .pQueuePriorities = &(float){1}),
        .pEnabledFeatures = &(VkPhysicalDeviceFeatures){.geometryShader = draws, .fragmentStoresAndAtomics = draws}), NULL, &device));
    vkGetDeviceQueue(device, family, 0, &queue);
    NEW(CommandPool, COMMAND_POOL, &pool, .queueFamilyIndex = family);
    TRY(vkAllocateCommandBuffers(device, INFO(CommandBufferAllocateInfo, COMMAND_BUFFER_ALLOCATE_INFO, .commandPool = pool,
        .commandBufferCount = 1), &commands));
    TRY(vkBeginCommandBuffer(commands, INFO(CommandBufferBeginInfo, COMMAND_BUFFER_BEGIN_INFO, .flags = 1)));
}

static VkDeviceMemory allocate(VkMemoryRequirements needs, VkMemoryPropertyFlags wanted) {
    VkDeviceMemory held; uint32_t i = 0;
    while (!(needs.memoryTypeBits >> i & 1) || wanted & ~memory.memoryTypes[i].propertyFlags) i++;
    TRY(vkAllocateMemory(device, INFO(MemoryAllocateInfo, MEMORY_ALLOCATE_INFO, .allocationSize = needs.size, .memoryTypeIndex = i),
        NULL, &held));
    return held;
}

static void wait_for_all(const struct slot *fresh) { // writes are visible to later commands and the host; a fresh image gets its layout
    vkCmdPipelineBarrier(commands, 0x10000, 0x14000, 0, 1, // all commands; and the host
        INFO(MemoryBarrier, MEMORY_BARRIER, .srcAccessMask = 0x10000, .dstAccessMask = 0x18000), 0, NULL, fresh != NULL,
        INFO(ImageMemoryBarrier, IMAGE_MEMORY_BARRIER, .dstAccessMask = 0x18000, .newLayout = VK_IMAGE_LAYOUT_GENERAL, .image =
             fresh ? OF(fresh).image : VK_NULL_HANDLE, .subresourceRange = {fresh ? fresh->aspect : 0, 0, ~0u, 0, ~0u}));
}

static void copy(const struct slot *s, int back) { // between an image and its buffer, level by level
    VkBufferImageCopy part = {.imageSubresource = {s->aspect, 0, 0, s->layers}};
    for (unsigned level = 0, w = s->width, h = s->height; level < s->levels; level++, w = w / 2 + (w < 2), h = h / 2 + (h < 2)) {
        part.imageSubresource.mipLevel = level, part.imageExtent = (VkExtent3D){w, h, 1};
        if (back) vkCmdCopyImageToBuffer(commands, OF(s).image, VK_IMAGE_LAYOUT_GENERAL, OF(s).buffer, 1, &part);
        else vkCmdCopyBufferToImage(commands, OF(s).buffer, OF(s).image, VK_IMAGE_LAYOUT_GENERAL, 1, &part);
        part.bufferOffset += (VkDeviceSize)w * h * s->layers * s->texel;
    }
}

static void make_slot(struct slot *s) {
    const int stored = s->type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, drawn = s->aspect == VK_IMAGE_ASPECT_DEPTH_BIT ? 0x23 : 0x13;
    VkMemoryRequirements needs;
    NEW(Buffer, BUFFER, &OF(s).buffer, .size = s->size, .usage = 0x33); // copies both ways, a uniform block, storage
    vkGetBufferMemoryRequirements(device, OF(s).buffer, &needs);
    VkDeviceMemory held = allocate(needs, 0x6); // visible to the host, and coherent
    TRY(vkBindBufferMemory(device, OF(s).buffer, held, 0));
    TRY(vkMapMemory(device, held, 0, VK_WHOLE_SIZE, 0, (void **)&s->bytes));
    read_parts(s->before, memset(s->bytes, 0, s->size), s->size);
    if (!s->format) return;
    NEW(Image, IMAGE, &OF(s).image, .flags = s->view_type == VK_IMAGE_VIEW_TYPE_CUBE ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0,
        .imageType = VK_IMAGE_TYPE_2D, .format = s->format, .extent = {s->width, s->height, 1}, .mipLevels = s->levels,
        .arrayLayers = s->layers, .samples = 1, .usage = s->type == TARGET ? drawn : stored ? 0xb : 0x7); // copies, and one use
    vkGetImageMemoryRequirements(device, OF(s).image, &needs);
    TRY(vkBindImageMemory(device, OF(s).image, allocate(needs, 0), 0));
    NEW(ImageView, IMAGE_VIEW, &OF(s).view, .image = OF(s).image, .viewType = s->view_type, .format = s->format,
        .subresourceRange = {s->aspect, 0, stored ? 1 : s->levels, 0, s->layers});
    NEW(Sampler, SAMPLER, &OF(s).sampler, .magFilter = s->filter, .minFilter = s->filter, .mipmapMode = s->filter,
        .addressModeU = s->wrap, .addressModeV = s->wrap, .addressModeW = s->wrap, .compareEnable = s->compare != 0,
        .compareOp = s->compare, .maxLod = VK_LOD_CLAMP_NONE);
    wait_for_all(s), copy(s, 0);
}

static void make_set(VkShaderStageFlags stages) {
    VkDescriptorPoolSize sizes[] = {{1, 16}, {3, 16}, {6, 16}, {7, 16}}; // of each type
    VkDescriptorSetLayoutBinding bindings[16]; VkDescriptorSetLayout set_layout; VkDescriptorPool pool; unsigned bound = 0;
    EACH_SLOT if (s->type != TARGET) bindings[bound++] = (VkDescriptorSetLayoutBinding){s->at, s->type, 1, stages, NULL};
    NEW(DescriptorSetLayout, DESCRIPTOR_SET_LAYOUT, &set_layout, .bindingCount = bound, .pBindings = bindings);
    NEW(PipelineLayout, PIPELINE_LAYOUT, &layout, .setLayoutCount = 1, .pSetLayouts = &set_layout);
    NEW(DescriptorPool, DESCRIPTOR_POOL, &pool, .maxSets = 1, .poolSizeCount = 4, .pPoolSizes = sizes);
    TRY(vkAllocateDescriptorSets(device, INFO(DescriptorSetAllocateInfo, DESCRIPTOR_SET_ALLOCATE_INFO, .descriptorPool = pool,
        .descriptorSetCount = 1, .pSetLayouts = &set_layout), &set));
    EACH_SLOT if (s->type != TARGET)
        vkUpdateDescriptorSets(device, 1, INFO(WriteDescriptorSet, WRITE_DESCRIPTOR_SET, .dstSet = set, .dstBinding = s->at,
            .descriptorCount = 1, .descriptorType = s->type, .pBufferInfo = &(VkDescriptorBufferInfo){OF(s).buffer, 0, VK_WHOLE_SIZE},
            .pImageInfo = &(VkDescriptorImageInfo){OF(s).sampler, OF(s).view, VK_IMAGE_LAYOUT_GENERAL}), 0, NULL);
}

static VkPipelineShaderStageCreateInfo make_stage(VkShaderStageFlagBits stage, const char *path) {
    static const VkSpecializationMapEntry entries[] = {{0, 0, 4}, {1, 4, 4}};
    static const VkSpecializationInfo special = {2, entries, sizeof(constants), constants};
    VkShaderModule module; size_t size;
    const void *code = read_code(path, &size);
    NEW(ShaderModule, SHADER_MODULE, &module, .codeSize = size, .pCode = code);
    return (VkPipelineShaderStageCreateInfo){VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, NULL, 0, stage, module, "main", &special};
}

