// What an instance works on: buffers and images by name.
#ifndef RG_CORE_TECHNIQUES_STAGES_ASSETS_H
#define RG_CORE_TECHNIQUES_STAGES_ASSETS_H

#include "core/techniques/stages/instance.h"

// Each adds an asset and returns it; it stays where it is for the instance's life. NULL, and one
// logged line unless adding has failed before, on failure. Names are copied.

// A buffer of so many 4-byte words with these contents; zeroes where `words` is NULL. A stage over
// it has `count` items.
struct rg_asset *rg_add_buf(struct rg_instance *instance, const char *name, int64_t count,
                            const void *words);
// A buffer whose contents are undefined until a kernel or the host writes them.
struct rg_asset *rg_add_room(struct rg_instance *instance, const char *name, int64_t count);
// An image of one layer and level, and one of any kind, all zeroes. A stage over it has an item a
// texel of level 0.
struct rg_asset *rg_add_image(struct rg_instance *instance, const char *name, enum rg_format format,
                              int width, int height);
struct rg_asset *rg_add_image_of(struct rg_instance *instance, const char *name,
                                 const struct rg_image_desc *desc);
// Takes over what was made elsewhere; NULL where that failed, which fails adding.
struct rg_asset *rg_give_image(struct rg_instance *instance, const char *name,
                               struct rg_image *image);
// What somebody else owns, who keeps it as long as the instance lives; or another name for an
// asset. NULL instead of an object: it is set later.
struct rg_asset *rg_lend_buf(struct rg_instance *instance, const char *name, struct rg_buf *buf);
struct rg_asset *rg_lend_image(struct rg_instance *instance, const char *name,
                               struct rg_image *image);

// The asset of this name, or NULL.
struct rg_asset *rg_asset_find(struct rg_instance *instance, const char *name);

// What stages over the asset run: other items than its elements.
void rg_set_items(struct rg_asset *asset, int width, int height, int depth);
// Makes a buffer hold at least so many words. Its contents are undefined then. False, with one
// logged line and no buffer, on failure.
bool rg_make_room(struct rg_instance *instance, struct rg_asset *asset, int64_t count);
// Makes an image of this description of it, all zeroes, unless it is one already. False, with one
// logged line and no image, on failure.
bool rg_make_image(struct rg_instance *instance, struct rg_asset *asset,
                   const struct rg_image_desc *desc);
// Destroys what the asset is, which is made anew later.
void rg_empty(struct rg_asset *asset);
// Two assets of one kind and size become each other.
void rg_swap(struct rg_asset *a, struct rg_asset *b);

// Says that a buffer among the assets is part of the simulation's state, which `verify` compares
// (struct rg_state has the arguments).
void rg_add_state(struct rg_instance *instance, struct rg_asset *asset, const char *name, int row,
                  int margin);

// Destroys all assets.
void rg_assets_free(struct rg_instance *instance);

#endif
