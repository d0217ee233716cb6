#include "core/device/limits.h"

#include "core/base/log.h"
#include "core/device/work.h"

bool rg_limits_are_sound(const struct rg_device_info *info)
{
    const int *groups = info->limits.max_groups, items = info->limits.group_items;
    return (groups[0] > 0 && groups[1] > 0 && groups[2] > 0 && items > 0) ||
           rg_driver_error("device '%s': its driver tells of %d, %d and %d work groups in x, y and "
                           "z, of %d items; at least 1 of each",
                           info->name, groups[0], groups[1], groups[2], items);
}

bool rg_limits_allow_object(const struct rg_device *device, const char *noun, const char *name)
{
    const int most = device->info.limits.max_objects;
    const struct rg_work *work = device->work;
    return work->live_buffers + work->live_images < most ||
           rg_unsupported("%s '%s': %s allows %d buffers and images, and has as many; use fewer",
                          noun, name, device->info.name, most);
}

bool rg_limits_allow_buf(const struct rg_device_info *info, int64_t size, const char *name)
{
    const int64_t most = info->limits.max_buffer_bytes;
    return size <= most ||
           rg_unsupported("buffer '%s': %lld bytes exceed the %lld bytes that %s allows a buffer",
                          name, (long long)size, (long long)most, info->name);
}

bool rg_limits_allow_image(const struct rg_device_info *info, const struct rg_image_desc *desc,
                           const char *name)
{
    const struct rg_format_limits *most = &info->limits.formats[desc->format];
    const char *format = rg_format_name(desc->format);
    if (!most->uses)
        return rg_unsupported("image '%s': %s has no images of %s", name, info->name, format);
    if (desc->width > most->max_px || desc->height > most->max_px ||
        desc->layers > most->max_layers)
        return rg_unsupported(
            "image '%s': %dx%d with %d layers exceeds the %d px and %d layers that %s allows", name,
            desc->width, desc->height, desc->layers, most->max_px, most->max_layers, info->name);
    if (desc->levels > most->max_levels)
        return rg_unsupported("image '%s': %d levels exceed the %d that %s allows images of %s",
                              name, desc->levels, most->max_levels, info->name, format);
    uint32_t header[RG_MAX_LEVELS];
    const int64_t bytes = rg_image_layout(desc, header) * 4;
    return bytes <= most->max_bytes ||
           rg_unsupported("image '%s': %lld bytes exceed the %lld bytes that %s allows an image of "
                          "%s",
                          name, (long long)bytes, (long long)most->max_bytes, info->name, format);
}

// --- kernels ---

static int *member_of(struct rg_slot_limits *slots, enum rg_slot_kind kind)
{
    return kind == RG_SLOT_IMAGE       ? &slots->images
           : kind == RG_SLOT_OUT_IMAGE ? &slots->out_images
                                       : &slots->buffers;
}

static const char *bound_to(enum rg_slot_kind kind)
{
    return kind == RG_SLOT_IMAGE       ? "images"
           : kind == RG_SLOT_OUT_IMAGE ? "images to store to"
                                       : "buffers";
}

// Counts a slot, and checks its number and format.
static bool allow_slot(const struct rg_device_info *info, const char *kernel,
                       const struct rg_slot_info *slot, struct rg_slot_limits *count)
{
    struct rg_slot_limits end = info->limits.slot_end, most = info->limits.slot_count;
    const int below = *member_of(&end, slot->kind), allowed = *member_of(&most, slot->kind);
    if (slot->slot >= below)
        return rg_unsupported(
            "kernel '%s': slot %d, '%s', is beyond the %d slots of %s that %s has", kernel,
            slot->slot, slot->name, below, bound_to(slot->kind), info->name);
    if (++*member_of(count, slot->kind) > allowed)
        return rg_unsupported("kernel '%s': slot %d, '%s', is one more than the %d %s that %s "
                              "allows a kernel",
                              kernel, slot->slot, slot->name, allowed, bound_to(slot->kind),
                              info->name);
    if (slot->kind == RG_SLOT_OUT_IMAGE &&
        !(info->limits.formats[slot->format].uses & RG_USE_STORE))
        return rg_unsupported("kernel '%s': %s does not store to images of %s", kernel, info->name,
                              rg_format_name(slot->format));
    return true;
}

bool rg_limits_allow_kernel(const struct rg_device_info *info, const struct rg_kernel *kernel)
{
    struct rg_slot_limits count = {0};
    if (kernel->draw && info->limits.no_draws[0])
        return rg_unsupported("kernel '%s': %s %s", kernel->name, info->name,
                              info->limits.no_draws);
    for (int i = 0; i < kernel->slot_count; i++)
        if (!allow_slot(info, kernel->name, &kernel->slots[i], &count))
            return false;
    for (int i = 0; kernel->draw && i < RG_DRAWN_SLOTS; i++)
        if (!allow_slot(info, kernel->name, &rg_drawn_slots[i], &count))
            return false;
    return true;
}

// --- runs ---

static bool allow_target(const struct rg_device_info *info, const struct rg_kernel *kernel,
                         enum rg_format format, unsigned uses)
{
    return (info->limits.formats[format].uses & uses) == uses ||
           rg_unsupported("kernel '%s': %s does not %s to %s", kernel->name, info->name,
                          uses & RG_USE_BLEND ? "blend" : "draw", rg_format_name(format));
}

bool rg_limits_allow_draw(const struct rg_device_info *info, const struct rg_kernel *kernel,
                          const struct rg_draw *draw)
{
    if (draw->items_a_query && !info->limits.has_queries)
        return rg_unsupported("kernel '%s': %s has no occlusion queries of its own", kernel->name,
                              info->name);
    const unsigned colour_uses = RG_USE_DRAW | (draw->blend == RG_BLEND_OFF ? 0 : RG_USE_BLEND);
    return (!draw->colour || allow_target(info, kernel, draw->colour->desc.format, colour_uses)) &&
           (!draw->depth || draw->depth_mode == RG_DEPTH_OFF ||
            allow_target(info, kernel, draw->depth->desc.format, RG_USE_DRAW));
}

bool rg_limits_allow_time(const struct rg_device_info *info)
{
    return info->limits.has_clock ||
           rg_unsupported("device '%s': its driver has no clock; use wall clock", info->name);
}

bool rg_limits_allow_native(const char *name, const struct rg_device_info *info)
{
    return !*info->limits.no_native || rg_unsupported("device '%s': has no native way, for %s %s",
                                                      name, info->name, info->limits.no_native);
}

bool rg_limits_allow_fixed(const struct rg_device_info *info)
{
    return !*info->limits.no_native ||
           rg_unsupported("device '%s': has no fixed functions, for it %s", info->name,
                          info->limits.no_native);
}
