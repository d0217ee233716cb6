// What instances see all around: an environment map, among them the city as seen from a street.
#ifndef RG_CORE_TECHNIQUES_SCENERY_ENVIRONMENT_H
#define RG_CORE_TECHNIQUES_SCENERY_ENVIRONMENT_H

#include "core/scene/environment/environment.h"
#include "core/techniques/stages/instance.h"

// Loads an environment by a name that rg_environment_load takes, or one of these:
//   "city"          the built-in city by day, from the thesis's first camera
//   "city-night"    by night, under its lamps
// These are drawn on `device`, in faces of size_px texels, which should match the resolution of
// their reader; the others have sizes of their own. NULL, and one logged line, on failure. The
// caller destroys it.
struct rg_environment *scenery_environment(const char *name, int size_px, struct rg_device *device);

struct scenery_around {
    const char *name;
    int size_px, levels; // of the image
    double blur_rad;     // the angle of the disc that a lens makes of a point; 0: it is sharp
};

// Adds such an environment as the texture "environment". Instances of a device share its image.
void scenery_add_environment(struct rg_instance *instance, const struct scenery_around *around);

#endif
