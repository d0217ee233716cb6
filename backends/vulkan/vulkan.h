// The vulkan backend: Vulkan 1.2 through the loader, compute only.
//
// Commands are recorded into batches, handed over when one is full or when somebody waits, so that
// the driver runs one while the next is recorded. Everything that a batch needs for a while (its
// descriptor sets, parameters, staging memory) lives and is reused with it.
#ifndef RG_BACKENDS_VULKAN_VULKAN_H
#define RG_BACKENDS_VULKAN_VULKAN_H

#include <vulkan/vulkan.h>

#include "backends/backend.h"

enum {
    VK_BATCHES = 3,
    VK_BATCH_RUNS = 64,         // pass runs a batch, at most
    VK_BATCH_DESCRIPTORS = 512, // of each type
    VK_PARAMS_BYTES = 128 * 1024,
    VK_MIN_STAGING_BYTES = 256 * 1024,
    VK_MAX_STAGING_BYTES = 16 * 1024 * 1024, // larger transfers travel in parts
};

struct vk_memory {
    VkDeviceMemory handle;
    void *mapped; // NULL: the host cannot see it
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

// An instance, and what the validation layer said of us where RG_VK_VALIDATION=1 asks for it.
struct vk_instance {
    VkInstance handle;
    VkDebugUtilsMessengerEXT messenger;
    int complaints, complaints_told; // those that made a call of ours return false
};

struct vk_device {
    struct rg_device pub;
    struct vk_instance instance;
    VkPhysicalDevice physical;
    VkPhysicalDeviceLimits limits;
    VkPhysicalDeviceMemoryProperties memory;
    VkDeviceSize max_allocation_bytes;
    uint32_t allocations; // alive; drivers limit their number
    bool direct;          // the host reads and writes device memory at full speed
    VkDevice handle;
    VkQueue queue;
    uint32_t family;
    VkSampler sampler;
    VkQueryPool queries; // one timestamp
    uint64_t ticks_mask; // the valid bits of a timestamp; 0: there are none
    uint64_t ticks_last, ticks_total;
    struct vk_batch batches[VK_BATCHES];
    int current;
    uint64_t serial; // of the batch being recorded; each has its own
    VkPipeline bound;
    PFN_vkSetDebugUtilsObjectNameEXT set_name; // NULL without the validation layer
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
    VkImageView stored;  // level 0; none for a format that cannot be stored to
};

union vk_descriptor {
    VkDescriptorBufferInfo buffer;
    VkDescriptorImageInfo image;
};

struct vk_pass {
    struct rg_pass pub;
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkPipeline pipeline;
    VkDescriptorUpdateTemplate update; // from union vk_descriptor[RG_MAX_SLOTS]
    VkDeviceSize run_bytes;            // of the uniform block
    // The last set, good for another run in the same batch with the same objects bound.
    VkDescriptorSet set;
    uint64_t set_serial;
    struct rg_binding bound[RG_MAX_SLOTS];
};

// instance.c
// Opens an instance, with the validation layer if `validate`. `why` receives one line on failure.
bool vk_instance_open(struct vk_instance *instance, bool validate, char *why, size_t why_size);
void vk_instance_close(struct vk_instance *instance);
// The usable devices (Vulkan 1.2, a queue that computes), hardware first; returns their number, and
// in `why` the reason when it is 0.
int vk_physical_devices(const struct vk_instance *instance, VkPhysicalDevice *devices, int max,
                        char *why, size_t why_size);
// The family to compute on, and a timestamp's valid bits there. False: there is none.
bool vk_compute_family(VkPhysicalDevice device, uint32_t *family, uint32_t *timestamp_bits);
void vk_describe(VkPhysicalDevice device, int index, struct rg_device_info *info);

// error.c
const char *vk_result_name(VkResult result);
// True if `result` is a success; else logs "noun 'name': call failed with ..." and is false.
bool vk_check(VkResult result, const char *call, const char *noun, const char *name);
// vk_try(noun, name, vkDoIt, arguments...) calls a function of Vulkan and checks it.
#define vk_try(noun, name, function, ...) vk_check(function(__VA_ARGS__), #function, noun, name)
// False if the validation layer has complained since the last time this was asked.
bool vk_healthy(struct vk_device *device);
// Tells the validation layer what an object is called.
void vk_name(struct vk_device *device, VkObjectType type, uint64_t handle, const char *name);
#define VK_HANDLE(handle) ((uint64_t)(uintptr_t)(handle))

// memory.c
enum vk_memory_use { VK_USE_DEVICE, VK_USE_HOST };
bool vk_memory_create(struct vk_device *device, const VkMemoryRequirements *needs,
                      enum vk_memory_use use, const char *noun, const char *name,
                      struct vk_memory *memory);
void vk_memory_destroy(struct vk_device *device, struct vk_memory *memory);
bool vk_block_create(struct vk_device *device, VkDeviceSize size, VkBufferUsageFlags usage,
                     enum vk_memory_use use, const char *name, struct vk_block *block);
void vk_block_destroy(struct vk_device *device, struct vk_block *block);
// Whether VK_USE_DEVICE memory is mapped, and read by the host without waiting for a bus.
bool vk_memory_is_direct(const VkPhysicalDeviceMemoryProperties *memory);

// batch.c
bool vk_batches_create(struct vk_device *device);
void vk_batches_destroy(struct vk_device *device);
// The batch to record into, begun if need be; NULL when the driver failed.
struct vk_batch *vk_record(struct vk_device *device);
// As vk_record, with `size` bytes (at most VK_MAX_STAGING_BYTES) of staging memory, mapped at
// `memory`, that begin at `offset` in batch->staging.
struct vk_batch *vk_record_staged(struct vk_device *device, size_t size, VkDeviceSize *offset,
                                  void **memory);
// Hands the commands over without waiting.
bool vk_submit(struct vk_device *device);
// Hands the commands over and waits until all have ended.
bool vk_wait(struct vk_device *device);
bool vk_is_idle(const struct vk_device *device);
// What is recorded next sees what was recorded before.
void vk_barrier(const struct vk_batch *batch);

// buf.c
struct rg_buf *vk_buf_create(struct rg_device *device, size_t size, const char *name);
void vk_buf_destroy(struct rg_buf *buf);
bool vk_buf_write(struct rg_buf *buf, size_t offset, const void *data, size_t size);
bool vk_buf_read(struct rg_buf *buf, size_t offset, void *data, size_t size);

// image.c
struct rg_image *vk_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                 const char *name);
void vk_image_destroy(struct rg_image *image);

// texels.c
bool vk_image_write(struct rg_image *image, int layer, int level, const void *texels);
bool vk_image_read(struct rg_image *image, int layer, int level, void *texels);
bool vk_image_clear(struct rg_image *image, const void *texel);

// pass.c
struct rg_pass *vk_pass_create(struct rg_device *device, const struct rg_kernel *kernel);
void vk_pass_destroy(struct rg_pass *pass);
bool vk_pass_run(struct rg_pass *pass, const struct rg_run *run);

// time.c
bool vk_sync(struct rg_device *device);
bool vk_time(struct rg_device *device, int64_t *time_ns);

#endif
