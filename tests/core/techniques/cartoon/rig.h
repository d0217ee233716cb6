// What cartoon's tests share: an instance with settings as text, and what its images hold.
#ifndef RG_TESTS_CORE_TECHNIQUES_CARTOON_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_CARTOON_RIG_H

#include "core/techniques/cartoon/instance.h"
#include "tests/oracle/cartoon/scene.h"

// Opens cartoon with these "key=value key=value" over its defaults, and draws its first frame;
// fails the test otherwise.
struct cartoon *rig_draw(struct rg_device *device, const char *assignments, int width, int height);
void rig_close(struct cartoon *c);

// All texels of level 0 of an image, four floats each of RGBA16F, one of D32F; the caller frees
// them.
float *rig_texels(struct rg_image *image);
float *rig_asset(struct cartoon *c, const char *name);

// An oracle of the scene as the instance looks at it, which borrows its mesh.
struct scene_oracle rig_oracle(const struct cartoon *c);

// Opens the device that argv names and runs the tests on it, each with the device as *state;
// returns main's status, 77 where there is no such device.
struct CMUnitTest;
int rig_run(int argc, char **argv, const struct CMUnitTest *tests, size_t count);

#endif
