// The opencl backend: kernels as OpenCL C 1.2 on any driver that the ICD loader finds.
//
// Each device has one context and one in-order queue. Images are plain buffers
// (kernels/dialect/image/memory.h).
#ifndef RG_BACKENDS_OPENCL_OPENCL_H
#define RG_BACKENDS_OPENCL_OPENCL_H

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include "backends/backend.h"
#include "backends/manifests.h"
#include "kernels/dialect/draw/bins.h"
#include "kernels/dialect/image/memory.h"

#define CL_PLATFORM_NOT_FOUND_KHR (-1001) // cl_khr_icd

#define OPENCL_PACKAGE "pocl-opencl-icd" // the Debian package with a driver

// Data for the device: a copy that lives until the queue has ended.
struct opencl_staged {
    struct opencl_staged *next;
    unsigned char data[];
};

struct opencl_device {
    struct rg_device pub;
    cl_device_id id;
    cl_context context;
    cl_command_queue queue; // in order, with profiling
    int queued;             // commands since the queue was last known to be empty
    // Programs built so far, by rg_kernel_index and variant, because PoCL takes 30 ms for one.
    cl_program *programs;
    struct opencl_staged *staged;
    size_t staged_bytes;
    struct opencl_bins *bins; // for DRAW passes; NULL before the first
};

// A device allocation of words, the common part of buffers and images.
struct opencl_memory {
    cl_mem mem;
    struct opencl_device *device;
    const char *kind, *name; // "buffer 'heights'" in messages
};

struct opencl_buf {
    struct rg_buf pub;
    struct opencl_memory memory;
};

struct opencl_image {
    struct rg_image pub;
    struct opencl_memory memory;
    rg_image_shape shape;
    uint32_t header[RG_MAX_LEVELS]; // kernels/dialect/image/memory.h
    int words;                      // of the whole image
};

// A GRID kernel has one variant, a DRAW program one for each combination of blending and depth
// test, built when first needed (draw.c).
enum { OPENCL_VARIANTS = 4 * 3 * 3 };

struct opencl_pass {
    struct rg_pass pub;
    struct opencl_device *device;
    const struct rg_kernel *info;
    cl_kernel variants[OPENCL_VARIANTS];
};

// api/error.c: an error code by its name in cl.h, "CL_INVALID_VALUE"; "error -9999" for others.
const char *opencl_error_name(cl_int code);
// True for CL_SUCCESS. Else logs one line that names object, call and code, and is false.
bool opencl_check(cl_int code, const char *call, const char *kind, const char *name);

// Suppress what drivers and their compilers print to stderr between these two calls; the second
// takes the first one's result.
int opencl_hide_messages(void);
void opencl_show_messages(int hidden);

// api/search.c
// The usable devices in the loader's order (GPUs first); `search` says why others are not usable.
struct opencl_search {
    enum rg_manifest_state state;
    char why[512]; // preferring failures; "": none
};
int opencl_find(struct opencl_search *search, cl_device_id *ids, int max);
// The places where the loader finds drivers, and the result of backend->list for `count` devices
// found.
extern const struct rg_manifest_rules opencl_manifests;
int opencl_judge(const struct opencl_search *search, int count, char *why, size_t why_size);
// backend->functions
int opencl_functions(struct rg_device *device, const void **functions, int max);
// A text property of a device or platform; "unnamed" and 0 if its driver does not know it.
enum { OPENCL_TEXT = 1024 };
const char *opencl_text(cl_device_id id, cl_device_info what, char text[OPENCL_TEXT]);
const char *opencl_platform_text(cl_platform_id id, cl_platform_info what, char text[OPENCL_TEXT]);
cl_ulong opencl_number(cl_device_id id, cl_device_info what, size_t size);
int opencl_version(const char *version); // 30 for "OpenCL 3.0 PoCL 3.1"

// api/queue.c
// Call it before each command that is queued without waiting.
bool opencl_will_queue(struct opencl_device *device);
// Call it when the queue is known to be empty.
void opencl_ended(struct opencl_device *device);

// buf.c
struct rg_buf *opencl_buf_create(struct rg_device *device, size_t size, const char *name);
void opencl_buf_destroy(struct rg_buf *buf);
bool opencl_buf_write(struct rg_buf *buf, size_t offset, const void *data, size_t size);
bool opencl_buf_read(struct rg_buf *buf, size_t offset, void *data, size_t size);
bool opencl_memory_create(struct opencl_memory *memory, size_t size);
bool opencl_memory_write(const struct opencl_memory *memory, size_t offset, const void *data,
                         size_t size);
bool opencl_memory_read(const struct opencl_memory *memory, size_t offset, void *data, size_t size);

// image.c
struct rg_image *opencl_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                     const char *name);
void opencl_image_destroy(struct rg_image *image);
bool opencl_image_write(struct rg_image *image, int layer, int level, const void *texels);
bool opencl_image_read(struct rg_image *image, int layer, int level, void *texels);
bool opencl_image_clear(struct rg_image *image, const void *texel);
// The word of the image's memory at which a layer of a level begins.
int opencl_image_word(const struct rg_image *image, int layer, int level);

// slots.c
// Sets a kernel's slots from argument `next` on: a buffer and its element count, and an image's
// shape.
cl_int opencl_set_slots(cl_kernel kernel, cl_uint next, const struct rg_kernel *info,
                        const struct rg_run *run);

// target.c
// Sets a draw target, or none, from argument *next on: its memory, and the first word of the layer
// and level.
cl_int opencl_set_target(cl_kernel kernel, cl_uint *next, const struct rg_image *image,
                         const struct rg_draw *draw);

// program.c
// Builds a program with -D options (" -DX=1"); NULL and one logged line that names it on failure.
cl_program opencl_build(struct opencl_device *device, const struct rg_kernel_code *text,
                        const char *defines, const char *name);
// A pass's kernel in a variant, built with `defines` at the first call; NULL and one logged line.
cl_kernel opencl_kernel_of(struct opencl_pass *pass, int variant, const char *entry,
                           const char *defines);

// bins.c: sorts a draw's packed primitives into tiles (kernels/dialect/draw/bins.h). These are a
// device's scratch buffers.
struct opencl_bins {
    struct opencl_device *device;
    cl_program program;
    cl_kernel walk, scan;
    struct opencl_memory places, list, round;
    size_t places_bytes, list_bytes;
    rg_bins shape;   // of the current draw
    int tried_prims; // primitives to try in the next round
};

// Side of the block of pixels that a work item shades: on a processor a whole tile, on a GPU a
// part, with a work group for each tile.
int opencl_block_px(const struct opencl_device *device);
struct opencl_bins *opencl_bins_of(struct opencl_device *device); // made on first use
void opencl_bins_destroy(struct opencl_device *device);
// Begins a draw: covers its scissor with tiles.
bool opencl_bins_begin(struct opencl_bins *bins, const struct rg_kernel *kernel,
                       const struct rg_run *run);
// Sorts the primitives from shape.first_prim on, on a processor as many as fit into the list, and
// sets shape.end_prim. *more: others may remain.
bool opencl_bins_sort(struct opencl_bins *bins, const struct rg_run *run, bool *more);

// draw.c
bool opencl_draw(struct rg_pass *pass, const struct rg_run *run);

// pass.c
struct rg_pass *opencl_pass_create(struct rg_device *device, const struct rg_kernel *kernel);
void opencl_pass_destroy(struct rg_pass *pass);
bool opencl_pass_code(struct rg_pass *pass, void **bytes, size_t *size);
bool opencl_pass_run(struct rg_pass *pass, const struct rg_run *run);

// time.c
bool opencl_sync(struct rg_device *device);
bool opencl_time(struct rg_device *device, int64_t *time_ns);

#endif
