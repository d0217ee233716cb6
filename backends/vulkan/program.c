// A pass's shaders, and the pipeline of a GRID kernel.
#include "backends/vulkan/vulkan.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

static bool create_module(struct vk_device *device, const struct rg_kernel *kernel,
                          enum rg_code_kind kind, unsigned ways, VkShaderModule *module)
{
    struct rg_kernel_code code;
    if (!rg_kernel_code(kernel, kind, ways, &code))
        return false;
    const uint32_t spirv_magic = 0x07230203, header_bytes = 20;
    bool ok = code.size >= header_bytes && code.size % 4 == 0 &&
              !memcmp(code.bytes, &spirv_magic, sizeof(spirv_magic));
    if (!ok)
        rg_error("kernel '%s': its %zu bytes are no SPIR-V; build it with glslc", kernel->name,
                 code.size);
    const VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .codeSize = code.size,
        .pCode = (const uint32_t *)(const void *)code.bytes,
    };
    ok = ok &&
         vk_try("kernel", kernel->name, vkCreateShaderModule, device->handle, &info, NULL, module);
    free(code.bytes);
    return ok;
}

const VkSpecializationInfo *vk_constants(const struct vk_device *device)
{
    enum { COUNT = 2, SIZE = sizeof(VkBool32), ALL = COUNT * SIZE };
    static const VkSpecializationMapEntry entries[COUNT] = {{0, 0, SIZE}, {1, SIZE, SIZE}};
    static const VkBool32 values[][COUNT] = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
    static const VkSpecializationInfo infos[] = {{COUNT, entries, ALL, values[0]},
                                                 {COUNT, entries, ALL, values[1]},
                                                 {COUNT, entries, ALL, values[2]},
                                                 {COUNT, entries, ALL, values[3]}};
    const bool interpolates = device->pub.info.features & RG_FEATURE_PLACES;
    return device->pub.info.native ? &infos[2 * vk_filters_depth(device) + interpolates] : NULL;
}

static bool create_pipeline(struct vk_device *device, const struct rg_kernel *kernel,
                            struct vk_pass *pass)
{
    VkShaderModule module;
    if (!create_module(device, kernel, RG_CODE_SPIRV, rg_device_ways(&device->pub, kernel),
                       &module))
        return false;
    const VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module,
                  .pName = "main",
                  .pSpecializationInfo = vk_constants(device)},
        .layout = pass->layout,
    };
    bool ok = vk_try("kernel", kernel->name, vkCreateComputePipelines, device->handle, pass->cache,
                     1, &info, NULL, &pass->pipeline);
    vkDestroyShaderModule(device->handle, module, NULL);
    if (ok)
        vk_name(device, VK_OBJECT_TYPE_PIPELINE, VK_HANDLE(pass->pipeline), kernel->name);
    return ok;
}

static bool create_shaders(struct vk_device *device, const struct rg_kernel *kernel, unsigned ways,
                           struct vk_shaders *shaders)
{
    return create_module(device, kernel, RG_CODE_VERTEX_SPIRV, ways, &shaders->vertex) &&
           (!(ways & RG_CODE_SETUP) || create_module(device, kernel, RG_CODE_NATIVE_GEOMETRY_SPIRV,
                                                     ways, &shaders->geometry)) &&
           create_module(device, kernel, RG_CODE_FRAGMENT_SPIRV, ways, &shaders->fragment);
}

// The ways of draws that blend.
static unsigned ways_of_blending(const struct vk_device *device, const struct rg_kernel *kernel)
{
    const struct rg_draw blending = {.blend = RG_BLEND_OVER};
    const unsigned features = rg_run_features(&device->pub, &blending);
    return rg_ways_of(&device->pub, kernel, features) | (device->pub.blends ? RG_CODE_BLENDS : 0);
}

static bool create_drawing(struct vk_device *device, const struct rg_kernel *kernel,
                           struct vk_pass *pass)
{
    struct vk_drawing *drawing = pass->drawing = rg_alloc(1, sizeof(*drawing), kernel->name);
    const unsigned own = rg_device_ways(&device->pub, kernel);
    const unsigned blending = ways_of_blending(device, kernel);
    return drawing && create_shaders(device, kernel, own, &drawing->shaders[0]) &&
           (blending == own || !kernel->draw || // texels never blend
            create_shaders(device, kernel, blending, &drawing->shaders[1]));
}

bool vk_program_create(struct vk_device *device, const struct rg_kernel *kernel,
                       struct vk_pass *pass)
{
    static const VkPipelineCacheCreateInfo empty = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    if (!vk_try("kernel", kernel->name, vkCreatePipelineCache, device->handle, &empty, NULL,
                &pass->cache))
        return false;
    return rg_is_drawn(&device->pub, kernel) ? create_drawing(device, kernel, pass)
                                             : create_pipeline(device, kernel, pass);
}

static void destroy_drawing(struct vk_device *device, struct vk_drawing *drawing)
{
    const int count = sizeof(drawing->pipelines) / sizeof(VkPipeline);
    for (int i = 0; i < count; i++)
        vkDestroyPipeline(device->handle, (&drawing->pipelines[0][0][0][0])[i], NULL);
    for (int i = 0; i < 2; i++) {
        vkDestroyShaderModule(device->handle, drawing->shaders[i].fragment, NULL);
        vkDestroyShaderModule(device->handle, drawing->shaders[i].geometry, NULL);
        vkDestroyShaderModule(device->handle, drawing->shaders[i].vertex, NULL);
    }
    free(drawing);
}

void vk_program_destroy(struct vk_device *device, struct vk_pass *pass)
{
    vkDestroyPipeline(device->handle, pass->pipeline, NULL);
    vkDestroyPipelineCache(device->handle, pass->cache, NULL);
    if (pass->drawing)
        destroy_drawing(device, pass->drawing);
}
