// Draws of fixed functions by Vulkan, on a logical device of their own: it has the features that
// they need, and the device that is measured keeps its few.
#ifndef RG_BACKENDS_VULKAN_API_FIXED_FIXED_H
#define RG_BACKENDS_VULKAN_API_FIXED_FIXED_H

#include "backends/vulkan/vulkan.h"
#include "shaders/fixed/fixed.h"

// The logical device, with its functions of extensions; NULL stands for one that it lacks.
struct vk_fixed {
    struct vk_device own; // shares instance and physical device with the measured one
    VkPhysicalDeviceFeatures features;
    bool provokes_last;
    bool catches; // has transform feedback
    PFN_vkCmdBindTransformFeedbackBuffersEXT bind_feedback;
    PFN_vkCmdBeginTransformFeedbackEXT begin_feedback;
    PFN_vkCmdEndTransformFeedbackEXT end_feedback;
    VkCommandPool pool;
    VkCommandBuffer commands;
    VkFence fence;
};

enum vk_fixed_buffer {
    VK_FIXED_PARAMS,
    VK_FIXED_VERTICES,
    VK_FIXED_OFFSETS,
    VK_FIXED_FORMATS,
    VK_FIXED_INDICES,
    VK_FIXED_ARGUMENTS,
    VK_FIXED_COUNTS,
    VK_FIXED_FEEDBACK,
    VK_FIXED_TEXELS,
    VK_FIXED_RESULT, // what is read of images
    VK_FIXED_BUFFERS
};

struct vk_fixed_image {
    VkImage handle;
    struct vk_memory memory;
    VkImageView view;
    VkImageAspectFlags aspect;
    uint32_t layers;
};

// A draw and its objects; NULL stands for one that it does not need.
struct vk_fixed_job {
    struct vk_fixed *fixed;
    const struct rg_fixed_state *state;
    const char *feature;
    struct rg_fixed_picture *picture;
    struct rg_fixed_vertices vertices;
    struct vk_block buffers[VK_FIXED_BUFFERS];
    struct vk_fixed_image texture, stores[RG_FIXED_STORES];
    struct vk_fixed_image colours[RG_FIXED_EQUATIONS], depth;
    struct vk_fixed_image copy; // the resolved or smaller target
    VkSampler sampler;
    VkRenderPass render_pass;
    VkFramebuffer framebuffer;
    VkDescriptorSetLayout set_layout;
    VkDescriptorPool set_pool;
    VkDescriptorSet set;
    VkPipelineLayout layout;
    VkShaderModule modules[RG_FIXED_STAGES];
    VkPipeline pipeline;
    VkQueryPool occlusion, statistics;
    VkDeviceSize result_used;
};

// vk_fixed_try(job, vkDoIt, arguments...) calls a function and checks its result.
#define vk_fixed_try(job, function, ...) vk_try("feature", (job)->feature, function, __VA_ARGS__)

// device.c: NULL, and one logged line, on failure.
struct vk_fixed *vk_fixed_open(struct vk_device *device);
// What the device lacks for a draw; NULL: nothing.
const char *vk_fixed_lacked(const struct vk_fixed *fixed, const struct rg_fixed_state *state);

// image.c: functions that return bool log one line where they fail.
VkFormat vk_fixed_colour(int format);
VkFormat vk_fixed_depth(int depth);
VkFormat vk_fixed_store(int store);
VkFormat vk_fixed_texels(int texels);
bool vk_fixed_image(struct vk_fixed_job *job, const VkImageCreateInfo *info, VkImageViewType type,
                    struct vk_fixed_image *image);
void vk_fixed_image_destroy(struct vk_fixed_job *job, struct vk_fixed_image *image);
// Everything before a change of layout happens before everything after it.
void vk_fixed_turn(VkCommandBuffer commands, const struct vk_fixed_image *image, VkImageLayout from,
                   VkImageLayout to);
void vk_fixed_barrier(VkCommandBuffer commands);

// texture.c: makes the texture and its sampler; records the copy of its texels.
bool vk_fixed_texture(struct vk_fixed_job *job);
void vk_fixed_upload(struct vk_fixed_job *job);

// target.c: makes the images that are drawn to, the render pass and the framebuffer.
bool vk_fixed_targets(struct vk_fixed_job *job);

// pipeline.c
bool vk_fixed_pipeline(struct vk_fixed_job *job);
// slots.c: the layout of the descriptor set, and the set.
bool vk_fixed_slots(struct vk_fixed_job *job);

VkCompareOp vk_fixed_compare(int compare);

// record.c: draws, waits, and adds all that the draw left to its picture.
bool vk_fixed_run(struct vk_fixed_job *job);

#endif
