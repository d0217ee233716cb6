#include "core/device/targets.h"

#include "core/base/log.h"
#include "kernels/dialect/draw/clip.h"

void rg_target_size(const struct rg_draw *draw, int *width, int *height)
{
    const struct rg_image *image = draw->colour ? draw->colour : draw->depth;
    *width = rg_level_size(image->desc.width, draw->level);
    *height = rg_level_size(image->desc.height, draw->level);
}

bool rg_target_is_whole(const struct rg_draw *draw)
{
    return !draw->x0 && !draw->y0 && !draw->x1 && !draw->y1;
}

static bool check_side(const struct rg_kernel *kernel, const struct rg_image *image)
{
    require(image->desc.width <= RG_VIEWPORT_PX && image->desc.height <= RG_VIEWPORT_PX,
            "kernel '%s': target '%s' is %dx%d; at most %d px a side can be drawn to", kernel->name,
            image->name, image->desc.width, image->desc.height, RG_VIEWPORT_PX);
    return true;
}

static bool check_target(const struct rg_pass *pass, const struct rg_draw *draw,
                         const struct rg_image *image)
{
    const char *kernel = pass->kernel->name;
    require(image->device == pass->device, "kernel '%s': target '%s' belongs to another device",
            kernel, image->name);
    require(draw->layer >= 0 && draw->layer < image->desc.layers && draw->level >= 0 &&
                draw->level < image->desc.levels,
            "kernel '%s': target '%s' has no layer %d, level %d", kernel, image->name, draw->layer,
            draw->level);
    return check_side(pass->kernel, image);
}

static bool check_targets(const struct rg_pass *pass, const struct rg_draw *draw)
{
    const char *kernel = pass->kernel->name;
    require(draw->colour || draw->depth, "kernel '%s': no target given", kernel);
    if ((draw->colour && !check_target(pass, draw, draw->colour)) ||
        (draw->depth && !check_target(pass, draw, draw->depth)))
        return false;
    if (draw->colour) {
        enum rg_format format = draw->colour->desc.format;
        require(format == RG_RGBA8 || format == RG_RGBA16F || format == RG_RGBA32F,
                "kernel '%s': '%s' is %s; colours go to RGBA8, RGBA16F or RGBA32F", kernel,
                draw->colour->name, rg_format_name(format));
    }
    require(!draw->depth || draw->depth->desc.format == RG_D32F,
            "kernel '%s': '%s' is %s; depth goes to D32F", kernel, draw->depth->name,
            rg_format_name(draw->depth->desc.format));
    require(!draw->colour || !draw->depth ||
                (draw->colour->desc.width == draw->depth->desc.width &&
                 draw->colour->desc.height == draw->depth->desc.height),
            "kernel '%s': targets '%s' and '%s' differ in size", kernel, draw->colour->name,
            draw->depth->name);
    require(draw->depth_mode == RG_DEPTH_OFF || draw->depth,
            "kernel '%s': depth is tested, and no depth target given", kernel);
    return true;
}

// Queries must begin at whole chunks, because packing knows no finer place.
static bool check_queries(const struct rg_pass *pass, const struct rg_run *run)
{
    const int items = run->draw->items_a_query;
    const char *kernel = pass->kernel->name;
    require(run->draw->samples, "kernel '%s': queries of %d items, and no buffer for their answers",
            kernel, items);
    require(
        items > 0 && items % RG_DRAW_CHUNK == 0 && run->origin.width % items == 0,
        "kernel '%s': queries of %d items from item %d on; a multiple of %d, from a multiple of "
        "that on",
        kernel, items, run->origin.width, RG_DRAW_CHUNK);
    return true;
}

static int64_t counters_of(const struct rg_run *run)
{
    const int64_t items = (int64_t)run->origin.width + run->extent.width;
    const int a_query = run->draw->items_a_query;
    return a_query ? (items + a_query - 1) / a_query : items;
}

static bool check_samples(const struct rg_pass *pass, const struct rg_run *run)
{
    const struct rg_buf *samples = run->draw->samples;
    const char *kernel = pass->kernel->name;
    if (run->draw->items_a_query && !check_queries(pass, run))
        return false;
    if (!samples)
        return true;
    require(samples->device == pass->device, "kernel '%s': buffer '%s' belongs to another device",
            kernel, samples->name);
    require((int64_t)(samples->size / 4) >= counters_of(run),
            "kernel '%s': buffer '%s' has %zu counters for %lld %s", kernel, samples->name,
            samples->size / 4, (long long)counters_of(run),
            run->draw->items_a_query ? "queries" : "items");
    // The depth must not change meanwhile, or the count would depend on the order of the pixels.
    require(run->draw->depth_mode != RG_DEPTH_WRITE,
            "kernel '%s': visible samples are counted against depth that is not written; use "
            "RG_DEPTH_TEST",
            kernel);
    return true;
}

// A run cannot read an image that it draws to.
static bool check_feedback(const struct rg_pass *pass, const struct rg_run *run)
{
    const struct rg_draw *draw = run->draw;
    for (int i = 0; i < pass->kernel->slot_count; i++) {
        const struct rg_slot_info *slot = &pass->kernel->slots[i];
        const struct rg_binding *bound = &run->slots[slot->slot];
        require(slot->kind == RG_SLOT_IN || slot->kind == RG_SLOT_IMAGE,
                "kernel '%s': slot '%s' is written; DRAW programs write their targets alone",
                pass->kernel->name, slot->name);
        require((!bound->image || (bound->image != draw->colour && bound->image != draw->depth)) &&
                    (!bound->buf || bound->buf != draw->samples),
                "kernel '%s': slot '%s' and a target are one object", pass->kernel->name,
                slot->name);
    }
    return true;
}

bool rg_target_check(const struct rg_pass *pass, const struct rg_run *run)
{
    const struct rg_draw *draw = run->draw;
    require(draw, "kernel '%s': a DRAW program, and the run names no target", pass->kernel->name);
    if (!check_targets(pass, draw) || !check_samples(pass, run) || !check_feedback(pass, run))
        return false;
    int width, height;
    rg_target_size(draw, &width, &height);
    require(rg_target_is_whole(draw) ||
                (draw->x0 >= 0 && draw->y0 >= 0 && draw->x0 < draw->x1 && draw->y0 < draw->y1 &&
                 draw->x1 <= width && draw->y1 <= height),
            "kernel '%s': the scissor %d,%d to %d,%d is empty or leaves the %dx%d target",
            pass->kernel->name, draw->x0, draw->y0, draw->x1, draw->y1, width, height);
    require(run->extent.height == 1 && run->extent.depth == 1 && !run->origin.height &&
                !run->origin.depth,
            "kernel '%s': items of a DRAW program lie along x", pass->kernel->name);
    return true;
}

// --- texels of GRID kernels ---

static struct rg_image *image_of(const struct rg_kernel *kernel, const struct rg_run *run)
{
    return run->slots[rg_kernel_target(kernel)->slot].image;
}

bool rg_target_takes_texels(const struct rg_pass *pass, const struct rg_run *run)
{
    return check_side(pass->kernel, image_of(pass->kernel, run));
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

bool rg_target_of_texels(const struct rg_kernel *kernel, const struct rg_run *run,
                         struct rg_draw *draw)
{
    struct rg_image *image = image_of(kernel, run);
    const struct rg_extent *from = &run->origin, *extent = &run->extent;
    *draw = (struct rg_draw){.colour = image,
                             .layer = kernel->layer(run->params, from->depth),
                             .x0 = from->width,
                             .y0 = from->height,
                             .x1 = smaller(from->width + extent->width, image->desc.width),
                             .y1 = smaller(from->height + extent->height, image->desc.height)};
    return draw->layer >= 0 && draw->layer < image->desc.layers && draw->x0 < draw->x1 &&
           draw->y0 < draw->y1;
}
