// Environments out of focus.
#ifndef RG_CORE_SCENE_ENVIRONMENT_BLUR_H
#define RG_CORE_SCENE_ENVIRONMENT_BLUR_H

#include "core/scene/environment/environment.h"

// The light of a disc of this angular diameter around each direction, as a lens out of focus sees
// it. The environment is halved first while the disc stays 8 texels wide or more. The caller
// destroys it. NULL, and one logged line, without memory.
struct rg_environment *rg_environment_blur(const struct rg_environment *environment,
                                           double diameter_rad);

#endif
