#include "core/device/device.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/base/require.h"
#include "core/device/draw.h"
#include "core/device/shared.h"

static const struct {
    const char *name;
    int size;
} formats[RG_FORMAT_COUNT] = {
    [RG_FORMAT_NONE] = {"none", 0},  [RG_RGBA8] = {"RGBA8", 4}, [RG_RGBA16F] = {"RGBA16F", 8},
    [RG_RGBA32F] = {"RGBA32F", 16},  [RG_R32F] = {"R32F", 4},   [RG_R16F] = {"R16F", 2},
    [RG_RG11B10F] = {"RG11B10F", 4}, [RG_D32F] = {"D32F", 4},
};

int rg_format_size(enum rg_format format)
{
    return formats[format].size;
}

const char *rg_format_name(enum rg_format format)
{
    return formats[format].name;
}

int rg_level_size(int size, int level)
{
    return size >> level > 1 ? size >> level : 1;
}

int64_t rg_image_layout(const struct rg_image_desc *desc, uint32_t header[RG_MAX_LEVELS])
{
    int64_t words = RG_MAX_LEVELS;
    memset(header, 0, RG_MAX_LEVELS * sizeof(*header));
    for (int level = 0; level < desc->levels; level++) {
        header[level] = (uint32_t)words;
        const int64_t texels = (int64_t)rg_level_size(desc->width, level) *
                               rg_level_size(desc->height, level) * desc->layers;
        words += (texels * rg_format_size(desc->format) + 3) / 4;
    }
    return rg_format_size(desc->format) < 4 ? words + 1 : words; // two texels are read at once
}

bool rg_image_layout_fits(const struct rg_device *device, const struct rg_image_desc *desc,
                          const char *name)
{
    uint32_t header[RG_MAX_LEVELS];
    const int64_t words = rg_image_layout(desc, header);
    const int64_t most = rg_format_size(desc->format) < 4 ? INT_MAX / 2 : INT_MAX;
    require(words <= most,
            "image '%s': %lld bytes exceed the %lld bytes that %s allows an image of %s", name,
            (long long)words * 4, (long long)most * 4, device->info.name,
            rg_format_name(desc->format));
    return true;
}

size_t rg_image_locate(const struct rg_image_desc *desc, const uint32_t header[RG_MAX_LEVELS],
                       int layer, int level, size_t *size)
{
    *size = (size_t)rg_level_size(desc->width, level) * (size_t)rg_level_size(desc->height, level) *
            (size_t)rg_format_size(desc->format);
    return header[level] * sizeof(*header) + (size_t)layer * *size;
}

static int64_t image_bytes(const struct rg_image_desc *desc)
{
    uint32_t header[RG_MAX_LEVELS];
    return (rg_image_layout(desc, header) - RG_MAX_LEVELS) * 4;
}

// --- devices: listing and opening ---

void rg_device_list_add(struct rg_device_list *list, const struct rg_backend *backend)
{
    char why[160] = "no device";
    int found =
        backend->list(list->infos + list->count, RG_MAX_DEVICES - list->count, why, sizeof(why));
    for (int i = 0; i < found; i++) {
        list->backends[list->count] = backend;
        list->backend_index[list->count++] = i;
    }
    int missing = 0;
    while (list->missing[missing][0])
        missing++;
    if (found == 0)
        snprintf(list->missing[missing], sizeof(list->missing[0]), "%s: %s%s%s%s", backend->name,
                 why, backend->package ? "; the Debian package " : "",
                 backend->package ? backend->package : "", backend->package ? " brings one" : "");
}

void rg_device_list_all(struct rg_device_list *list)
{
    memset(list, 0, sizeof(*list));
    for (int b = 0; rg_backends[b]; b++)
        rg_device_list_add(list, rg_backends[b]);
}

static const struct rg_backend *find_backend(const char *name, size_t length)
{
    for (int b = 0; rg_backends[b]; b++)
        if (strlen(rg_backends[b]->name) == length && !memcmp(rg_backends[b]->name, name, length))
            return rg_backends[b];
    return NULL;
}

static bool contains(const char *text, const char *part)
{
    for (; *text; text++)
        if (!strncasecmp(text, part, strlen(part)))
            return true;
    return false;
}

// The index of the device that `choice` picks: NULL the first, else an index, a whole name, or a
// part of the driver's name for it. -1: none.
static int choose(const struct rg_device_info *infos, int count, const char *name,
                  const char *choice)
{
    if (!choice)
        return 0;
    for (int i = 0; i < count; i++)
        if (!strcmp(infos[i].name, name))
            return i;
    char *end;
    long index = strtol(choice, &end, 10);
    if (end != choice && !*end)
        return index >= 0 && index < count ? (int)index : -1;
    for (int i = 0; i < count; i++)
        if (*choice && contains(infos[i].device, choice))
            return i;
    return -1;
}

struct rg_device *rg_device_open(const char *name)
{
    const char *colon = strchr(name, ':');
    const struct rg_backend *backend =
        find_backend(name, colon ? (size_t)(colon - name) : strlen(name));
    require_or_null(backend, "device '%s': unknown; `raingauge list devices` prints the names",
                    name);
    struct rg_device_info infos[RG_MAX_DEVICES];
    char why[160] = "no device";
    int count = backend->list(infos, RG_MAX_DEVICES, why, sizeof(why));
    if (count == 0)
        return rg_unsupported_null("device '%s': %s%s%s", name, why,
                                   backend->package ? "; install the Debian package " : "",
                                   backend->package ? backend->package : "");
    int index = choose(infos, count, name, colon ? colon + 1 : NULL);
    require_or_null(index >= 0,
                    "device '%s': %s has no such device; `raingauge list devices` prints the names",
                    name, backend->name);
    struct rg_work *work = rg_alloc(1, sizeof(*work), name);
    struct rg_device *device = work ? backend->create(index) : NULL;
    if (!device) {
        free(work);
        return NULL;
    }
    device->backend = backend;
    device->work = work;
    return device;
}

bool rg_device_close(struct rg_device *device)
{
    if (!device)
        return true;
    const bool shared_clean = rg_shared_close(device);
    rg_packing_destroy(device);
    device->backend->sync(device);
    const struct rg_work *w = device->work;
    const bool clean = !w->live_buffers && !w->live_images && !w->live_passes;
    if (!clean)
        rg_error("device '%s': closed with %lld buffers, %lld images and %lld passes not destroyed",
                 device->info.name, (long long)w->live_buffers, (long long)w->live_images,
                 (long long)w->live_passes);
    free(device->work);
    device->backend->destroy(device);
    return clean && shared_clean;
}

const struct rg_work *rg_device_work(const struct rg_device *device)
{
    return device->work;
}

bool rg_device_sync(struct rg_device *device)
{
    return device->backend->sync(device);
}

bool rg_device_time(struct rg_device *device, int64_t *time_ns)
{
    return device->backend->time(device, time_ns);
}

// --- buffers ---

struct rg_buf *rg_buf_create(struct rg_device *device, int64_t size, const char *name)
{
    require_or_null(size > 0, "buffer '%s': its size is %lld bytes, and must be above 0", name,
                    (long long)size);
    require_or_null(size % 4 == 0, "buffer '%s': its size, %lld bytes, is no multiple of 4", name,
                    (long long)size);
    if (size > device->info.limits.max_buffer_bytes)
        return rg_unsupported_null(
            "buffer '%s': %lld bytes exceed the %lld bytes that %s allows a buffer", name,
            (long long)size, (long long)device->info.limits.max_buffer_bytes, device->info.name);
    struct rg_buf *buf = device->backend->buf_create(device, (size_t)size, name);
    if (!buf)
        return NULL;
    buf->device = device;
    buf->size = (size_t)size;
    buf->name = name;
    device->work->live_buffers++;
    device->work->live_bytes += size;
    return buf;
}

void rg_buf_destroy(struct rg_buf *buf)
{
    if (!buf)
        return;
    struct rg_device *device = buf->device;
    device->backend->sync(device);
    device->work->live_buffers--;
    device->work->live_bytes -= (int64_t)buf->size;
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
    buf->device->work->bytes_written += size;
    return buf->device->backend->buf_write(buf, (size_t)offset, data, (size_t)size);
}

bool rg_buf_read(struct rg_buf *buf, int64_t offset, void *data, int64_t size)
{
    if (!check_range(buf, "read", offset, size))
        return false;
    buf->device->work->bytes_read += size;
    return buf->device->backend->buf_read(buf, (size_t)offset, data, (size_t)size);
}

// --- images ---

static bool check_desc(const struct rg_device *device, const struct rg_image_desc *d,
                       const char *name)
{
    const struct rg_limits *limits = &device->info.limits;
    require(d->format > RG_FORMAT_NONE && d->format < RG_FORMAT_COUNT,
            "image '%s': unknown format %d", name, (int)d->format);
    require(d->width > 0 && d->height > 0 && d->layers > 0,
            "image '%s': %dx%d with %d layers; each must be above 0", name, d->width, d->height,
            d->layers);
    if (d->width > limits->max_image_px || d->height > limits->max_image_px ||
        d->layers > limits->max_image_layers)
        return rg_unsupported(
            "image '%s': %dx%d with %d layers exceeds the %d px and %d layers that %s allows", name,
            d->width, d->height, d->layers, limits->max_image_px, limits->max_image_layers,
            device->info.name);
    int largest = d->width > d->height ? d->width : d->height;
    require(d->levels >= 1 && d->levels <= 16 && largest >> (d->levels - 1) >= 1,
            "image '%s': %d levels do not fit %dx%d", name, d->levels, d->width, d->height);
    return true;
}

struct rg_image *rg_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                 const char *name)
{
    if (!check_desc(device, desc, name))
        return NULL;
    struct rg_image *image = device->backend->image_create(device, desc, name);
    if (!image)
        return NULL;
    image->device = device;
    image->desc = *desc;
    image->name = name;
    device->work->live_images++;
    device->work->live_bytes += image_bytes(desc);
    return image;
}

void rg_image_destroy(struct rg_image *image)
{
    if (!image)
        return;
    struct rg_device *device = image->device;
    device->backend->sync(device);
    device->work->live_images--;
    device->work->live_bytes -= image_bytes(&image->desc);
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
    image->device->work->bytes_written += level_bytes(image, level);
    return image->device->backend->image_write(image, layer, level, texels);
}

bool rg_image_read(struct rg_image *image, int layer, int level, void *texels)
{
    if (!check_layer(image, layer, level))
        return false;
    image->device->work->bytes_read += level_bytes(image, level);
    return image->device->backend->image_read(image, layer, level, texels);
}

bool rg_image_clear(struct rg_image *image, const void *texel)
{
    return image->device->backend->image_clear(image, texel);
}

// --- passes ---

struct rg_pass *rg_pass_create(struct rg_device *device, const char *name)
{
    const struct rg_kernel *kernel = rg_kernel_find(name);
    require_or_null(kernel, "kernel '%s': unknown; kernels/meson.build lists them", name);
    struct rg_pass *pass = device->backend->pass_create(device, kernel);
    if (!pass)
        return NULL;
    pass->device = device;
    pass->kernel = kernel;
    device->work->live_passes++;
    if (kernel->draw && device->backend->packed && !rg_packer_create(pass)) {
        rg_pass_destroy(pass);
        return NULL;
    }
    return pass;
}

void rg_pass_destroy(struct rg_pass *pass)
{
    if (!pass)
        return;
    rg_packer_destroy(pass);
    pass->device->backend->sync(pass->device);
    pass->device->work->live_passes--;
    pass->device->backend->pass_destroy(pass);
}

static bool is_buffer(enum rg_slot_kind kind)
{
    return kind < RG_SLOT_IMAGE;
}

static bool is_written(enum rg_slot_kind kind)
{
    return kind != RG_SLOT_IN && kind != RG_SLOT_IMAGE;
}

static bool check_slot(const struct rg_pass *pass, const struct rg_slot_info *slot,
                       const struct rg_binding *bound)
{
    const char *kernel = pass->kernel->name;
    if (is_buffer(slot->kind)) {
        require(bound->buf && !bound->image, "kernel '%s': slot %d, '%s', wants a buffer", kernel,
                slot->slot, slot->name);
        require(bound->buf->device == pass->device,
                "kernel '%s': buffer '%s' belongs to another device", kernel, bound->buf->name);
        require(bound->buf->size % (size_t)slot->element_size == 0,
                "kernel '%s': buffer '%s' of %zu bytes holds no whole number of elements of %d",
                kernel, bound->buf->name, bound->buf->size, slot->element_size);
        return true;
    }
    require(bound->image && !bound->buf, "kernel '%s': slot %d, '%s', wants an image", kernel,
            slot->slot, slot->name);
    require(bound->image->device == pass->device,
            "kernel '%s': image '%s' belongs to another device", kernel, bound->image->name);
    require(bound->image->desc.format == slot->format,
            "kernel '%s': slot %d wants an image of %s, and '%s' is %s", kernel, slot->slot,
            rg_format_name(slot->format), bound->image->name,
            rg_format_name(bound->image->desc.format));
    return true;
}

// An object that a pass writes is bound once, so that no item sees another's writes.
static bool check_aliases(const struct rg_kernel *kernel, const struct rg_run *run)
{
    for (int i = 0; i < kernel->slot_count; i++) {
        for (int j = 0; j < kernel->slot_count; j++) {
            const struct rg_binding *a = &run->slots[kernel->slots[i].slot];
            const struct rg_binding *b = &run->slots[kernel->slots[j].slot];
            bool same = (a->buf && a->buf == b->buf) || (a->image && a->image == b->image);
            require(i == j || !same || !is_written(kernel->slots[i].kind),
                    "kernel '%s': slots '%s' and '%s' are one object, and it is written",
                    kernel->name, kernel->slots[i].name, kernel->slots[j].name);
        }
    }
    return true;
}

// Drivers pad the last work group; its items must not overflow an int either.
enum { MAX_ITEMS = INT_MAX - 1024 };

static bool check_span(const struct rg_kernel *kernel, char axis, int64_t origin, int64_t count)
{
    require(count > 0 && origin >= 0 && origin + count <= MAX_ITEMS,
            "kernel '%s': %lld items in %c from %lld; at least 1, and within 2147482623",
            kernel->name, (long long)count, axis, (long long)origin);
    return true;
}

static bool check_run(const struct rg_pass *pass, const struct rg_run *run)
{
    const struct rg_kernel *kernel = pass->kernel;
    require(run->params, "kernel '%s': no parameters given", kernel->name);
    if (!check_span(kernel, 'x', run->origin.width, run->extent.width) ||
        !check_span(kernel, 'y', run->origin.height, run->extent.height) ||
        !check_span(kernel, 'z', run->origin.depth, run->extent.depth))
        return false;
    for (int i = 0; i < kernel->slot_count; i++)
        if (!check_slot(pass, &kernel->slots[i], &run->slots[kernel->slots[i].slot]))
            return false;
    require(kernel->draw || !run->draw, "kernel '%s': a GRID kernel, and the run names a target",
            kernel->name);
    return check_aliases(kernel, run) && (!kernel->draw || rg_draw_check(pass, run));
}

static int smaller(int64_t a, int b)
{
    return a < b ? (int)a : b;
}

// Runs what exceeds a device's work groups as several dispatches, each with its own origin.
static bool run_folded(struct rg_pass *pass, const struct rg_run *run)
{
    const struct rg_limits *limits = &pass->device->info.limits;
    const int64_t max_width = (int64_t)limits->max_groups[0] * limits->group_items;
    struct rg_run part = *run;
    struct rg_extent done = {0, 0, 0};
    for (done.depth = 0; done.depth < run->extent.depth; done.depth += part.extent.depth) {
        part.origin.depth = run->origin.depth + done.depth;
        part.extent.depth = smaller(limits->max_groups[2], run->extent.depth - done.depth);
        for (done.height = 0; done.height < run->extent.height; done.height += part.extent.height) {
            part.origin.height = run->origin.height + done.height;
            part.extent.height = smaller(limits->max_groups[1], run->extent.height - done.height);
            for (done.width = 0; done.width < run->extent.width; done.width += part.extent.width) {
                part.origin.width = run->origin.width + done.width;
                part.extent.width = smaller(max_width, run->extent.width - done.width);
                pass->device->work->dispatches++;
                if (!pass->device->backend->pass_run(pass, &part))
                    return false;
            }
        }
    }
    return true;
}

bool rg_pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    if (!check_run(pass, run))
        return false;
    struct rg_work *work = pass->device->work;
    work->runs++;
    work->items += (int64_t)run->extent.width * run->extent.height * run->extent.depth;
    return pass->kernel->draw ? rg_draw_run(pass, run) : run_folded(pass, run);
}
