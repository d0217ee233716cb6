// The logical device, and what it lacks.
#include "backends/vulkan/api/fixed/fixed.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

struct extras {
    VkPhysicalDeviceTransformFeedbackFeaturesEXT feedback;
    VkPhysicalDeviceProvokingVertexFeaturesEXT provoking;
    const char *names[2];
    uint32_t count;
};

// Asks for the extensions that are there, with their features, and for all features but the one
// that checks every access.
static bool choose(const struct vk_device *device, VkPhysicalDeviceFeatures2 *wanted,
                   struct extras *extras)
{
    bool has_feedback, has_provoking;
    *extras = (struct extras){
        .feedback = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TRANSFORM_FEEDBACK_FEATURES_EXT},
        .provoking = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROVOKING_VERTEX_FEATURES_EXT}};
    *wanted = (VkPhysicalDeviceFeatures2){.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    if (!vk_find_extension(device, VK_EXT_TRANSFORM_FEEDBACK_EXTENSION_NAME, &has_feedback) ||
        !vk_find_extension(device, VK_EXT_PROVOKING_VERTEX_EXTENSION_NAME, &has_provoking))
        return false;
    if (has_feedback) {
        extras->names[extras->count++] = VK_EXT_TRANSFORM_FEEDBACK_EXTENSION_NAME;
        wanted->pNext = &extras->feedback;
    }
    if (has_provoking) {
        extras->names[extras->count++] = VK_EXT_PROVOKING_VERTEX_EXTENSION_NAME;
        extras->provoking.pNext = wanted->pNext;
        wanted->pNext = &extras->provoking;
    }
    vkGetPhysicalDeviceFeatures2(device->physical, wanted);
    wanted->features.robustBufferAccess = VK_FALSE;
    return true;
}

static bool create_device(struct vk_fixed *fixed)
{
    const float priority = 1;
    struct vk_device *own = &fixed->own;
    VkPhysicalDeviceFeatures2 wanted;
    struct extras extras;
    if (!choose(own, &wanted, &extras))
        return false;
    const VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
        .queueFamilyIndex = own->family.index,
        .queueCount = 1,
        .pQueuePriorities = &priority,
    };
    const VkDeviceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .pNext = &wanted,
        .enabledExtensionCount = extras.count,
        .ppEnabledExtensionNames = extras.names,
        .queueCreateInfoCount = 1,
        .pQueueCreateInfos = &queue,
    };
    if (!vk_try("device", own->pub.info.name, vkCreateDevice, own->physical, &info, NULL,
                &own->handle)) {
        own->handle = VK_NULL_HANDLE;
        return false;
    }
    fixed->features = wanted.features;
    fixed->provokes_last = extras.provoking.provokingVertexLast;
    fixed->catches = extras.feedback.transformFeedback;
    vkGetDeviceQueue(own->handle, own->family.index, 0, &own->queue);
    return true;
}

static bool find_functions(struct vk_fixed *fixed)
{
#define FIND(name) (PFN_##name) vkGetDeviceProcAddr(fixed->own.handle, #name)
    if (!fixed->catches)
        return true;
    fixed->bind_feedback = FIND(vkCmdBindTransformFeedbackBuffersEXT);
    fixed->begin_feedback = FIND(vkCmdBeginTransformFeedbackEXT);
    fixed->end_feedback = FIND(vkCmdEndTransformFeedbackEXT);
#undef FIND
    return (fixed->bind_feedback && fixed->begin_feedback && fixed->end_feedback) ||
           rg_driver_error("device '%s': vkGetDeviceProcAddr finds no functions of "
                           "VK_EXT_transform_feedback, which the driver offers",
                           fixed->own.pub.info.name);
}

static bool create_commands(struct vk_fixed *fixed)
{
    const struct vk_device *own = &fixed->own;
    const char *name = own->pub.info.name;
    const VkCommandPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
        .queueFamilyIndex = own->family.index,
    };
    const VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkCommandBufferAllocateInfo commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1,
    };
    if (!vk_try("device", name, vkCreateCommandPool, own->handle, &pool, NULL, &fixed->pool) ||
        !vk_try("device", name, vkCreateFence, own->handle, &fence, NULL, &fixed->fence))
        return false;
    commands.commandPool = fixed->pool;
    return vk_try("device", name, vkAllocateCommandBuffers, own->handle, &commands,
                  &fixed->commands);
}

static void destroy(struct vk_fixed *fixed)
{
    const VkDevice handle = fixed->own.handle;
    if (handle) {
        vkDestroyFence(handle, fixed->fence, NULL);
        vkDestroyCommandPool(handle, fixed->pool, NULL);
        vkDestroyDevice(handle, NULL);
    }
    free(fixed);
}

struct vk_fixed *vk_fixed_open(struct vk_device *device)
{
    struct vk_fixed *fixed = rg_alloc(1, sizeof(*fixed), "device of fixed functions");
    if (!fixed)
        return NULL;
    fixed->own.pub = device->pub;
    fixed->own.physical = device->physical;
    fixed->own.limits = device->limits;
    fixed->own.memory = device->memory;
    fixed->own.max_allocation_bytes = device->max_allocation_bytes;
    fixed->own.direct = device->direct;
    fixed->own.family = device->family;
    fixed->own.set_name = device->set_name;
    fixed->own.begin_group = device->begin_group;
    fixed->own.end_group = device->end_group;
    if (create_device(fixed) && create_commands(fixed) && find_functions(fixed))
        return device->fixed = fixed;
    destroy(fixed);
    return NULL;
}

void vk_fixed_close(struct vk_device *device)
{
    if (device->fixed)
        destroy(device->fixed);
    device->fixed = NULL;
}

// --- what it lacks ---

static bool has(const struct vk_fixed *fixed, VkFormat format, VkFormatFeatureFlags uses)
{
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(fixed->own.physical, format, &properties);
    return (properties.optimalTilingFeatures & uses) == uses;
}

static const char *lacked_format(const struct vk_fixed *fixed, const struct rg_fixed_state *state)
{
    static const char *const depths[] = {"", "VK_FORMAT_D16_UNORM", "VK_FORMAT_D32_SFLOAT",
                                         "VK_FORMAT_D32_SFLOAT_S8_UINT"};
    static const char *const texels[] = {"",
                                         "filtering of VK_FORMAT_R8G8B8A8_UNORM",
                                         "filtering of VK_FORMAT_R8G8B8A8_SRGB",
                                         "filtering of VK_FORMAT_D32_SFLOAT",
                                         "textureCompressionBC",
                                         "textureCompressionBC",
                                         "textureCompressionETC2"};
    static const char *const colours[] = {"blending of VK_FORMAT_R8G8B8A8_UNORM",
                                          "blending of VK_FORMAT_R16G16B16A16_SFLOAT",
                                          "blending of VK_FORMAT_R32G32B32A32_SFLOAT"};
    if (state->depth &&
        !has(fixed, vk_fixed_depth(state->depth), VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT))
        return depths[state->depth];
    if (state->texels && !has(fixed, vk_fixed_texels(state->texels),
                              VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT |
                                  VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT))
        return texels[state->texels];
    if (!has(fixed, vk_fixed_colour(state->format),
             state->blend ? VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT
                          : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT))
        return colours[state->format];
    for (int i = 0; state->stores && i < RG_FIXED_STORES; i++)
        if (!has(fixed, vk_fixed_store(i), VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT))
            return "shaderStorageImageExtendedFormats";
    return NULL;
}

const char *vk_fixed_lacked(const struct vk_fixed *fixed, const struct rg_fixed_state *state)
{
    const VkPhysicalDeviceFeatures *f = &fixed->features;
    const bool is_dual = state->blend >= RG_FIXED_BLEND_SRC1_COLOUR;
    const struct {
        bool is_wanted, is_there;
        const char *name;
    } rows[] = {
        {state->anisotropy, f->samplerAnisotropy, "samplerAnisotropy"},
        {state->between == RG_FIXED_GEOMETRY_STAGE || state->between == RG_FIXED_LAYER_STAGE,
         f->geometryShader, "geometryShader"},
        {state->viewports, f->multiViewport, "multiViewport"},
        {state->between == RG_FIXED_TESSELLATION_STAGE, f->tessellationShader,
         "tessellationShader"},
        {state->depth_clamp, f->depthClamp, "depthClamp"},
        {state->topology == RG_FIXED_POINTS, f->largePoints, "largePoints"},
        {state->vertex == RG_FIXED_VERTEX_CLIPPED, f->shaderClipDistance, "shaderClipDistance"},
        {state->blend == RG_FIXED_BLEND_EQUATIONS, f->independentBlend, "independentBlend"},
        {is_dual, f->dualSrcBlend, "dualSrcBlend"},
        {state->queries, f->pipelineStatisticsQuery, "pipelineStatisticsQuery"},
        {state->queries, f->occlusionQueryPrecise, "occlusionQueryPrecise"},
        {state->counts || state->stores, f->fragmentStoresAndAtomics, "fragmentStoresAndAtomics"},
        {state->stores, f->shaderStorageImageExtendedFormats, "shaderStorageImageExtendedFormats"},
        {state->first_instance && state->indirect, f->drawIndirectFirstInstance,
         "drawIndirectFirstInstance"},
        {state->provokes_last, fixed->provokes_last, "provokingVertexLast"},
        {state->feedback, fixed->catches, "transformFeedback"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        if (rows[i].is_wanted && !rows[i].is_there)
            return rows[i].name;
    return lacked_format(fixed, state);
}
