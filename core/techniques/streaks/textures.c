#include "core/techniques/streaks/textures.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/device/shared.h"
#include "core/techniques/streaks/far/join.h"
#include "core/techniques/streaks/far/means.h"

// --- upload ---

static bool write_joined(struct rg_image *image, const struct rg_atlas *atlas,
                         enum rg_atlas_part part, int layer, int level)
{
    uint16_t *texels = streaks_joined(atlas, part, layer, level);
    const bool ok = texels && rg_image_write(image, layer, level, texels);
    free(texels);
    return ok;
}

static bool write_layer(struct rg_image *image, const struct rg_atlas *atlas,
                        enum rg_atlas_part part, int layer, int level)
{
    const bool cells = part != RG_ATLAS_SPLASH && atlas->first_level + level < RG_ATLAS_CELL_LEVELS;
    return cells ? write_joined(image, atlas, part, layer, level)
                 : rg_image_write(image, layer, level, rg_atlas_texels(atlas, part, layer, level));
}

static bool write_level(struct rg_image *image, const struct rg_atlas *atlas,
                        enum rg_atlas_part part, int level)
{
    bool ok = true;
    for (int layer = 0; ok && layer < image->desc.layers; layer++)
        ok = write_layer(image, atlas, part, layer, level);
    return ok;
}

// The levels that a native device is given first; its driver makes the others. The thesis takes
// four of each streak from the database, and has the other eight generated (section 4.3.1).
static int given_levels(const struct rg_atlas *atlas, enum rg_atlas_part part)
{
    const int given = RG_ATLAS_DATABASE_LEVELS - atlas->first_level;
    return part == RG_ATLAS_SPLASH || given < 1 ? 1 : given;
}

// Whether a texel of a level has four above it, whose mean every driver makes. Elsewhere the APIs
// leave the filter open: a blit from three texels to one takes the middle one, in which a splash is
// brighter than in the mean.
static bool halves(const struct rg_image_desc *desc, int level)
{
    return rg_level_size(desc->width, level - 1) == 2 * rg_level_size(desc->width, level) &&
           rg_level_size(desc->height, level - 1) == 2 * rg_level_size(desc->height, level);
}

static bool write_levels(struct rg_image *image, const struct rg_atlas *atlas,
                         enum rg_atlas_part part)
{
    const struct rg_image_desc *desc = &image->desc;
    const bool makes = rg_image_makes_levels(image);
    const int given = makes ? given_levels(atlas, part) : desc->levels;
    bool ok = true;
    for (int level = 0; ok && level < given; level++)
        ok = write_level(image, atlas, part, level);
    ok = ok && (!makes || rg_image_make_levels(image, given));
    for (int level = given; ok && level < desc->levels; level++)
        ok = halves(desc, level) || write_level(image, atlas, part, level);
    return ok;
}

static struct rg_image *upload(struct rg_device *device, const struct rg_atlas *atlas,
                               enum rg_atlas_part part, const char *name)
{
    const struct rg_atlas_image *from = &atlas->images[part];
    const struct rg_image_desc desc = {RG_R16F, from->width, from->height, from->layers,
                                       from->levels};
    struct rg_image *image = rg_image_create(device, &desc, name);
    if (image && write_levels(image, atlas, part))
        return image;
    rg_image_destroy(image);
    return NULL;
}

static struct rg_buf *upload_factors(struct rg_device *device, const struct rg_atlas *atlas)
{
    const int64_t points = sizeof(atlas->point_factor), skies = sizeof(atlas->env_factor);
    const int64_t splashes = sizeof(atlas->splash_part);
    struct rg_buf *buf = rg_buf_create(device, points + skies + splashes, "brightness factors");
    if (buf && rg_buf_write(buf, 0, atlas->point_factor, points) &&
        rg_buf_write(buf, points, atlas->env_factor, skies) &&
        rg_buf_write(buf, points + skies, atlas->splash_part, splashes))
        return buf;
    rg_buf_destroy(buf);
    return NULL;
}

static void destroy(void *thing)
{
    struct streaks_textures *t = thing;
    rg_image_destroy(t->points);
    rg_image_destroy(t->skies);
    rg_image_destroy(t->crowns);
    rg_buf_destroy(t->factors);
    rg_buf_destroy(t->means);
    free(t);
}

static bool fill(struct streaks_textures *t, struct rg_device *device, const struct rg_atlas *atlas)
{
    t->first_level = atlas->first_level;
    t->hash = atlas->hash;
    return (t->points = upload(device, atlas, RG_ATLAS_POINT, "point atlases")) &&
           (t->skies = upload(device, atlas, RG_ATLAS_ENV, "environment atlases")) &&
           (t->crowns = upload(device, atlas, RG_ATLAS_SPLASH, "splashes")) &&
           (t->factors = upload_factors(device, atlas)) &&
           (t->means = streaks_far_means(device, atlas));
}

static void *make(struct rg_device *device, const void *arg)
{
    struct streaks_textures *t = rg_alloc(1, sizeof(*t), "streak textures");
    struct rg_atlas *atlas = t ? rg_atlas_load(*(const enum rg_atlas_size *)arg, NULL) : NULL;
    const bool ok = atlas && fill(t, device, atlas);
    rg_atlas_destroy(atlas);
    if (ok || !t)
        return t;
    destroy(t);
    return NULL;
}

static const struct rg_shared_kind kind = {
    .name = "streak textures", .make = make, .destroy = destroy};

struct streaks_textures *streaks_textures_get(struct rg_device *device, enum rg_atlas_size size)
{
    char key[16];
    snprintf(key, sizeof(key), "%d", (int)size);
    return rg_shared_get(device, key, &kind, &size);
}

void streaks_textures_put(struct rg_device *device, struct streaks_textures *textures)
{
    rg_shared_put(device, textures);
}
