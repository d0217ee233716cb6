// An instance's assets: its buffers and images, by name.
#ifndef RG_CORE_TECHNIQUES_STAGES_ASSETS_H
#define RG_CORE_TECHNIQUES_STAGES_ASSETS_H

#include "core/techniques/stages/instance.h"

// Each function adds an asset and returns it; its address is stable for the instance's life. On
// failure NULL, and one logged line unless adding has failed before. Names are copied.

// Adds a buffer of `count` 4-byte words with these contents, or zeroes where `words` is NULL. A
// stage over it has `count` items.
struct rg_asset *rg_add_buf(struct rg_instance *instance, const char *name, int64_t count,
                            const void *words);
// Adds a buffer whose contents are undefined until a kernel or the host writes them.
struct rg_asset *rg_add_room(struct rg_instance *instance, const char *name, int64_t count);
// Add an image of one layer and level, or of any kind, filled with zeroes. A stage over it has one
// item for each texel of level 0.
struct rg_asset *rg_add_image(struct rg_instance *instance, const char *name, enum rg_format format,
                              int width, int height);
struct rg_asset *rg_add_image_of(struct rg_instance *instance, const char *name,
                                 const struct rg_image_desc *desc);
// Takes ownership of an existing image; NULL, from a failure elsewhere, makes adding fail.
struct rg_asset *rg_give_image(struct rg_instance *instance, const char *name,
                               struct rg_image *image);
// Takes over what rg_shared_get returned, to put it back with the instance; NULL as above.
struct rg_asset *rg_share_image(struct rg_instance *instance, const char *name,
                                struct rg_image *image);
// Adds an object that the caller owns and keeps alive, or another name for an asset. NULL: the
// object is set later.
struct rg_asset *rg_lend_buf(struct rg_instance *instance, const char *name, struct rg_buf *buf);
struct rg_asset *rg_lend_image(struct rg_instance *instance, const char *name,
                               struct rg_image *image);

// The asset of this name, or NULL.
struct rg_asset *rg_asset_find(struct rg_instance *instance, const char *name);

// Sets the items of stages over the asset, instead of one for each element.
void rg_set_items(struct rg_asset *asset, int width, int height, int depth);
// Ensures that a buffer holds at least this many words, and makes its contents undefined. False,
// with one logged line and no buffer, on failure.
bool rg_make_room(struct rg_instance *instance, struct rg_asset *asset, int64_t count);
// Makes the asset an image of this description, all zeroes, unless it already is one. False, with
// one logged line and no image, on failure.
bool rg_make_image(struct rg_instance *instance, struct rg_asset *asset,
                   const struct rg_image_desc *desc);
// Destroys the asset's object, to be made anew later.
void rg_empty(struct rg_asset *asset);
// Swaps two assets of one kind and size.
void rg_swap(struct rg_asset *a, struct rg_asset *b);

// Says that a buffer among the assets is part of the simulation's state, which `verify` compares
// (struct rg_state has the arguments).
void rg_add_state(struct rg_instance *instance, struct rg_asset *asset, const char *name, int row,
                  int margin);

// Destroys all assets.
void rg_assets_free(struct rg_instance *instance);

#endif
