#include "core/techniques/streaks/textures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/device/shared.h"
#include "core/scene/atlas/levels.h"
#include "core/scene/atlas/optics/drop.h"
#include "kernels/streaks/cells.h"

// --- pictures without ends ---

// A view's rows in a level of a layer: `pitch` texels each.
struct strip {
    const uint16_t *rows;
    int count, pitch;
    double way; // of the drop, in rows
};

static double texel_of(const struct strip *strip, int row, int column)
{
    return row >= 0 && row < strip->count
               ? (double)rg_half_value(strip->rows[row * strip->pitch + column])
               : 0;
}

// The mean over a row that begins at `row`, which need not be whole.
static double mean_of(const struct strip *strip, double row, int column)
{
    const int whole = (int)floor(row);
    const double part = row - whole;
    return (1 - part) * texel_of(strip, whole, column) + part * texel_of(strip, whole + 1, column);
}

// A drop swings one whole time on its way. What it covers at the way's end, before the exposure
// ends, is added to what it covers at the beginning, and the other way round: the picture then goes
// on beyond both ends as it would in a longer exposure.
static void join_ends(const struct strip *strip, uint16_t *rows)
{
    const int ends = (int)ceil(strip->count - strip->way);
    for (int row = 0; row < strip->count; row++) {
        if (row >= ends && row < strip->count - ends)
            continue;
        const double other = row < strip->count / 2 ? row + strip->way : row - strip->way;
        for (int column = 0; column < strip->pitch; column++)
            rows[row * strip->pitch + column] =
                rg_half_of((float)(texel_of(strip, row, column) + mean_of(strip, other, column)));
    }
}

// A level of a layer, the pictures of all its views joined. The caller frees it.
static uint16_t *joined(const struct rg_atlas *atlas, enum rg_atlas_part part, int layer, int own)
{
    const struct rg_atlas_image *image = &atlas->images[part];
    const int level = atlas->first_level + own, pitch = image->width >> own;
    const uint16_t *texels = rg_atlas_texels(atlas, part, layer, own);
    const size_t count = (size_t)pitch * (size_t)(image->height >> own);
    uint16_t *to = rg_alloc(count, sizeof(*to), "pictures of streaks");
    if (!to)
        return NULL;
    memcpy(to, texels, count * sizeof(*to));
    for (int view = 0; view < RG_ATLAS_VIEWS; view++) {
        const int start = rg_atlas_row_start(view, level), rows = rg_atlas_row_height(view, level);
        const double way_px = RG_DROP_FALL * (double)RG_ATLAS_DROP_PX * cos(view * 20 * M_PI / 180);
        const struct strip strip = {texels + start * pitch, rows, pitch,
                                    way_px * rows / rg_atlas_row_height(view, 0)};
        join_ends(&strip, to + start * pitch);
    }
    return to;
}

static bool write_joined(struct rg_image *image, const struct rg_atlas *atlas,
                         enum rg_atlas_part part, int layer, int level)
{
    uint16_t *texels = joined(atlas, part, layer, level);
    const bool ok = texels && rg_image_write(image, layer, level, texels);
    free(texels);
    return ok;
}

// --- upload ---

static bool write_level(struct rg_image *image, const struct rg_atlas *atlas,
                        enum rg_atlas_part part, int layer, int level)
{
    const bool cells = part != RG_ATLAS_SPLASH && atlas->first_level + level < RG_ATLAS_CELL_LEVELS;
    return cells ? write_joined(image, atlas, part, layer, level)
                 : rg_image_write(image, layer, level, rg_atlas_texels(atlas, part, layer, level));
}

static struct rg_image *upload(struct rg_device *device, const struct rg_atlas *atlas,
                               enum rg_atlas_part part, const char *name)
{
    const struct rg_atlas_image *from = &atlas->images[part];
    const struct rg_image_desc desc = {RG_R16F, from->width, from->height, from->layers,
                                       from->levels};
    struct rg_image *image = rg_image_create(device, &desc, name);
    for (int layer = 0; image && layer < from->layers; layer++)
        for (int level = 0; image && level < from->levels; level++)
            if (!write_level(image, atlas, part, layer, level)) {
                rg_image_destroy(image);
                image = NULL;
            }
    return image;
}

static struct rg_buf *upload_factors(struct rg_device *device, const struct rg_atlas *atlas)
{
    const int64_t points = sizeof(atlas->point_factor), skies = sizeof(atlas->env_factor);
    struct rg_buf *buf = rg_buf_create(device, points + skies, "brightness factors");
    if (buf && rg_buf_write(buf, 0, atlas->point_factor, points) &&
        rg_buf_write(buf, points, atlas->env_factor, skies))
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
    free(t);
}

static bool fill(struct streaks_textures *t, struct rg_device *device, const struct rg_atlas *atlas)
{
    t->first_level = atlas->first_level;
    t->hash = atlas->hash;
    return (t->points = upload(device, atlas, RG_ATLAS_POINT, "point atlases")) &&
           (t->skies = upload(device, atlas, RG_ATLAS_ENV, "environment atlases")) &&
           (t->crowns = upload(device, atlas, RG_ATLAS_SPLASH, "splashes")) &&
           (t->factors = upload_factors(device, atlas));
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
