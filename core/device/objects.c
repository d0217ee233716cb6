#include "core/device/objects.h"

#include <stdio.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/doing.h"
#include "core/base/log.h"
#include "core/device/limits.h"
#include "core/device/work.h"

// --- room ---

static bool is_counting(const struct rg_device *device)
{
    return device->work->room == RG_ROOM_COUNTED;
}

// Devices with memory of their own leave limits to their driver.
static bool take(struct rg_device *device, int64_t bytes)
{
    return !device->info.software || rg_memory_take(bytes);
}

static void give(struct rg_device *device, int64_t bytes)
{
    if (device->info.software)
        rg_memory_give(bytes);
}

// Takes memory for an object, unless objects are only counted. False, and one logged line, if too
// little is left.
static bool make_room(struct rg_device *device, int64_t bytes, const char *noun, const char *name)
{
    char begin[160];
    const struct rg_work *work = device->work;
    if (work->room == RG_ROOM_WATCHED && device->info.software &&
        work->live_bytes - work->before_bytes + bytes > work->watch_bytes)
        rg_room_count(device);
    if (is_counting(device) || take(device, bytes))
        return true;
    snprintf(begin, sizeof(begin), "%s '%.60s': %.60s", noun, name, device->info.name);
    return rg_memory_refuse(begin, bytes, "a smaller --size or setting");
}

// Counts an object that was made, or that is only counted.
static void count_object(struct rg_device *device, int64_t bytes, int64_t *objects)
{
    struct rg_work *work = device->work;
    (*objects)++;
    work->live_bytes += bytes;
    work->most_bytes = work->most_bytes > work->live_bytes ? work->most_bytes : work->live_bytes;
}

// --- buffers ---

struct rg_buf *rg_buf_create(struct rg_device *device, int64_t size, const char *name)
{
    require_or_null(size > 0, "buffer '%s': its size is %lld bytes, and must be above 0", name,
                    (long long)size);
    require_or_null(size % 4 == 0, "buffer '%s': its size, %lld bytes, is no multiple of 4", name,
                    (long long)size);
    rg_doing_begin("making buffer", name);
    if (!rg_limits_allow_object(device, "buffer", name) ||
        !rg_limits_allow_buf(&device->info, size, name) || !make_room(device, size, "buffer", name))
        return NULL;
    const bool counted = is_counting(device);
    struct rg_buf *buf = counted ? rg_alloc(1, sizeof(*buf), name)
                                 : device->backend->buf_create(device, (size_t)size, name);
    if (!buf) {
        if (!counted)
            give(device, size);
        return NULL;
    }
    buf->device = device;
    buf->size = (size_t)size;
    buf->name = name;
    buf->is_counted = counted;
    count_object(device, size, &device->work->live_buffers);
    return buf;
}

void rg_buf_destroy(struct rg_buf *buf)
{
    if (!buf)
        return;
    struct rg_device *device = buf->device;
    rg_work_settle(device);
    device->work->live_buffers--;
    device->work->live_bytes -= (int64_t)buf->size;
    if (buf->is_counted) {
        free(buf);
        return;
    }
    give(device, (int64_t)buf->size);
    device->backend->buf_destroy(buf);
}

static bool check_range(const struct rg_buf *buf, const char *verb, int64_t offset, int64_t size)
{
    require(offset >= 0 && size > 0 && offset % 4 == 0 && size % 4 == 0 &&
                offset <= (int64_t)buf->size && size <= (int64_t)buf->size - offset,
            "buffer '%s': cannot %s %lld bytes at %lld; it holds %lld, in words of 4", buf->name,
            verb, (long long)size, (long long)offset, (long long)buf->size);
    return true;
}

bool rg_buf_write(struct rg_buf *buf, int64_t offset, const void *data, int64_t size)
{
    if (!check_range(buf, "write", offset, size))
        return false;
    if (is_counting(buf->device))
        return true;
    buf->device->work->bytes_written += size;
    rg_doing_begin("writing buffer", buf->name);
    return buf->device->backend->buf_write(buf, (size_t)offset, data, (size_t)size);
}

bool rg_buf_read(struct rg_buf *buf, int64_t offset, void *data, int64_t size)
{
    if (!check_range(buf, "read", offset, size))
        return false;
    if (is_counting(buf->device))
        return memset(data, 0, (size_t)size);
    buf->device->work->bytes_read += size;
    rg_doing_begin("reading buffer", buf->name);
    const bool ok = buf->device->backend->buf_read(buf, (size_t)offset, data, (size_t)size);
    rg_doing_waited();
    return ok;
}

struct rg_buf *rg_buf_create_with(struct rg_device *device, const void *data, int64_t size,
                                  const char *name)
{
    struct rg_buf *buf = rg_buf_create(device, size, name);
    if (buf && rg_buf_write(buf, 0, data, size))
        return buf;
    rg_buf_destroy(buf);
    return NULL;
}

// --- images ---

static int64_t image_bytes(const struct rg_image_desc *desc)
{
    uint32_t header[RG_MAX_LEVELS];
    return (rg_image_layout(desc, header) - RG_MAX_LEVELS) * 4;
}

static bool check_desc(const struct rg_image_desc *d, const char *name)
{
    require(d->format > RG_FORMAT_NONE && d->format < RG_FORMAT_COUNT,
            "image '%s': unknown format %d", name, (int)d->format);
    require(d->width > 0 && d->height > 0 && d->layers > 0,
            "image '%s': %dx%d with %d layers; each must be above 0", name, d->width, d->height,
            d->layers);
    int largest = d->width > d->height ? d->width : d->height;
    require(d->levels >= 1 && d->levels <= RG_MAX_LEVELS && largest >> (d->levels - 1) >= 1,
            "image '%s': %d levels do not fit %dx%d", name, d->levels, d->width, d->height);
    return true;
}

struct rg_image *rg_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                 const char *name)
{
    if (!check_desc(desc, name) || !rg_limits_allow_object(device, "image", name) ||
        !rg_limits_allow_image(&device->info, desc, name))
        return NULL;
    rg_doing_begin("making image", name);
    const int64_t bytes = image_bytes(desc);
    if (!make_room(device, bytes, "image", name))
        return NULL;
    const bool counted = is_counting(device);
    struct rg_image *image = counted ? rg_alloc(1, sizeof(*image), name)
                                     : device->backend->image_create(device, desc, name);
    if (!image) {
        if (!counted)
            give(device, bytes);
        return NULL;
    }
    image->device = device;
    image->desc = *desc;
    image->name = name;
    image->is_counted = counted;
    count_object(device, bytes, &device->work->live_images);
    return image;
}

void rg_image_destroy(struct rg_image *image)
{
    if (!image)
        return;
    struct rg_device *device = image->device;
    rg_work_settle(device);
    device->work->live_images--;
    device->work->live_bytes -= image_bytes(&image->desc);
    if (image->is_counted) {
        free(image);
        return;
    }
    give(device, image_bytes(&image->desc));
    device->backend->image_destroy(image);
}

static bool check_layer(const struct rg_image *image, int layer, int level)
{
    require(layer >= 0 && layer < image->desc.layers && level >= 0 && level < image->desc.levels,
            "image '%s': no layer %d, level %d; it has %d layers and %d levels", image->name, layer,
            level, image->desc.layers, image->desc.levels);
    return true;
}

static int64_t level_bytes(const struct rg_image *image, int level)
{
    return (int64_t)rg_level_size(image->desc.width, level) *
           rg_level_size(image->desc.height, level) * rg_format_size(image->desc.format);
}

bool rg_image_write(struct rg_image *image, int layer, int level, const void *texels)
{
    if (!check_layer(image, layer, level))
        return false;
    if (is_counting(image->device))
        return true;
    image->device->work->bytes_written += level_bytes(image, level);
    rg_doing_begin("writing image", image->name);
    return image->device->backend->image_write(image, layer, level, texels);
}

bool rg_image_read(struct rg_image *image, int layer, int level, void *texels)
{
    if (!check_layer(image, layer, level))
        return false;
    if (is_counting(image->device))
        return memset(texels, 0, (size_t)level_bytes(image, level));
    image->device->work->bytes_read += level_bytes(image, level);
    rg_doing_begin("reading image", image->name);
    const bool ok = image->device->backend->image_read(image, layer, level, texels);
    rg_doing_waited();
    return ok;
}

bool rg_image_clear(struct rg_image *image, const void *texel)
{
    rg_doing_begin("clearing image", image->name);
    return is_counting(image->device) || image->device->backend->image_clear(image, texel);
}

bool rg_image_makes_levels(const struct rg_image *image)
{
    const struct rg_device_info *info = &image->device->info;
    return info->features & RG_FEATURE_LEVELS &&
           info->limits.formats[image->desc.format].uses & RG_USE_FILTER;
}

bool rg_image_make_levels(struct rg_image *image, int first)
{
    require(rg_image_makes_levels(image), "image '%s': device '%s' makes no levels of %s",
            image->name, image->device->info.name, rg_format_name(image->desc.format));
    require(first >= 1 && first <= image->desc.levels,
            "image '%s': no level %d is made of another; it has %d levels", image->name, first,
            image->desc.levels);
    rg_doing_begin("making levels of image", image->name);
    return is_counting(image->device) || image->device->backend->image_make_levels(image, first);
}

struct rg_image *rg_image_create_with(struct rg_device *device, const struct rg_image_desc *desc,
                                      const void *texel, const char *name)
{
    struct rg_image *image = rg_image_create(device, desc, name);
    if (image && rg_image_clear(image, texel))
        return image;
    rg_image_destroy(image);
    return NULL;
}
