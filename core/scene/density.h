// Density maps: the amount of rain at each place, as an artist draws it (Creus, section 4.2).
//
// A map lies over a rectangle; its density, 0 to 1, is constant over each texel. A summed-area
// table holds it, so that the rain over any rectangle takes 16 entries however large it is, and is
// exactly 0 where the map is black.
#ifndef RG_CORE_SCENE_DENSITY_H
#define RG_CORE_SCENE_DENSITY_H

#include <stdint.h>

#include "core/image/picture.h"

// The largest map; it takes 8 bytes for each texel, so 512 MiB.
#define RG_DENSITY_MAX_TEXELS ((int64_t)1 << 26)

struct rg_density {
    int width, height; // texels; row 0 is the image's top
    double unit;       // the density that a weight of 1 stands for
    double *sums; // (width + 1) x (height + 1): sums of the weights of all texels above and left of
                  // each corner
};

// The built-in map, Creus's figure 4.1(b): 1 in the middle, 0 at the rim, which touches the sides,
// and 0 in the corners. NULL, with one logged line, when memory runs out.
struct rg_density *rg_density_gradient(void);

// Reads any picture. Integer codes are densities, code / 255 or code / 65535, without a curve;
// floats are divided by the largest of them. Colours become their luminance; transparent texels
// count as black. NULL, and one logged line, if the file cannot be read, a value is negative,
// infinite or NaN, or all are zero.
struct rg_density *rg_density_read(const char *path);
// The same for a picture in memory, which stays the caller's; `name` is for messages.
struct rg_density *rg_density_from_picture(const struct rg_picture *picture, const char *name);
// Accepts NULL.
void rg_density_destroy(struct rg_density *density);

// The density of a texel.
double rg_density_at(const struct rg_density *density, int column, int row);

// The density summed over a rectangle of the map, 0 <= left <= right <= width and so on, all in
// texels: the average density times the rectangle's area in texels.
double rg_density_mass(const struct rg_density *density, double left, double top, double right,
                       double bottom);

// The average of the whole map.
double rg_density_mean(const struct rg_density *density);

#endif
