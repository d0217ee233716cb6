// Bounds of draws of fixed functions: for each value of a picture the least and the greatest that
// the specifications leave to a device, from the draw's geometry and texels alone.
//
//   struct rg_fixed_bounds *bounds = rg_fixed_bounds_make(&state, &precision);
//   struct rg_fixed_beyond beyond;
//   const bool within = bounds && rg_fixed_bounds_hold(bounds, bytes, size, &beyond);
//   rg_fixed_bounds_free(bounds);
#ifndef RG_SHADERS_FIXED_BOUNDS_BOUNDS_H
#define RG_SHADERS_FIXED_BOUNDS_BOUNDS_H

#include "shaders/fixed/bounds/span.h"
#include "shaders/fixed/fixed.h"

// The sections of the specifications that bound a draw of this feature, for people; NULL: none
// does, and the feature has closed cases alone. Sections have the same names in OpenGL 4.6 and
// Vulkan 1.3 if only one is given.
const char *rg_fixed_sections(const char *feature);

// The least that Vulkan demands, with its standard places of samples.
extern const struct rg_fixed_precision rg_fixed_precision_least;

enum rg_fixed_numbers {
    RG_FIXED_CODES_8,
    RG_FIXED_CODES_16,
    RG_FIXED_HALVES,
    RG_FIXED_FLOATS,
    RG_FIXED_TENS,    // 10, 10, 10 and 2 bits
    RG_FIXED_ELEVENS, // floats of 11, 11 and 10 bits
    RG_FIXED_COUNTS_32,
    RG_FIXED_COUNTS_64,
};

// A part of a picture. Normalized values count as codes.
struct rg_fixed_bounds_part {
    const char *name; // "colour 0"
    enum rg_fixed_numbers numbers;
    int width, height, layers, channels;
    struct rg_span *values; // [layer][y][x][channel]
};

// Colours, depth, stencil, stores, counts, caught vertices and queries.
enum { RG_FIXED_BOUNDS_PARTS = RG_FIXED_EQUATIONS + 2 + RG_FIXED_STORES + 3 };
struct rg_fixed_bounds {
    int count;
    struct rg_fixed_bounds_part parts[RG_FIXED_BOUNDS_PARTS];
};

// NULL, and one logged line, without memory.
struct rg_fixed_bounds *rg_fixed_bounds_make(const struct rg_fixed_state *state,
                                             const struct rg_fixed_precision *precision);
void rg_fixed_bounds_free(struct rg_fixed_bounds *bounds);

// The largest number that is told: no number and infinity are told as this.
#define RG_FIXED_BEYOND_MOST 1e18

// The first value beyond its bounds, and how many there are.
struct rg_fixed_beyond {
    int count;
    char part[16];
    int layer, x, y, channel;
    double value, low, high;
};

// Whether all values of a picture's bytes lie within the bounds. A picture of another size does
// not: it has one value beyond, which is its size.
bool rg_fixed_bounds_hold(const struct rg_fixed_bounds *bounds, const void *bytes, size_t size,
                          struct rg_fixed_beyond *beyond);

// Why a driver is known to leave these values of a draw beyond their bounds, by a fault of its own;
// NULL: it is not.
const char *rg_fixed_known_fault(const char *feature, const char *device,
                                 const struct rg_fixed_beyond *beyond);

enum { RG_FIXED_BEYOND_TEXT = 200 };
// One line: "colour 0 at x 3, y 4, layer 0, channel 1 is 17, not from 20 to 24, and 5 more".
void rg_fixed_beyond_tell(const struct rg_fixed_beyond *beyond, char text[RG_FIXED_BEYOND_TEXT]);

#endif
