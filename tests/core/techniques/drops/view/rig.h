// What the tests of drops' pictures share: pictures of an instance, waters made by hand, and the
// oracle fed with what the device holds.
#ifndef RG_TESTS_CORE_TECHNIQUES_DROPS_VIEW_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_DROPS_VIEW_RIG_H

#include "core/techniques/stages/frame.h"
#include "tests/core/techniques/drops/rig.h"
#include "tests/oracle/drops/pane/pane.h"

// Draws; the caller destroys the picture, of four channels.
struct rg_picture view_draw(struct drops *d);
// A pixel's red, green and blue.
const float *view_pixel(const struct rg_picture *picture, int x, int y);

// Sets the height of every cell by its middle, in mm from the pane's upper left corner.
typedef double (*view_height_fn)(double x_mm, double y_mm, const void *user);
void view_put_heights(struct drops *d, view_height_fn height, const void *user);

// Writes a picture of linear light as an EXR file, dark but for what `light` says.
typedef void (*view_light_fn)(int x, int y, const void *user, float light[3]);
void view_write(const char *path, int width, int height, view_light_fn light, const void *user);

// An oracle of what the instance shows; free it with view_oracle_free.
struct view_oracle {
    struct pane_oracle pane;
    float *heights, *levels[2 * PANE_LEVELS];
    int level_count;
};
void view_oracle_of(struct drops *d, struct view_oracle *oracle);
void view_oracle_free(struct view_oracle *oracle);

#endif
