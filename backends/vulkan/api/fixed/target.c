// The images that draws go to, the render pass and the framebuffer.
#include "backends/vulkan/api/fixed/fixed.h"

enum { MAX_ATTACHMENTS = RG_FIXED_EQUATIONS + 2 }; // resolved, and depth

static bool make(struct vk_fixed_job *job, VkFormat format, uint32_t px, VkImageUsageFlags usage,
                 bool is_sampled, struct vk_fixed_image *image)
{
    const int layers = job->state->layers;
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = format,
        .extent = {px, px, 1},
        .mipLevels = 1,
        .arrayLayers = layers ? (uint32_t)layers : 1,
        .samples = is_sampled ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT,
        .usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
    };
    return vk_fixed_image(job, &info, layers ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D,
                          image);
}

static bool make_images(struct vk_fixed_job *job)
{
    const struct rg_fixed_state *state = job->state;
    const VkFormat format = vk_fixed_colour(state->format);
    bool ok = true;
    for (int i = 0; ok && i <= state->more_targets; i++)
        ok = make(job, format, RG_FIXED_PX, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, state->samples,
                  &job->colours[i]);
    if (ok && state->depth)
        ok = make(job, vk_fixed_depth(state->depth), RG_FIXED_PX,
                  VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, state->samples, &job->depth);
    if (ok && (state->samples || state->blit))
        ok = make(job, format, state->blit ? RG_FIXED_BLIT_PX : RG_FIXED_PX,
                  VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, false,
                  &job->copy);
    for (int i = 0; ok && state->stores && i < RG_FIXED_STORES; i++)
        ok = make(job, vk_fixed_store(i), RG_FIXED_PX,
                  VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, false,
                  &job->stores[i]);
    return ok;
}

static VkAttachmentDescription attachment(const struct vk_fixed_job *job, VkFormat format,
                                          bool is_sampled)
{
    return (VkAttachmentDescription){
        .format = format,
        .samples =
            is_sampled && job->state->samples ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT,
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
        .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .stencilStoreOp = VK_ATTACHMENT_STORE_OP_STORE,
        .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
        .finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
    };
}

// Attachments in this order: colours, the resolved one, depth.
static bool make_render_pass(struct vk_fixed_job *job)
{
    const struct rg_fixed_state *state = job->state;
    const VkFormat format = vk_fixed_colour(state->format);
    VkAttachmentDescription attachments[MAX_ATTACHMENTS];
    VkAttachmentReference colours[RG_FIXED_EQUATIONS], resolved, depth;
    uint32_t count = 0;
    for (int i = 0; i <= state->more_targets; i++) {
        colours[i] = (VkAttachmentReference){count, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        attachments[count++] = attachment(job, format, true);
    }
    resolved = (VkAttachmentReference){count, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    if (state->samples)
        attachments[count++] = attachment(job, format, false);
    depth = (VkAttachmentReference){count, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    if (state->depth)
        attachments[count++] = attachment(job, vk_fixed_depth(state->depth), true);
    const VkSubpassDescription subpass = {
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
        .colorAttachmentCount = 1 + (uint32_t)state->more_targets,
        .pColorAttachments = colours,
        .pResolveAttachments = state->samples ? &resolved : NULL,
        .pDepthStencilAttachment = state->depth ? &depth : NULL,
    };
    const VkRenderPassCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
        .attachmentCount = count,
        .pAttachments = attachments,
        .subpassCount = 1,
        .pSubpasses = &subpass,
    };
    return vk_fixed_try(job, vkCreateRenderPass, job->fixed->own.handle, &info, NULL,
                        &job->render_pass);
}

static bool make_framebuffer(struct vk_fixed_job *job)
{
    const struct rg_fixed_state *state = job->state;
    VkImageView views[MAX_ATTACHMENTS];
    uint32_t count = 0;
    for (int i = 0; i <= state->more_targets; i++)
        views[count++] = job->colours[i].view;
    if (state->samples)
        views[count++] = job->copy.view;
    if (state->depth)
        views[count++] = job->depth.view;
    const VkFramebufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
        .renderPass = job->render_pass,
        .attachmentCount = count,
        .pAttachments = views,
        .width = RG_FIXED_PX,
        .height = RG_FIXED_PX,
        .layers = state->layers ? (uint32_t)state->layers : 1,
    };
    return vk_fixed_try(job, vkCreateFramebuffer, job->fixed->own.handle, &info, NULL,
                        &job->framebuffer);
}

bool vk_fixed_targets(struct vk_fixed_job *job)
{
    return make_images(job) && make_render_pass(job) && make_framebuffer(job);
}
