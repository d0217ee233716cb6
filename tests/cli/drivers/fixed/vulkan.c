// Faults planted into Vulkan (planted.h). This library is a driver in front of lavapipe, which the
// loader finds by a manifest (VK_DRIVER_FILES).
#define _GNU_SOURCE // for hooks.h, dl_iterate_phdr, memmem
#include <link.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/cli/drivers/fixed/planted.h"
#include "tests/cli/drivers/hooks.h"

static PFN_vkGetDeviceProcAddr real_vkGetDeviceProcAddr;
static PFN_vkCreateDevice real_vkCreateDevice;
static PFN_vkCreateSampler real_vkCreateSampler;
static PFN_vkCreateGraphicsPipelines real_vkCreateGraphicsPipelines;
static PFN_vkCreateRenderPass real_vkCreateRenderPass;
static PFN_vkCmdBeginRenderPass real_vkCmdBeginRenderPass;
static PFN_vkGetQueryPoolResults real_vkGetQueryPoolResults;

// --- samples: no API moves llvmpipe's, so the driver's own table of their places is edited ---

static void move_sample(char *table, size_t size)
{
    const float moved = 0.625f + 1.0f / 16;
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    char *start = table - (uintptr_t)table % page;
    const size_t span = (size_t)(table - start) + size;
    if (mprotect(start, span, PROT_READ | PROT_WRITE))
        return;
    memcpy(table + 6 * sizeof(float), &moved, sizeof(moved)); // x of the last
    mprotect(start, span, PROT_READ);
}

// In each place where lavapipe keeps read-only data.
static int move_in(struct dl_phdr_info *library, size_t size, void *user)
{
    static const float places[] = {0.375f, 0.125f, 0.875f, 0.375f, 0.125f, 0.625f, 0.625f, 0.875f};
    (void)size;
    (void)user;
    for (int i = 0; strstr(library->dlpi_name, "libvulkan_lvp") && i < library->dlpi_phnum; i++) {
        const ElfW(Phdr) *part = &library->dlpi_phdr[i];
        char *at = (char *)(uintptr_t)(library->dlpi_addr + part->p_vaddr);
        const char *end = at + part->p_filesz;
        if (part->p_type != PT_LOAD || part->p_flags != PF_R)
            continue;
        while ((at = memmem(at, (size_t)(end - at), places, sizeof(places)))) {
            move_sample(at, sizeof(places));
            at += sizeof(float);
        }
    }
    return 0;
}

static VkResult hooked_vkCreateDevice(VkPhysicalDevice p, const VkDeviceCreateInfo *info,
                                      const VkAllocationCallbacks *a, VkDevice *d)
{
    if (is_planted("one sample is 1/16 pixel off"))
        dl_iterate_phdr(move_in, NULL);
    return real_vkCreateDevice(p, info, a, d);
}

// --- samplers ---

static VkResult hooked_vkCreateSampler(VkDevice d, const VkSamplerCreateInfo *info,
                                       const VkAllocationCallbacks *a, VkSampler *s)
{
    VkSamplerCreateInfo changed = *info;
    if (is_planted("levels are not mixed"))
        changed.mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
    if (is_planted("anisotropy is 1"))
        changed.anisotropyEnable = VK_FALSE;
    if (is_planted("LODs are not clamped") && info->maxLod >= 1) {
        changed.minLod = 0;
        changed.maxLod = VK_LOD_CLAMP_NONE;
    }
    if (is_planted("LOD bias is 1/16 more"))
        changed.mipLodBias += 1.0f / 16;
    if (is_planted("the least LOD is 1/16 more") && info->minLod > 0)
        changed.minLod += 1.0f / 16;
    return real_vkCreateSampler(d, &changed, a, s);
}

// --- pipelines ---

struct parts {
    VkPipelineRasterizationStateCreateInfo rasterization;
    VkPipelineMultisampleStateCreateInfo multisample;
    VkPipelineViewportStateCreateInfo places;
    VkViewport viewports[8];
    VkRect2D scissors[8];
    VkPipelineColorBlendStateCreateInfo blend;
    VkPipelineColorBlendAttachmentState targets[8];
};

static void plant_rasterization(struct parts *parts)
{
    VkPipelineRasterizationStateCreateInfo *r = &parts->rasterization;
    if (is_planted("front faces are back faces"))
        r->frontFace = r->frontFace == VK_FRONT_FACE_CLOCKWISE ? VK_FRONT_FACE_COUNTER_CLOCKWISE
                                                               : VK_FRONT_FACE_CLOCKWISE;
    if (is_planted("depth is clamped and not clipped"))
        r->depthClampEnable = VK_TRUE;
    if (is_planted("alpha is no coverage"))
        parts->multisample.alphaToCoverageEnable = VK_FALSE;
}

static void plant_places(struct parts *parts, VkPrimitiveTopology topology)
{
    const bool is_thin =
        topology == VK_PRIMITIVE_TOPOLOGY_LINE_LIST || topology == VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
    if (is_thin && is_planted("lines and points are 1/256 pixel off"))
        parts->viewports[0].x += 1.0f / 256;
    for (uint32_t i = 0; i < parts->places.scissorCount && is_planted("scissors are ignored"); i++)
        parts->scissors[i] = (VkRect2D){{0, 0}, {64, 64}};
}

static VkBlendFactor without_second(VkBlendFactor factor)
{
    return factor == VK_BLEND_FACTOR_SRC1_COLOR             ? VK_BLEND_FACTOR_SRC_COLOR
           : factor == VK_BLEND_FACTOR_ONE_MINUS_SRC1_COLOR ? VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR
                                                            : factor;
}

static void plant_blend(struct parts *parts)
{
    const bool has_one = is_planted("the second colour is the first");
    const bool subtracts = is_planted("reversed subtraction is plain");
    for (uint32_t i = 0; i < parts->blend.attachmentCount; i++) {
        VkPipelineColorBlendAttachmentState *target = &parts->targets[i];
        if (has_one) {
            target->srcColorBlendFactor = without_second(target->srcColorBlendFactor);
            target->dstColorBlendFactor = without_second(target->dstColorBlendFactor);
        }
        if (subtracts && target->colorBlendOp == VK_BLEND_OP_REVERSE_SUBTRACT)
            target->colorBlendOp = target->alphaBlendOp = VK_BLEND_OP_SUBTRACT;
    }
}

static void copy_parts(const VkGraphicsPipelineCreateInfo *info, struct parts *parts)
{
    parts->rasterization = *info->pRasterizationState;
    parts->multisample = *info->pMultisampleState;
    parts->places = *info->pViewportState;
    parts->blend = *info->pColorBlendState;
    memcpy(parts->viewports, parts->places.pViewports,
           parts->places.viewportCount * sizeof(parts->viewports[0]));
    memcpy(parts->scissors, parts->places.pScissors,
           parts->places.scissorCount * sizeof(parts->scissors[0]));
    memcpy(parts->targets, parts->blend.pAttachments,
           parts->blend.attachmentCount * sizeof(parts->targets[0]));
    parts->places.pViewports = parts->viewports;
    parts->places.pScissors = parts->scissors;
    parts->blend.pAttachments = parts->targets;
}

// Draws of fixed functions make one pipeline at a time, with all state in it.
static VkResult hooked_vkCreateGraphicsPipelines(VkDevice d, VkPipelineCache c, uint32_t n,
                                                 const VkGraphicsPipelineCreateInfo *infos,
                                                 const VkAllocationCallbacks *a, VkPipeline *p)
{
    VkGraphicsPipelineCreateInfo changed = *infos;
    struct parts parts;
    if (n != 1 || infos->pDynamicState)
        return real_vkCreateGraphicsPipelines(d, c, n, infos, a, p);
    copy_parts(infos, &parts);
    plant_rasterization(&parts);
    plant_places(&parts, infos->pInputAssemblyState->topology);
    plant_blend(&parts);
    changed.pRasterizationState = &parts.rasterization;
    changed.pMultisampleState = &parts.multisample;
    changed.pViewportState = &parts.places;
    changed.pColorBlendState = &parts.blend;
    return real_vkCreateGraphicsPipelines(d, c, 1, &changed, a, p);
}

// --- targets ---

static VkFormat last_format; // of the last attachment of the render pass made last

static VkResult hooked_vkCreateRenderPass(VkDevice d, const VkRenderPassCreateInfo *info,
                                          const VkAllocationCallbacks *a, VkRenderPass *pass)
{
    if (info->attachmentCount)
        last_format = info->pAttachments[info->attachmentCount - 1].format;
    return real_vkCreateRenderPass(d, info, a, pass);
}

// The last clear value is that of depth.
static void hooked_vkCmdBeginRenderPass(VkCommandBuffer commands, const VkRenderPassBeginInfo *info,
                                        VkSubpassContents contents)
{
    VkClearValue values[8];
    VkRenderPassBeginInfo changed = *info;
    if (is_planted("depth is cleared one unit off") && info->clearValueCount <= 8) {
        memcpy(values, info->pClearValues, info->clearValueCount * sizeof(values[0]));
        values[info->clearValueCount - 1].depthStencil.depth =
            last_format == VK_FORMAT_D16_UNORM ? 65534.0f / 65535 : nextafterf(1, 0);
        changed.pClearValues = values;
    }
    real_vkCmdBeginRenderPass(commands, &changed, contents);
}

// --- queries ---

// Occlusion is asked for alone, statistics several at a time.
static VkResult hooked_vkGetQueryPoolResults(VkDevice d, VkQueryPool pool, uint32_t first,
                                             uint32_t count, size_t size, void *data,
                                             VkDeviceSize stride, VkQueryResultFlags flags)
{
    const VkResult result =
        real_vkGetQueryPoolResults(d, pool, first, count, size, data, stride, flags);
    if (size == sizeof(uint64_t) && is_planted("one sample too many is counted"))
        ++*(uint64_t *)data;
    return result;
}

// --- looking functions up ---

static PFN_vkVoidFunction hooked_vkGetDeviceProcAddr(VkDevice device, const char *name)
{
    return hook_of(name, real_vkGetDeviceProcAddr(device, name));
}

static any_function hook_of(const char *name, any_function real)
{
    static const struct hook hooks[] = {
        HOOK(vkGetDeviceProcAddr),       HOOK(vkCreateDevice),     HOOK(vkCreateSampler),
        HOOK(vkCreateGraphicsPipelines), HOOK(vkCreateRenderPass), HOOK(vkCmdBeginRenderPass),
        HOOK(vkGetQueryPoolResults),
    };
    return hook_among(hooks, sizeof(hooks) / sizeof(hooks[0]), name, real);
}
