// The vulkan backend: Vulkan 1.2 through the loader, without a window.
//
// Commands are recorded into batches, which are submitted when full or when somebody waits, so that
// the driver runs one while the next is recorded. A batch owns the descriptor sets, parameters and
// staging memory that its commands use, and they are reused with it.
#ifndef RG_BACKENDS_VULKAN_VULKAN_H
#define RG_BACKENDS_VULKAN_VULKAN_H

#include <vulkan/vulkan.h>

#include "backends/backend.h"
#include "backends/manifests.h"

#define VK_PACKAGE "mesa-vulkan-drivers" // the Debian package with a driver

enum {
    VK_BATCHES = 3,
    VK_BATCH_RUNS = 64,                      // pass runs in a batch
    VK_BATCH_DESCRIPTORS = 512,              // of each type
    VK_OWN_ALLOCATIONS = 2 * VK_BATCHES + 2, // parameters, staging, and objects for unused slots
    VK_PARAMS_BYTES = 128 * 1024,
    VK_MIN_STAGING_BYTES = 256 * 1024,
    VK_MAX_STAGING_BYTES = 16 * 1024 * 1024, // larger transfers are split
};

struct vk_memory {
    VkDeviceMemory handle;
    void *mapped; // NULL: the host cannot map it
};

// A VkBuffer with memory of its own.
struct vk_block {
    VkBuffer buffer;
    struct vk_memory memory;
    VkDeviceSize size;
};

struct vk_batch {
    VkCommandPool pool;
    VkCommandBuffer commands;
    VkFence fence;
    VkDescriptorPool descriptor_pool;
    struct vk_block params, staging;
    VkDeviceSize params_used, staging_used;
    int runs, descriptors;
    bool recording, in_flight;
};

// What an instance is opened with: nothing more, VK_EXT_debug_utils, or the validation layer too.
enum vk_debug { VK_UNNAMED, VK_NAMED, VK_VALIDATED };

// An instance, and the validation layer's complaints about our calls if RG_VK_VALIDATION=1.
struct vk_instance {
    VkInstance handle;
    VkDebugUtilsMessengerEXT messenger;
    VkResult result;                 // of creating the instance, then of listing its devices
    int complaints, complaints_told; // its errors, and those that made a call of ours return false
};

// A queue family to work on.
struct vk_family {
    uint32_t index;
    uint32_t timestamp_bits; // number of valid bits; 0: no timestamps
    bool draws;
};

// The key of a render pass: enum rg_format of the colour or RG_FORMAT_NONE, whether depth is
// attached, and whether programs blend by themselves.
enum { VK_COLOURS = RG_R32F + 1, VK_DEPTHS = 2, VK_BLENDS = 2 };

struct vk_framebuffer;
struct vk_fixed; // backends/vulkan/api/fixed/fixed.h

struct vk_device {
    struct rg_device pub;
    struct vk_instance instance;
    VkPhysicalDevice physical;
    VkPhysicalDeviceLimits limits;
    VkPhysicalDeviceMemoryProperties memory;
    VkDeviceSize max_allocation_bytes;
    bool ordered; // fragments can read what their pixel holds, in the order of items
    VkDescriptorSetLayout before; // layout of the set with that, if programs blend; made on first
                                  // use
    bool direct;                  // the host reads and writes device memory at full speed
    VkDevice handle;
    VkQueue queue;
    struct vk_family family;
    VkSampler samplers[RG_SAMPLERS];
    VkQueryPool timestamp;
    VkQueryPool occlusion; // RG_MAX_QUERIES; made by the first draw with queries
    uint64_t ticks_mask;   // the valid bits of a timestamp; 0: no timestamps
    uint64_t ticks_last, ticks_total;
    struct vk_batch batches[VK_BATCHES];
    int current;
    uint64_t serial;  // of the batch being recorded, unique
    VkPipeline bound; // of compute
    VkRenderPass render_passes[VK_COLOURS][VK_DEPTHS][VK_BLENDS]; // made on first use
    struct vk_framebuffer *framebuffers;                          // likewise; a list
    struct rg_buf *no_samples; // bound by draws that count nothing; made with the first DRAW pass
    struct rg_image *no_depth;
    struct vk_fixed *fixed; // made by the first draw of a fixed function
    // All NULL unless the validation layer or RG_LABELS=1 is asked for.
    PFN_vkSetDebugUtilsObjectNameEXT set_name;
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_group;
    PFN_vkCmdEndDebugUtilsLabelEXT end_group;
};

struct vk_buf {
    struct rg_buf pub;
    struct vk_block block;
};

struct vk_image {
    struct rg_image pub;
    VkImage handle;
    struct vk_memory memory;
    VkImageView sampled; // every level
    VkImageView stored;  // level 0; none for a format without storage
    VkImageView cube;    // every level of six layers, on native devices; else none
    VkImageView *places; // of one layer of one level each, made on first use; NULL: none yet
};

union vk_descriptor {
    VkDescriptorBufferInfo buffer;
    VkDescriptorImageInfo image;
};

struct vk_shaders {
    VkShaderModule vertex, fragment;
    VkShaderModule geometry; // if the driver sets up items; else none
};

// The additional parts of a pass that is drawn: its shaders, and a pipeline for each draw state,
// made on first use.
struct vk_drawing {
    struct vk_shaders shaders[2]; // of all draws; and of draws that blend, if those are others
    VkPipeline pipelines[VK_COLOURS][RG_BLEND_ADD + 1][RG_DEPTH_WRITE + 1][RG_CULL_FRONT + 1];
};

struct vk_pass {
    struct rg_pass pub;
    struct rg_slot_info slots[RG_MAX_SLOTS]; // the kernel's, then those of the drawing stages
    int slot_count;
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkDescriptorUpdateTemplate update; // from union vk_descriptor[RG_MAX_SLOTS]
    VkPipelineCache cache;             // of its pipelines, for vk_pass_code
    VkPipeline pipeline;               // of a kernel that is dispatched
    struct vk_drawing *drawing;        // of one that is drawn
    size_t params_bytes;
    VkDeviceSize run_bytes; // of the uniform block
    // The last set, valid for another run in the same batch with the same objects.
    VkDescriptorSet set;
    uint64_t set_serial;
    union vk_descriptor bound[RG_MAX_SLOTS];
};

// api/instance.c
// Opens an instance, with what `debug` says. `why` receives one line on failure.
bool vk_instance_open(struct vk_instance *instance, enum vk_debug debug, char *why,
                      size_t why_size);
void vk_instance_close(struct vk_instance *instance);
// backend->functions
int vk_functions(struct rg_device *device, const void **functions, int max);
// The usable devices (Vulkan 1.2, a compute queue), hardware first; returns their number, with the
// reason in `why` when it is 0.
int vk_physical_devices(struct vk_instance *instance, VkPhysicalDevice *devices, int max, char *why,
                        size_t why_size);
// api/drivers.c: the places where the loader finds drivers, and the result of backend->list for
// `count` devices found.
extern const struct rg_manifest_rules vk_manifests;
int vk_judge(const struct vk_instance *instance, int count, char *why, size_t why_size);
// The first family that computes and draws, else the first that computes. False: there is none.
bool vk_queue_family(VkPhysicalDevice device, struct vk_family *family);
// False, with the reason in `why`, if the driver cannot describe its image formats.
bool vk_describe(VkPhysicalDevice device, int index, struct rg_device_info *info, char *why,
                 size_t why_size);

// api/limits.c
struct rg_limits vk_limits(VkPhysicalDevice device, const struct vk_family *family,
                           const VkPhysicalDeviceLimits *limits, uint64_t max_allocation_bytes,
                           VkResult *result);
// Whether the driver offers an extension. False, with an error logged, if it cannot tell.
bool vk_find_extension(const struct vk_device *device, const char *name, bool *is_there);

// api/error.c
const char *vk_result_name(VkResult result);
// Whether `result` is a success; if not, logs "noun 'name': call failed with ...".
bool vk_check(VkResult result, const char *call, const char *noun, const char *name);
// The same for the last call before a device closes. The loss of a device is logged once.
bool vk_close_check(VkResult result, const char *call, const char *name);
// vk_try(noun, name, vkDoIt, arguments...) calls a Vulkan function and checks its result.
#define vk_try(noun, name, function, ...) vk_check(function(__VA_ARGS__), #function, noun, name)
// False if the validation layer has complained since the last call.
bool vk_healthy(struct vk_device *device);
// Gives an object its name in the validation layer and in debuggers.
void vk_name(struct vk_device *device, VkObjectType type, uint64_t handle, const char *name);
// Names the commands between the two there.
void vk_group_begin(const struct vk_device *device, VkCommandBuffer commands, const char *name);
void vk_group_end(const struct vk_device *device, VkCommandBuffer commands);
#define VK_HANDLE(handle) ((uint64_t)(uintptr_t)(handle))

// api/memory.c
enum vk_memory_use { VK_USE_DEVICE, VK_USE_HOST };
bool vk_memory_create(struct vk_device *device, const VkMemoryRequirements *needs,
                      enum vk_memory_use use, const char *noun, const char *name,
                      struct vk_memory *memory);
void vk_memory_destroy(struct vk_device *device, struct vk_memory *memory);
bool vk_block_create(struct vk_device *device, VkDeviceSize size, VkBufferUsageFlags usage,
                     enum vk_memory_use use, const char *name, struct vk_block *block);
void vk_block_destroy(struct vk_device *device, struct vk_block *block);
// Whether VK_USE_DEVICE memory is mapped and fast for the host to read.
bool vk_memory_is_direct(const VkPhysicalDeviceMemoryProperties *memory);

// api/sampler.c
bool vk_samplers_create(struct vk_device *device);
void vk_samplers_destroy(struct vk_device *device);
// Whether samplers that compare weigh four answers.
bool vk_filters_depth(const struct vk_device *device);

// api/batch.c
bool vk_batches_create(struct vk_device *device);
void vk_batches_destroy(struct vk_device *device);
// The batch to record into, begun if necessary; NULL when the driver failed.
struct vk_batch *vk_record(struct vk_device *device);
// As vk_record, with `size` bytes (at most VK_MAX_STAGING_BYTES) of staging memory, mapped at
// `memory`, that begin at `offset` in batch->staging.
struct vk_batch *vk_record_staged(struct vk_device *device, size_t size, VkDeviceSize *offset,
                                  void **memory);
// Submits the commands without waiting.
bool vk_submit(struct vk_device *device);
// Submits the commands and waits until all have ended.
bool vk_wait(struct vk_device *device);
bool vk_is_idle(const struct vk_device *device);
// Makes earlier writes visible to later commands other than draws.
void vk_barrier(const struct vk_batch *batch);
// The same for a draw: earlier writes to the draw, and the draw's writes to later commands.
void vk_barrier_before_draw(const struct vk_device *device, const struct vk_batch *batch);
void vk_barrier_after_draw(const struct vk_device *device, const struct vk_batch *batch);

// buf.c
struct rg_buf *vk_buf_create(struct rg_device *device, size_t size, const char *name);
void vk_buf_destroy(struct rg_buf *buf);
bool vk_buf_write(struct rg_buf *buf, size_t offset, const void *data, size_t size);
bool vk_buf_read(struct rg_buf *buf, size_t offset, void *data, size_t size);

// formats.c
VkFormat vk_format(enum rg_format format);
// The usages of images of a format, from bits of enum rg_format_use.
VkImageUsageFlags vk_usage(enum rg_format format, unsigned uses);
// The additional usage if programs blend by themselves; 0 if the driver blends.
VkImageUsageFlags vk_input_usage(const struct vk_device *device, enum rg_format format);
VkImageAspectFlags vk_aspect(enum rg_format format);

// image.c
struct rg_image *vk_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                 const char *name);
void vk_image_destroy(struct rg_image *image);

// api/texels.c
bool vk_image_write(struct rg_image *image, int layer, int level, const void *texels);
bool vk_image_read(struct rg_image *image, int layer, int level, void *texels);
bool vk_image_clear(struct rg_image *image, const void *texel);
bool vk_image_make_levels(struct rg_image *image, int first);

// slots.c
// Creates the layouts of pass->slots.
bool vk_slots_create(struct vk_device *device, struct vk_pass *pass,
                     const struct rg_kernel *kernel);
void vk_slots_destroy(struct vk_device *device, struct vk_pass *pass);
// Fills in the kernel's own slots; the other descriptors are zero.
void vk_slots_fill(const struct vk_device *device, const struct rg_kernel *kernel,
                   const struct rg_run *run, union vk_descriptor descriptors[RG_MAX_SLOTS]);
void vk_slot_buffer(union vk_descriptor *descriptor, const struct rg_buf *buf);
void vk_slot_image(union vk_descriptor *descriptor, const struct vk_device *device,
                   enum rg_sampler sampling, VkImageView view);
// Makes a set with the target's colour, for a draw that blends by itself.
bool vk_slot_before(struct vk_device *device, const struct vk_batch *batch,
                    const struct vk_pass *pass, const struct rg_draw *draw, VkDescriptorSet *set);
// Makes pass->set a set with these descriptors.
bool vk_slots_bind(struct vk_device *device, struct vk_batch *batch, struct vk_pass *pass,
                   union vk_descriptor descriptors[RG_MAX_SLOTS]);

// target.c
// The kind of a run's target: colour, or RG_FORMAT_NONE, and whether depth is attached.
struct vk_target {
    enum rg_format colour;
    bool depth;
    bool blends; // the program does, and reads the colour
};
struct vk_target vk_target_of(const struct vk_device *device, const struct rg_draw *draw);
// A view of one layer of one level, which the image owns; VK_NULL_HANDLE if the driver failed.
VkImageView vk_place(struct vk_device *device, struct rg_image *image, int layer, int level);
// The device owns both; VK_NULL_HANDLE if the driver failed.
VkRenderPass vk_render_pass(struct vk_device *device, struct vk_target target, const char *name);
VkFramebuffer vk_framebuffer(struct vk_device *device, const struct rg_draw *draw);
// Destroys the views and framebuffers of an image.
void vk_target_forget(struct vk_device *device, struct vk_image *image);
void vk_targets_close(struct vk_device *device);

// program.c
// What a shader's constants are on this device: whether its samplers filter depths, and whether it
// interpolates places (kernels/build/flatten.py). Only shaders of native devices have any.
const VkSpecializationInfo *vk_constants(const struct vk_device *device);
// Compiles a pass's shaders: false, and one logged line, on failure. Destroying also accepts a
// partly made pass.
bool vk_program_create(struct vk_device *device, const struct rg_kernel *kernel,
                       struct vk_pass *pass);
void vk_program_destroy(struct vk_device *device, struct vk_pass *pass);

// api/pipeline.c
// The pipeline of a program's draw state, owned by the pass; VK_NULL_HANDLE where the driver
// failed.
VkPipeline vk_pipeline_of(struct vk_device *device, struct vk_pass *pass,
                          const struct rg_draw *draw);

// draw.c
// Adds the slots of the drawing stages to pass->slots.
void vk_draw_slots(struct vk_pass *pass);
// backend->can_blend
bool vk_can_blend(const struct rg_device *device, const char **word);
// Makes the buffer for draws that count nothing, because a shader's slots must all be bound. False:
// the driver failed.
bool vk_draw_prepare(struct vk_device *device);
// Fills in the drawing stages' slots. False: the driver failed.
bool vk_draw_fill(struct vk_device *device, const struct rg_run *run,
                  union vk_descriptor descriptors[RG_MAX_SLOTS]);
// Records the draw, with pass->set.
bool vk_draw(struct vk_device *device, const struct vk_batch *batch, struct vk_pass *pass,
             const struct rg_run *run, uint32_t params_offset);
void vk_draw_close(struct vk_device *device); // frees what passes share, before the device closes

// api/query.c
// Resets this many occlusion queries; 0: none. False: the driver failed.
bool vk_queries_prepare(struct vk_device *device, const struct vk_batch *batch, int count);
// Records the draws of a render pass, each in its query, and then the copy of their results.
void vk_draw_queries(const struct vk_device *device, const struct vk_batch *batch,
                     const struct rg_run *run);
void vk_answer_queries(const struct vk_device *device, const struct vk_batch *batch,
                       const struct rg_run *run);
void vk_queries_close(struct vk_device *device);

// pass.c
struct rg_pass *vk_pass_create(struct rg_device *device, const struct rg_kernel *kernel);
void vk_pass_destroy(struct rg_pass *pass);
bool vk_pass_code(struct rg_pass *pass, void **bytes, size_t *size);
bool vk_pass_run(struct rg_pass *pass, const struct rg_run *run);

// api/fixed/fixed.c: backend->fixed_draw, and the end of what it made.
bool vk_fixed_draw(struct rg_device *device, const char *feature,
                   const struct rg_fixed_state *state, struct rg_fixed_picture *picture);
void vk_fixed_close(struct vk_device *device);

// time.c
bool vk_sync(struct rg_device *device);
bool vk_time(struct rg_device *device, int64_t *time_ns);

#endif
