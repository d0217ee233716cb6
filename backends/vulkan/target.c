// Draw targets: views of one layer of one level, render passes and framebuffers, made on first use
// and kept until their images are destroyed.
#include "backends/vulkan/vulkan.h"

#include <stdlib.h>

#include "backends/formats.h"
#include "core/base/alloc.h"

struct vk_framebuffer {
    struct vk_framebuffer *next;
    const struct rg_image *colour, *depth; // as in the draw
    int layer, level;
    struct vk_target target;
    VkFramebuffer handle;
};

struct vk_target vk_target_of(const struct vk_device *device, const struct rg_draw *draw)
{
    return (struct vk_target){
        .colour = draw->colour ? draw->colour->desc.format : RG_FORMAT_NONE,
        .blends = device->pub.blends && draw->colour && draw->blend != RG_BLEND_OFF,
        // If samples are counted, the fragment shader tests the depth, so that it is no attachment.
        .depth = draw->depth_mode != RG_DEPTH_OFF && !rg_draw_counts(draw),
    };
}

VkImageView vk_place(struct vk_device *device, struct rg_image *image, int layer, int level)
{
    struct vk_image *vk = (struct vk_image *)image;
    const struct rg_image_desc *desc = &image->desc;
    if (!vk->places)
        vk->places =
            rg_alloc((size_t)desc->layers * (size_t)desc->levels, sizeof(*vk->places), image->name);
    if (!vk->places)
        return VK_NULL_HANDLE;
    VkImageView *place = &vk->places[layer * desc->levels + level];
    const VkImageViewCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = vk->handle,
        .viewType = VK_IMAGE_VIEW_TYPE_2D_ARRAY,
        .format = vk_format(desc->format),
        .subresourceRange = {vk_aspect(desc->format), (uint32_t)level, 1, (uint32_t)layer, 1},
    };
    if (!*place &&
        !vk_try("image", image->name, vkCreateImageView, device->handle, &info, NULL, place))
        *place = VK_NULL_HANDLE;
    return *place;
}

static VkAttachmentDescription attachment(enum rg_format format)
{
    return (VkAttachmentDescription){
        .format = vk_format(format),
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
        .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
        .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
        .initialLayout = VK_IMAGE_LAYOUT_GENERAL,
        .finalLayout = VK_IMAGE_LAYOUT_GENERAL,
    };
}

VkRenderPass vk_render_pass(struct vk_device *device, struct vk_target target, const char *name)
{
    VkRenderPass *kept = &device->render_passes[target.colour][target.depth][target.blends];
    if (*kept)
        return *kept;
    VkAttachmentDescription attachments[2];
    VkAttachmentReference references[2] = {{VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_GENERAL},
                                           {VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_GENERAL}};
    uint32_t count = 0;
    if (target.colour != RG_FORMAT_NONE) {
        references[0].attachment = count;
        attachments[count++] = attachment(target.colour);
    }
    if (target.depth) {
        references[1].attachment = count;
        attachments[count++] = attachment(RG_D32F);
    }
    const VkSubpassDependency order = {
        .srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
        .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_INPUT_ATTACHMENT_READ_BIT,
        .dependencyFlags = VK_DEPENDENCY_BY_REGION_BIT,
    };
    const VkSubpassDescription subpass = {
        .flags = target.blends
                     ? VK_SUBPASS_DESCRIPTION_RASTERIZATION_ORDER_ATTACHMENT_COLOR_ACCESS_BIT_EXT
                     : 0,
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
        .inputAttachmentCount = target.blends,
        .pInputAttachments = &references[0],
        .colorAttachmentCount = 1,
        .pColorAttachments = &references[0],
        .pDepthStencilAttachment = &references[1],
    };
    const VkRenderPassCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
        .attachmentCount = count,
        .pAttachments = attachments,
        .subpassCount = 1,
        .pSubpasses = &subpass,
        .dependencyCount = target.blends,
        .pDependencies = &order,
    };
    if (!vk_try("kernel", name, vkCreateRenderPass, device->handle, &info, NULL, kept))
        *kept = VK_NULL_HANDLE;
    return *kept;
}

static bool create_framebuffer(struct vk_device *device, const struct rg_draw *draw,
                               struct vk_framebuffer *framebuffer)
{
    const struct vk_target target = framebuffer->target;
    struct rg_image *sized = draw->colour ? draw->colour : draw->depth;
    VkImageView views[2];
    uint32_t count = 0;
    if (target.colour != RG_FORMAT_NONE)
        views[count++] = vk_place(device, draw->colour, draw->layer, draw->level);
    if (target.depth)
        views[count++] = vk_place(device, draw->depth, draw->layer, draw->level);
    const VkFramebufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
        .renderPass = vk_render_pass(device, target, sized->name),
        .attachmentCount = count,
        .pAttachments = views,
        .width = (uint32_t)rg_level_size(sized->desc.width, draw->level),
        .height = (uint32_t)rg_level_size(sized->desc.height, draw->level),
        .layers = 1,
    };
    for (uint32_t i = 0; i < count; i++)
        if (!views[i])
            return false;
    return info.renderPass && vk_try("image", sized->name, vkCreateFramebuffer, device->handle,
                                     &info, NULL, &framebuffer->handle);
}

static bool is_of(const struct vk_device *device, const struct vk_framebuffer *framebuffer,
                  const struct rg_draw *draw)
{
    const struct vk_target target = vk_target_of(device, draw);
    return framebuffer->colour == draw->colour && framebuffer->depth == draw->depth &&
           framebuffer->layer == draw->layer && framebuffer->level == draw->level &&
           framebuffer->target.colour == target.colour &&
           framebuffer->target.depth == target.depth && framebuffer->target.blends == target.blends;
}

VkFramebuffer vk_framebuffer(struct vk_device *device, const struct rg_draw *draw)
{
    for (struct vk_framebuffer *kept = device->framebuffers; kept; kept = kept->next)
        if (is_of(device, kept, draw))
            return kept->handle;
    struct vk_framebuffer *made = rg_alloc(1, sizeof(*made), "framebuffer");
    if (!made)
        return VK_NULL_HANDLE;
    *made = (struct vk_framebuffer){device->framebuffers, draw->colour, draw->depth,
                                    draw->layer,          draw->level,  vk_target_of(device, draw),
                                    VK_NULL_HANDLE};
    if (!create_framebuffer(device, draw, made)) {
        free(made);
        return VK_NULL_HANDLE;
    }
    device->framebuffers = made;
    return made->handle;
}

void vk_target_forget(struct vk_device *device, struct vk_image *image)
{
    for (struct vk_framebuffer **at = &device->framebuffers; *at;) {
        struct vk_framebuffer *framebuffer = *at;
        if (framebuffer->colour != &image->pub && framebuffer->depth != &image->pub) {
            at = &framebuffer->next;
            continue;
        }
        *at = framebuffer->next;
        vkDestroyFramebuffer(device->handle, framebuffer->handle, NULL);
        free(framebuffer);
    }
    const int places = image->places ? image->pub.desc.layers * image->pub.desc.levels : 0;
    for (int i = 0; i < places; i++)
        vkDestroyImageView(device->handle, image->places[i], NULL);
    free(image->places);
    image->places = NULL;
}

// Framebuffers are gone already, destroyed with their images.
void vk_targets_close(struct vk_device *device)
{
    for (int colour = 0; colour < VK_COLOURS; colour++)
        for (int depth = 0; depth < VK_DEPTHS; depth++)
            for (int blends = 0; blends < VK_BLENDS; blends++)
                vkDestroyRenderPass(device->handle, device->render_passes[colour][depth][blends],
                                    NULL);
}
