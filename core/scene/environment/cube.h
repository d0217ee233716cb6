// Cube maps on the host: environments made from any function of direction.
#ifndef RG_CORE_SCENE_ENVIRONMENT_CUBE_H
#define RG_CORE_SCENE_ENVIRONMENT_CUBE_H

#include <stdint.h>

#include "core/scene/environment/environment.h"

// The direction through the centre of a texel of a face; x and y may lie one outside 0..size-1.
void rg_cube_direction(int face, int x, int y, int size, double direction[3]);

// A dark environment of this size; the caller destroys it. NULL, and one logged line, when memory
// runs out; then rg_environment_halve also returns NULL, and rg_environment_pack false.
struct rg_environment *rg_environment_create(int size);
// The red, green and blue of a texel; x and y from -1 to size, including the border.
float *rg_environment_texel(const struct rg_environment *environment, int face, int x, int y);
// Fills the borders from the neighbouring faces.
void rg_environment_close_borders(struct rg_environment *environment);

// Fills an environment from a function of direction (of any length), borders included. Several
// threads call the function at once.
typedef void (*rg_light_fn)(const double direction[3], const void *user, double light[3]);
void rg_environment_fill(struct rg_environment *environment, rg_light_fn fn, const void *user);

// Halves an environment, each texel the mean of four; an odd last row or column is dropped. `size`
// must be at least 2. The caller destroys it.
struct rg_environment *rg_environment_halve(const struct rg_environment *environment);

// Goes on halving until there are less than twice size_px texels along a face: from `*halved`,
// which it replaces, or from the environment itself if `*halved` is NULL, which it stays where
// nothing has to be halved. The caller destroys `*halved`. False, and one logged line, when memory
// runs out.
bool rg_environment_halve_to(const struct rg_environment *environment, int size_px,
                             struct rg_environment **halved);

// Resamples all six faces to size_px^2 texels of RG11B10F each: halves them while they are at least
// twice as large, then interpolates. The outermost texels' centres lie on the cube's edges, so that
// neighbouring faces hold the same light there and filtering within a face shows no seam. The
// format is coarse (6 bits of mantissa), so seeded noise dithers the rounding. Negative light and
// NaN become 0.
bool rg_environment_pack(const struct rg_environment *environment, int size_px, uint32_t *texels);

#endif
