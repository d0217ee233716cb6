// Which scene is drawn.
#ifndef RG_CORE_TECHNIQUES_SCENERY_SETTINGS_H
#define RG_CORE_TECHNIQUES_SCENERY_SETTINGS_H

#include "core/scene/city/city.h"
#include "core/techniques/params.h"

struct scenery_settings {
    struct city_settings city;
    char model[RG_PATH_SIZE]; // a user's mesh instead, as rg_mesh_load takes it; "": the city
};

// The settings that users name: "city", of this size and seed, or a mesh. `scene` is RG_PATH_SIZE
// characters long.
struct scenery_settings scenery_named(const char *scene, enum city_size size, int seed);

#endif
