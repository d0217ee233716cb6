// A street in the rain, as an environment: computed, so that every machine has the same.
#ifndef RG_CORE_SCENE_ENVIRONMENT_STREET_H
#define RG_CORE_SCENE_ENVIRONMENT_STREET_H

#include "core/scene/environment/environment.h"

enum street_time { STREET_DAY, STREET_NIGHT };

// What someone sees who stands in the middle of a wet street, at this many texels along a face. It
// takes sums, products, quotients and roots of doubles alone, which are the same everywhere. The
// caller destroys it. NULL, and one logged line, when memory runs out.
struct rg_environment *rg_street(enum street_time time, int size);

#endif
