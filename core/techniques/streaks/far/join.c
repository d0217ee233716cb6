#include "core/techniques/streaks/far/join.h"

#include <math.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/scene/atlas/levels.h"
#include "core/scene/atlas/optics/drop.h"

// A view's rows in a level of a layer: `pitch` texels each.
struct strip {
    const uint16_t *rows;
    int count, pitch;
    double way; // distance that the drop falls, in rows
};

static double texel_of(const struct strip *strip, int row, int column)
{
    return row >= 0 && row < strip->count
               ? (double)rg_half_value(strip->rows[row * strip->pitch + column])
               : 0;
}

// The mean over a row's height that begins at `row`, which may be fractional.
static double mean_of(const struct strip *strip, double row, int column)
{
    const int whole = (int)floor(row);
    const double part = row - whole;
    return (1 - part) * texel_of(strip, whole, column) + part * texel_of(strip, whole + 1, column);
}

// A drop completes one oscillation on its way. Its coverage at the end of the way is added to that
// at the beginning, and vice versa. So the picture continues beyond both ends as in a longer
// exposure.
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

uint16_t *streaks_joined(const struct rg_atlas *atlas, enum rg_atlas_part part, int layer, int own)
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
