// The city as an environment map: what is seen of it from a street, all around.
#ifndef RG_CORE_TECHNIQUES_SCENERY_ENVIRONMENT_H
#define RG_CORE_TECHNIQUES_SCENERY_ENVIRONMENT_H

#include "core/scene/environment/environment.h"

// What rg_environment_load takes, and besides:
//   "city"          the built-in city by day, from the thesis's first camera
//   "city-night"    by night, under its lamps
// These are drawn on `device`, in faces of size_px texels, so that they are as sharp as what reads
// them; the others have sizes of their own. NULL, and one logged line, on failure. The caller
// destroys it.
struct rg_environment *scenery_environment(const char *name, int size_px, struct rg_device *device);

#endif
