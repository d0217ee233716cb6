// Environments out of focus.
#ifndef RG_CORE_SCENE_ENVIRONMENT_BLUR_H
#define RG_CORE_SCENE_ENVIRONMENT_BLUR_H

#include "core/scene/environment/environment.h"

// Averages the light over a disc of this angular diameter around each direction, as an unfocused
// lens does. The environment is first halved while the disc stays at least 8 texels wide. The
// caller destroys the result. NULL, and one logged line, when memory runs out.
struct rg_environment *rg_environment_blur(const struct rg_environment *environment,
                                           double diameter_rad);

#endif
