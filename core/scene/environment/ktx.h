// KTX 1 cube maps, as far as Debian's open3d-gui-data needs them.
#ifndef RG_CORE_SCENE_ENVIRONMENT_KTX_H
#define RG_CORE_SCENE_ENVIRONMENT_KTX_H

#include "core/scene/environment/environment.h"

// Reads level 0 of a cube map in R11F_G11F_B10F, with borders. NULL, and one logged line that names
// the file and what is wrong with it, on failure.
struct rg_environment *rg_ktx_read(const char *path);

#endif
