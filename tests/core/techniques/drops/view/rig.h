// For tests of drops' pictures: pictures of an instance, hand-made water, and the oracle fed from
// the device's data.
#ifndef RG_TESTS_CORE_TECHNIQUES_DROPS_VIEW_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_DROPS_VIEW_RIG_H

#include "core/techniques/stages/frame.h"
#include "tests/core/techniques/drops/rig.h"
#include "tests/oracle/drops/pane/pane.h"

// Draws a picture of four channels; the caller destroys it.
struct rg_picture view_draw(struct drops *d);
// A pixel's red, green and blue.
const float *view_pixel(const struct rg_picture *picture, int x, int y);

// Sets the height of every cell from its middle, in mm from the pane's upper left corner.
typedef double (*view_height_fn)(double x_mm, double y_mm, const void *user);
void view_put_heights(struct drops *d, view_height_fn height, const void *user);

// Writes a picture of linear light as an EXR file, dark except for `light`.
typedef void (*view_light_fn)(int x, int y, const void *user, float light[3]);
void view_write(const char *path, int width, int height, view_light_fn light, const void *user);

// An oracle of the instance's picture; free it with view_oracle_free.
struct view_oracle {
    struct pane_oracle pane;
    float *heights, *levels[2 * PANE_LEVELS];
    int level_count;
};
void view_oracle_of(struct drops *d, struct view_oracle *oracle);
void view_oracle_free(struct view_oracle *oracle);

#endif
