// For cartoon's tests: an instance with settings as text, and the contents of its images.
#ifndef RG_TESTS_CORE_TECHNIQUES_CARTOON_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_CARTOON_RIG_H

#include "core/techniques/cartoon/instance.h"
#include "tests/oracle/cartoon/scene.h"

// Opens cartoon with these "key=value key=value" over its defaults, and draws its first frame.
// Fails the test if either fails.
struct cartoon *rig_draw(struct rg_device *device, const char *assignments, int width, int height);
void rig_close(struct cartoon *c);

// All texels of an image's level 0: four floats each for RGBA16F, one for D32F. The caller frees
// them.
float *rig_texels(struct rg_image *image);
float *rig_asset(struct cartoon *c, const char *name);

// An oracle of the scene in the instance's view; it borrows the instance's mesh.
struct scene_oracle rig_oracle(const struct cartoon *c);

// Opens the device named in argv and runs the tests on it, each with the device as *state. Returns
// main's status: 77 if there is no such device.
struct CMUnitTest;
int rig_run(int argc, char **argv, const struct CMUnitTest *tests, size_t count);

#endif
