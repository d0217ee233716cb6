// Linear values of pictures that are compared, around the texels that differ most.
#ifndef RG_HARNESS_REPORT_PICTURES_LINEAR_H
#define RG_HARNESS_REPORT_PICTURES_LINEAR_H

#include <jansson.h>

#include "core/image/picture.h"

enum { RG_LINEAR_PICTURES = 16, RG_LINEAR_WORST = 3, RG_LINEAR_SIDE = 33 };

// Pictures of one frame, each by who drew it. Zero it at first; rg_linear_free in any case.
struct rg_linear {
    const char *names[RG_LINEAR_PICTURES]; // not owned
    struct rg_picture pictures[RG_LINEAR_PICTURES];
    int count;
};

// At most three texels that differ most, none in another's surroundings, as {channels, differing,
// worst, pictures}. `differing` is how many texels differ in all. `worst` are {x, y, left, top,
// width, height}: the texel, and its surroundings of at most 33 x 33 texels. `pictures` are {name,
// values}: for each of the worst a text of values with nine digits, row by row, parted by spaces;
// `=` is the first picture's value. The caller owns it. NULL if nothing differs, if pictures have
// other sizes or channels, or without memory.
json_t *rg_linear_json(const struct rg_linear *linear);
void rg_linear_free(struct rg_linear *linear);

#endif
