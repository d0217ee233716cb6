// The streak atlas: pictures of an oscillating, falling drop in an exposure of 1/60 s under a light
// from any direction (Garg and Nayar, 2006), packed as by Creus (2010, section 4.3.1), and the
// animation of a splash. docs/atlas.md explains the model and the lookup.
//
// Three images, each an array of layers with mip levels, of half floats (R16F):
//
//   point   10 layers, one for each oscillation: a row of cells for each view angle, with 90
//           cells of 32 columns in each, one for each direction of light.
//   env     10 layers, the same with one cell in a row: light of radiance 1 from everywhere.
//   splash  84 layers: 4 materials of 21 frames, 48 x 32.
//
// A cell is normalised to a largest value of 1 in level 0. Its meaning is texel * factor:
//
//   point   radiance, in the mean over the exposure, for light that brings an irradiance of 1 to
//           a surface facing it (1/sr)
//   env     the same for radiance 1 from everywhere: the share of the exposure for which the drop
//           covers the pixel, and so the opacity with which a streak hides what is behind it
//   splash  the share of a pixel's light that water brings there from above the horizon: its
//           radiance under a sky of 1. A light that brings an irradiance of 1 shows with this
//           times splash_part, in 1/sr, by its direction
//
// Angles, in degrees, about a drop that falls along -y: a view at azimuth 0 and elevation 20 *
// view; a light at elevation -90 + 20 * light and azimuth 10 + 20 * phi, counted from the viewer
// towards the viewer's right. A light on the left is the mirror image, u -> 1 - u. Seen from below,
// view and light change the signs of both elevations.
#ifndef RG_CORE_SCENE_ATLAS_ATLAS_H
#define RG_CORE_SCENE_ATLAS_ATLAS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/scene/atlas/optics/drop.h"

enum {
    RG_ATLAS_OSCILLATIONS = 10,
    RG_ATLAS_VIEWS = 5,
    RG_ATLAS_LIGHTS = 10, // elevations
    RG_ATLAS_PHIS = 9,    // azimuths
    RG_ATLAS_CELLS = RG_ATLAS_LIGHTS * RG_ATLAS_PHIS,
    RG_ATLAS_CELL_PX = 32,        // a cell's width in level 0
    RG_ATLAS_HEIGHT_PX = 3606,    // of all five rows in level 0
    RG_ATLAS_CELL_LEVELS = 6,     // levels 0 to 5 have separate texels for each cell
    RG_ATLAS_DATABASE_LEVELS = 4, // the database has the widths of levels 0 to 3
    RG_ATLAS_MATERIALS = 4, // a thin film of water, a puddle, dry asphalt, smooth metal or glass
    RG_ATLAS_FRAMES = 21,
    RG_ATLAS_MAX_LEVELS = 12,
};

// The first texel of each view's row of cells in level 0 of the full size, and the end of the last.
#define RG_ATLAS_ROWS 0, 1050, 2038, 2848, 3392, 3606

// The size of a cell's billboard: 32 / RG_ATLAS_DROP_PX diameters of the drop across, and (height
// of the cell in level 0 of the full size) / RG_ATLAS_DROP_PX diameters along. The drop is at the
// image's upper end when the exposure begins, and at its lower end when it ends.
#define RG_ATLAS_DROP_PX 23.744f
#define RG_ATLAS_DROP_MM 3.2f

enum rg_atlas_size {
    RG_ATLAS_FULL,       // 2880 x 3606, 12 levels; 280 MB; drops swing as the database's
    RG_ATLAS_SMALL,      // levels 2 to 11 of such an atlas, traced coarsely: 720 x 901; 18 MB
    RG_ATLAS_CAVE,       // full and small, packed from the original database by
    RG_ATLAS_CAVE_SMALL, // `raingauge atlas --from DIR`
    RG_ATLAS_MEASURED,   // as full and small, of drops that swing as was measured
    RG_ATLAS_MEASURED_SMALL,
    RG_ATLAS_SIZE_COUNT
};

enum rg_atlas_part { RG_ATLAS_POINT, RG_ATLAS_ENV, RG_ATLAS_SPLASH, RG_ATLAS_PART_COUNT };

// One array image. Its texels are ordered by layer, level, row.
struct rg_atlas_image {
    int width, height, layers, levels;
    uint16_t *texels;
};

struct rg_atlas {
    enum rg_atlas_size size;
    int first_level; // the level of the full size that is level 0 here: 0, or 2 when small
    struct rg_atlas_image images[RG_ATLAS_PART_COUNT];
    float point_factor[RG_ATLAS_OSCILLATIONS][RG_ATLAS_VIEWS][RG_ATLAS_LIGHTS][RG_ATLAS_PHIS];
    float env_factor[RG_ATLAS_OSCILLATIONS][RG_ATLAS_VIEWS];
    float splash_part[RG_ATLAS_MATERIALS][RG_ATLAS_LIGHTS][RG_ATLAS_PHIS];
    uint64_t
        hash; // XXH3 of the factors, then the texels of the three images, as little-endian bytes
};

// How drops swing, and the resolution at which a streak is traced.
struct rg_streak_detail {
    enum rg_swings swings;
    int moments; // parts of the exposure: the drop's image fades from one end to the other
    int column;  // rays across a column of the picture
    int along;   // rows of rays along the diameter of the drop at rest, seen from the front; from
                 // above up to half as many more, because the fall blurs these less
};

// What sizes differ in.
struct rg_atlas_kind {
    const char *name;
    bool is_small;                  // a quarter of the full one each way
    bool is_packed;                 // of the original database, not traced
    enum rg_atlas_size measured;    // the same of drops that swing as was measured; packed: itself
    struct rg_streak_detail detail; // of a traced one: neither steps nor noise are visible but
                                    // those of the database's own pictures
};
extern const struct rg_atlas_kind rg_atlas_kinds[RG_ATLAS_SIZE_COUNT];

// A listener for progress: `done` of `total` units, which take about equally long. It is called by
// one thread at a time.
struct rg_atlas_progress {
    void (*tell)(void *user, int done, int total);
    void *user;
};

// The atlas of a size, from the user's cache. If it is missing or damaged there, it is made and
// stored (core/scene/atlas/cache.h); a cache that cannot be used costs a warning. An atlas of the
// original database is never made, so it must be there. `progress` may be NULL. NULL, and one
// logged line, on failure. The caller destroys it.
struct rg_atlas *rg_atlas_load(enum rg_atlas_size size, const struct rg_atlas_progress *progress);

// Traces an atlas without the cache, in parallel: a full one in a minute of one core, a small one
// in eight seconds. Its bits depend neither on the number of threads nor on the processor's
// vectors. `size` is one that is traced.
struct rg_atlas *rg_atlas_make(enum rg_atlas_size size, const struct rg_atlas_progress *progress);
void rg_atlas_destroy(struct rg_atlas *atlas);

// One level of one layer, as rg_image_write takes it.
const uint16_t *rg_atlas_texels(const struct rg_atlas *atlas, enum rg_atlas_part part, int layer,
                                int level);

// The row of a view in a level of the full size: its first texel is RG_ATLAS_ROWS[view] >> level,
// and it ends where the next begins. A level of the small size is two levels further down. The
// columns of a cell begin at cell * (32 >> level). Both hold for the levels before
// RG_ATLAS_CELL_LEVELS, where a sampler that stays inside a cell never reads another; smaller
// levels mix neighbours.
int rg_atlas_row_start(int view, int level);
int rg_atlas_row_height(int view, int level);

#endif
