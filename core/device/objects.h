// Buffers and images, checked.
//
// Each function refuses bad arguments with one logged line that names the object and the number,
// and counts what it moves (core/device/work.h). create returns NULL and every other function false
// when it has failed and logged why. Destroy functions accept NULL. Types, and how texels travel,
// are in backends/backend.h; sizes and offsets are bytes, multiples of 4. An object's name, for
// messages and debug labels, is not copied: it outlives the object, as a string literal does.
#ifndef RG_CORE_DEVICE_OBJECTS_H
#define RG_CORE_DEVICE_OBJECTS_H

#include "backends/backend.h"

struct rg_buf *rg_buf_create(struct rg_device *device, int64_t size, const char *name);
// Makes a buffer with `size` bytes of `data`.
struct rg_buf *rg_buf_create_with(struct rg_device *device, const void *data, int64_t size,
                                  const char *name);
void rg_buf_destroy(struct rg_buf *buf);
bool rg_buf_write(struct rg_buf *buf, int64_t offset, const void *data, int64_t size);
bool rg_buf_read(struct rg_buf *buf, int64_t offset, void *data, int64_t size);

struct rg_image *rg_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                 const char *name);
// Makes an image whose texels, of all layers and levels, are all `texel`, packed as its format
// says.
struct rg_image *rg_image_create_with(struct rg_device *device, const struct rg_image_desc *desc,
                                      const void *texel, const char *name);
void rg_image_destroy(struct rg_image *image);
bool rg_image_write(struct rg_image *image, int layer, int level, const void *texels);
bool rg_image_read(struct rg_image *image, int layer, int level, void *texels);
bool rg_image_clear(struct rg_image *image, const void *texel);
// Whether the driver can make an image's levels: it does on native devices (docs/native.md).
// rg_image_make_levels has it make every level from `first` on, each from the one above.
bool rg_image_makes_levels(const struct rg_image *image);
bool rg_image_make_levels(struct rg_image *image, int first);

#endif
