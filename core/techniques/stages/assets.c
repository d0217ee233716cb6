#include "core/techniques/stages/assets.h"

#include <stdio.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/device/shared.h"

static void *fail(struct rg_instance *instance)
{
    instance->has_failed = true;
    return NULL;
}

// Adds an empty asset.
static struct rg_asset *add(struct rg_instance *instance, const char *name)
{
    if (instance->has_failed)
        return NULL;
    instance->has_failed = true;
    if (instance->asset_count == RG_MAX_ASSETS)
        return rg_error_null("asset '%s': one more than an instance has room for; raise "
                             "RG_MAX_ASSETS",
                             name);
    if (strlen(name) >= RG_ASSET_NAME || rg_asset_find(instance, name))
        return rg_error_null("asset '%s': its name is too long or taken; give it another", name);
    instance->has_failed = false;
    struct rg_asset *asset = &instance->assets[instance->asset_count++];
    memset(asset, 0, sizeof(*asset));
    memcpy(asset->name, name, strlen(name));
    return asset;
}

struct rg_asset *rg_asset_find(struct rg_instance *instance, const char *name)
{
    for (int i = 0; i < instance->asset_count; i++)
        if (!strcmp(instance->assets[i].name, name))
            return &instance->assets[i];
    return NULL;
}

// --- buffers ---

struct rg_asset *rg_lend_buf(struct rg_instance *instance, const char *name, struct rg_buf *buf)
{
    struct rg_asset *asset = add(instance, name);
    if (!asset)
        return NULL;
    asset->buf = buf;
    asset->is_defined = buf;
    rg_set_items(asset, buf ? (int)(buf->size / 4) : 1, 1, 1);
    return asset;
}

struct rg_asset *rg_add_room(struct rg_instance *instance, const char *name, int64_t count)
{
    struct rg_asset *asset = rg_lend_buf(instance, name, NULL);
    if (!asset)
        return NULL;
    return rg_make_room(instance, asset, count) ? asset : fail(instance);
}

// Writes in pieces, so that the host needs no second buffer as large.
static bool write_zeroes(struct rg_buf *buf, int64_t bytes)
{
    const int64_t piece = (int64_t)4 << 20;
    void *zeroes = rg_alloc((size_t)(bytes < piece ? bytes : piece), 1, buf->name);
    bool ok = zeroes != NULL;
    for (int64_t done = 0; ok && done < bytes; done += piece)
        ok = rg_buf_write(buf, done, zeroes, bytes - done < piece ? bytes - done : piece);
    free(zeroes);
    return ok;
}

struct rg_asset *rg_add_buf(struct rg_instance *instance, const char *name, int64_t count,
                            const void *words)
{
    struct rg_asset *asset = rg_add_room(instance, name, count);
    const bool ok = asset && (words ? rg_buf_write(asset->buf, 0, words, count * 4)
                                    : write_zeroes(asset->buf, count * 4));
    if (!ok)
        return fail(instance);
    asset->is_defined = true;
    return asset;
}

bool rg_make_room(struct rg_instance *instance, struct rg_asset *asset, int64_t count)
{
    if (asset->buf && (int64_t)asset->buf->size >= count * 4)
        return true;
    rg_empty(asset);
    asset->buf = rg_buf_create(instance->device, count * 4, asset->name);
    asset->is_owned = true;
    rg_set_items(asset, count <= INT32_MAX ? (int)count : 0, 1, 1);
    return asset->buf;
}

// --- images ---

struct rg_asset *rg_lend_image(struct rg_instance *instance, const char *name,
                               struct rg_image *image)
{
    struct rg_asset *asset = add(instance, name);
    if (!asset)
        return NULL;
    asset->is_image = true;
    asset->image = image;
    asset->is_defined = image;
    if (image)
        rg_set_items(asset, image->desc.width, image->desc.height, image->desc.layers);
    return asset;
}

struct rg_asset *rg_add_image_of(struct rg_instance *instance, const char *name,
                                 const struct rg_image_desc *desc)
{
    struct rg_asset *asset = rg_lend_image(instance, name, NULL);
    if (!asset)
        return NULL;
    return rg_make_image(instance, asset, desc) ? asset : fail(instance);
}

bool rg_make_image(struct rg_instance *instance, struct rg_asset *asset,
                   const struct rg_image_desc *desc)
{
    const struct rg_image_desc *is = asset->image ? &asset->image->desc : NULL;
    if (is && is->format == desc->format && is->width == desc->width &&
        is->height == desc->height && is->layers == desc->layers && is->levels == desc->levels)
        return true;
    rg_empty(asset);
    static const uint32_t nothing[4] = {0};
    asset->image = rg_image_create_with(instance->device, desc, nothing, asset->name);
    asset->is_owned = true;
    rg_set_items(asset, desc->width, desc->height, desc->layers);
    asset->is_defined = asset->image;
    return asset->is_defined;
}

struct rg_asset *rg_give_image(struct rg_instance *instance, const char *name,
                               struct rg_image *image)
{
    struct rg_asset *asset = image ? rg_lend_image(instance, name, image) : fail(instance);
    if (asset)
        asset->is_owned = true;
    else
        rg_image_destroy(image);
    return asset;
}

struct rg_asset *rg_share_image(struct rg_instance *instance, const char *name,
                                struct rg_image *image)
{
    struct rg_asset *asset = image ? rg_lend_image(instance, name, image) : fail(instance);
    if (asset)
        asset->is_shared = true;
    else
        rg_shared_put(instance->device, image);
    return asset;
}

struct rg_asset *rg_add_image(struct rg_instance *instance, const char *name, enum rg_format format,
                              int width, int height)
{
    return rg_add_image_of(instance, name, &(struct rg_image_desc){format, width, height, 1, 1});
}

// --- buffers and images alike ---

void rg_set_items(struct rg_asset *asset, int width, int height, int depth)
{
    if (asset)
        asset->items = (struct rg_extent){width, height, depth};
}

void rg_empty(struct rg_asset *asset)
{
    if (asset->is_owned) {
        rg_buf_destroy(asset->buf);
        rg_image_destroy(asset->image);
    }
    if (asset->is_shared)
        rg_shared_put(asset->image->device, asset->image);
    asset->is_shared = false;
    asset->buf = NULL;
    asset->image = NULL;
    asset->is_defined = false;
}

void rg_swap(struct rg_asset *a, struct rg_asset *b)
{
    const struct rg_asset was = *a;
    a->buf = b->buf;
    a->image = b->image;
    a->is_defined = b->is_defined;
    b->buf = was.buf;
    b->image = was.image;
    b->is_defined = was.is_defined;
}

void rg_add_state(struct rg_instance *instance, struct rg_asset *asset, const char *name, int row,
                  int margin)
{
    if (!instance->has_failed && instance->state_count < RG_MAX_STATE)
        instance->state[instance->state_count++] =
            (struct rg_state){name, asset, row, margin, NULL};
}

void rg_assets_free(struct rg_instance *instance)
{
    while (instance->asset_count > 0)
        rg_empty(&instance->assets[--instance->asset_count]);
}
