// The checked device: every call of a backend goes through here.
//
// Each function checks its arguments and refuses with one logged line that names the object and the
// number; splits runs that exceed a device's work-group limits; counts work; and finds what was not
// destroyed. create returns NULL and every other function false when it has failed and logged why.
// Destroy functions accept NULL. Types are in backends/backend.h.
#ifndef RG_CORE_DEVICE_DEVICE_H
#define RG_CORE_DEVICE_DEVICE_H

#include "backends/backend.h"
#include "kernels/dialect/image/memory.h"

enum { RG_MAX_DEVICES = 32 };

// What was done on a device since it was opened.
struct rg_work {
    int64_t runs;                      // pass runs asked for
    int64_t dispatches;                // pass runs after folding
    int64_t items;                     // items run
    int64_t bytes_written, bytes_read; // between host and device
    int64_t live_buffers, live_images, live_passes;
    int64_t live_bytes; // of buffers and images
};

// A backend's devices, or why there is none. Quiet.
struct rg_device_list {
    int count;
    struct rg_device_info infos[RG_MAX_DEVICES];
    int backend_index[RG_MAX_DEVICES]; // what backend->create takes
    const struct rg_backend *backends[RG_MAX_DEVICES];
    // One line a backend without a device, "" after the last.
    char missing[RG_MAX_BACKENDS + 1][256];
};
void rg_device_list_all(struct rg_device_list *list);
// Adds one backend's to a list that began zeroed; each backend once.
void rg_device_list_add(struct rg_device_list *list, const struct rg_backend *backend);

// Opens a device by name: "cpu", "cpu:reference", "gl", "gl:1", "vulkan:NVIDIA" (an index, or a
// part of the device's name, case ignored). NULL, and one logged line, on failure: the user's error
// where there is no such name, unsupported where the driver is absent, the driver's where it fails.
struct rg_device *rg_device_open(const char *name);
// Waits, reports what still lives on it as an error, and closes it. Returns false on a leak.
bool rg_device_close(struct rg_device *device);

const struct rg_work *rg_device_work(const struct rg_device *device);

// An object's name, for messages and debug labels, is not copied: it outlives the object, as a
// string literal does.
struct rg_buf *rg_buf_create(struct rg_device *device, int64_t size, const char *name);
void rg_buf_destroy(struct rg_buf *buf);
bool rg_buf_write(struct rg_buf *buf, int64_t offset, const void *data, int64_t size);
bool rg_buf_read(struct rg_buf *buf, int64_t offset, void *data, int64_t size);

struct rg_image *rg_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                 const char *name);
void rg_image_destroy(struct rg_image *image);
bool rg_image_write(struct rg_image *image, int layer, int level, const void *texels);
bool rg_image_read(struct rg_image *image, int layer, int level, void *texels);
bool rg_image_clear(struct rg_image *image, const void *texel);

// Bytes a texel; 0 for RG_FORMAT_NONE. Name as in kernels ("RGBA16F").
int rg_format_size(enum rg_format format);
const char *rg_format_name(enum rg_format format);
// Width or height of a level.
int rg_level_size(int size, int level);
// How the devices that keep images in plain memory lay them out (kernels/dialect/image/memory.h):
// the word at which each level begins, which is also the image's header, and the words of the whole
// image, header included.
int64_t rg_image_layout(const struct rg_image_desc *desc, uint32_t header[RG_MAX_LEVELS]);
// Whether kernels can count such an image's texels in an int; if not, logs one line and is false.
bool rg_image_layout_fits(const struct rg_device *device, const struct rg_image_desc *desc,
                          const char *name);
// Where a layer of a level begins in it, and its size, both in bytes.
size_t rg_image_locate(const struct rg_image_desc *desc, const uint32_t header[RG_MAX_LEVELS],
                       int layer, int level, size_t *size);

struct rg_pass *rg_pass_create(struct rg_device *device, const char *kernel);
void rg_pass_destroy(struct rg_pass *pass);
bool rg_pass_run(struct rg_pass *pass, const struct rg_run *run);

bool rg_device_sync(struct rg_device *device);
bool rg_device_time(struct rg_device *device, int64_t *time_ns);

#endif
