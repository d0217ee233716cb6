// Transfers texels between host and images through staging memory, in bands of whole rows.
#include "backends/vulkan/vulkan.h"

#include <string.h>

#include "backends/formats.h"
#include "kernels/dialect/image/memory.h"

// A part of one layer of one level.
struct band {
    int layer, level;
    int width; // of the level
    int y, rows;
};

static VkBufferImageCopy copy_of(const struct rg_image *image, const struct band *band,
                                 VkDeviceSize offset)
{
    return (VkBufferImageCopy){
        .bufferOffset = offset,
        .imageSubresource = {vk_aspect(image->desc.format), (uint32_t)band->level,
                             (uint32_t)band->layer, 1},
        .imageOffset = {0, band->y, 0},
        .imageExtent = {(uint32_t)band->width, (uint32_t)band->rows, 1},
    };
}

static int smaller(int64_t a, int64_t b)
{
    return (int)(a < b ? a : b);
}

// The band after `above`, of as many rows as fit into `max_bytes`; 0 rows at the end.
static struct band next_band(const struct rg_image *image, const struct band *above,
                             size_t max_bytes)
{
    struct band band = *above;
    band.width = rg_level_size(image->desc.width, band.level);
    band.y += above->rows;
    int64_t row_bytes = (int64_t)band.width * rg_format_size(image->desc.format);
    int64_t fit = (int64_t)max_bytes / row_bytes;
    band.rows = smaller(fit > 1 ? fit : 1, rg_level_size(image->desc.height, band.level) - band.y);
    return band;
}

static size_t band_bytes(const struct rg_image *image, const struct band *band)
{
    return (size_t)band->width * (size_t)band->rows * (size_t)rg_format_size(image->desc.format);
}

static bool write_band(struct rg_image *image, const struct band *band, const char *texels)
{
    struct vk_device *device = (struct vk_device *)image->device;
    size_t size = band_bytes(image, band);
    VkDeviceSize offset;
    void *staged;
    struct vk_batch *batch = vk_record_staged(device, size, &offset, &staged);
    if (!batch)
        return false;
    memcpy(staged, texels, size);
    const VkBufferImageCopy copy = copy_of(image, band, offset);
    vk_barrier(batch);
    vkCmdCopyBufferToImage(batch->commands, batch->staging.buffer,
                           ((struct vk_image *)image)->handle, VK_IMAGE_LAYOUT_GENERAL, 1, &copy);
    return true;
}

static bool read_band(struct rg_image *image, const struct band *band, char *texels)
{
    struct vk_device *device = (struct vk_device *)image->device;
    size_t size = band_bytes(image, band);
    VkDeviceSize offset;
    void *staged;
    struct vk_batch *batch = vk_record_staged(device, size, &offset, &staged);
    if (!batch)
        return false;
    const VkBufferImageCopy copy = copy_of(image, band, offset);
    vk_barrier(batch);
    vkCmdCopyImageToBuffer(batch->commands, ((struct vk_image *)image)->handle,
                           VK_IMAGE_LAYOUT_GENERAL, batch->staging.buffer, 1, &copy);
    if (!vk_wait(device))
        return false;
    memcpy(texels, staged, size);
    return true;
}

bool vk_image_write(struct rg_image *image, int layer, int level, const void *texels)
{
    const char *from = texels;
    struct band band = {.layer = layer, .level = level};
    for (;;) {
        band = next_band(image, &band, VK_MAX_STAGING_BYTES);
        if (band.rows == 0)
            return vk_healthy((struct vk_device *)image->device);
        if (!write_band(image, &band, from))
            return false;
        from += band_bytes(image, &band);
    }
}

bool vk_image_read(struct rg_image *image, int layer, int level, void *texels)
{
    char *to = texels;
    struct band band = {.layer = layer, .level = level};
    for (;;) {
        band = next_band(image, &band, VK_MAX_STAGING_BYTES);
        if (band.rows == 0)
            return vk_healthy((struct vk_device *)image->device);
        if (!read_band(image, &band, to))
            return false;
        to += band_bytes(image, &band);
    }
}

// --- clearing ---

static rgba unpack(enum rg_format format, const void *texel)
{
    uint words[4] = {0};
    memcpy(words, texel, (size_t)rg_format_size(format));
    switch (format) {
    case RG_RGBA8:
        return rg_load_RGBA8(words, 0);
    case RG_RGBA16F:
        return rg_load_RGBA16F(words, 0);
    case RG_RGBA32F:
        return rg_load_RGBA32F(words, 0);
    case RG_R16F:
        return rg_load_R16F(words[0], 0);
    case RG_R32F:
    case RG_D32F:
        return rg_load_R32F(words, 0);
    default:
        return rg_load_RG11B10F(words, 0);
    }
}

// Whether any driver packs the number to the bits that it was unpacked from. False for -0, and for
// subnormals, infinities and NaN of the small formats.
static bool is_plain(float v)
{
    const float smallest_normal_half = 6.103515625e-5f, above_largest_half = 65536.0f;
    float magnitude = rg_abs(v);
    return rg_float_bits(v) == 0 ||
           (magnitude >= smallest_normal_half && magnitude < above_largest_half);
}

static bool clear_by_depth(struct vk_device *device, struct vk_image *image, float depth)
{
    struct vk_batch *batch = vk_record(device);
    if (!batch)
        return false;
    const VkClearDepthStencilValue value = {.depth = depth};
    const VkImageSubresourceRange all = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, VK_REMAINING_MIP_LEVELS, 0,
                                         VK_REMAINING_ARRAY_LAYERS};
    vk_barrier(batch);
    vkCmdClearDepthStencilImage(batch->commands, image->handle, VK_IMAGE_LAYOUT_GENERAL, &value, 1,
                                &all);
    return true;
}

static bool clear_by_colour(struct vk_device *device, struct vk_image *image, rgba c)
{
    struct vk_batch *batch = vk_record(device);
    if (!batch)
        return false;
    const VkClearColorValue colour = {.float32 = {c.r, c.g, c.b, c.a}};
    const VkImageSubresourceRange all = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0,
                                         VK_REMAINING_ARRAY_LAYERS};
    vk_barrier(batch);
    vkCmdClearColorImage(batch->commands, image->handle, VK_IMAGE_LAYOUT_GENERAL, &colour, 1, &all);
    return true;
}

// Clears by copying one band of equal texels everywhere, for texels that a driver would not convert
// exactly.
static bool clear_by_copies(struct vk_device *device, struct rg_image *image, const void *texel)
{
    const size_t band_size = 512 * 1024; // at least a row of the largest image
    size_t texel_size = (size_t)rg_format_size(image->desc.format);
    VkDeviceSize offset;
    void *staged;
    struct vk_batch *batch = vk_record_staged(device, band_size, &offset, &staged);
    if (!batch)
        return false;
    for (size_t i = 0; i < band_size; i += texel_size)
        memcpy((char *)staged + i, texel, texel_size);
    vk_barrier(batch);
    for (int layer = 0; layer < image->desc.layers; layer++) {
        for (int level = 0; level < image->desc.levels; level++) {
            struct band band = {.layer = layer, .level = level};
            while ((band = next_band(image, &band, band_size)).rows) {
                const VkBufferImageCopy copy = copy_of(image, &band, offset);
                vkCmdCopyBufferToImage(batch->commands, batch->staging.buffer,
                                       ((struct vk_image *)image)->handle, VK_IMAGE_LAYOUT_GENERAL,
                                       1, &copy);
            }
        }
    }
    return true;
}

bool vk_image_clear(struct rg_image *image, const void *texel)
{
    struct vk_device *device = (struct vk_device *)image->device;
    struct vk_image *vk = (struct vk_image *)image;
    const rgba c = unpack(image->desc.format, texel);
    const bool plain = is_plain(c.r) && is_plain(c.g) && is_plain(c.b) && is_plain(c.a);
    bool cleared;
    if (image->desc.format == RG_D32F && plain && c.r >= 0.0f && c.r <= 1.0f)
        cleared = clear_by_depth(device, vk, c.r);
    else if (image->desc.format != RG_D32F && plain)
        cleared = clear_by_colour(device, vk, c);
    else
        cleared = clear_by_copies(device, image, texel);
    return vk_healthy(device) && cleared;
}

// --- levels ---

static VkImageBlit blit_of(const struct rg_image_desc *desc, int level)
{
    VkImageBlit blit = {
        .srcSubresource = {vk_aspect(desc->format), (uint32_t)level - 1, 0, (uint32_t)desc->layers},
        .dstSubresource = {vk_aspect(desc->format), (uint32_t)level, 0, (uint32_t)desc->layers}};
    blit.srcOffsets[1] = (VkOffset3D){rg_level_size(desc->width, level - 1),
                                      rg_level_size(desc->height, level - 1), 1};
    blit.dstOffsets[1] =
        (VkOffset3D){rg_level_size(desc->width, level), rg_level_size(desc->height, level), 1};
    return blit;
}

bool vk_image_make_levels(struct rg_image *image, int first)
{
    struct vk_device *device = (struct vk_device *)image->device;
    const VkImage handle = ((struct vk_image *)image)->handle;
    struct vk_batch *batch = vk_record(device);
    for (int level = first; batch && level < image->desc.levels; level++) {
        const VkImageBlit blit = blit_of(&image->desc, level);
        vk_barrier(batch);
        vkCmdBlitImage(batch->commands, handle, VK_IMAGE_LAYOUT_GENERAL, handle,
                       VK_IMAGE_LAYOUT_GENERAL, 1, &blit, VK_FILTER_LINEAR);
    }
    return vk_healthy(device) && batch;
}
