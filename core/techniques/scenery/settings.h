// Selects the scene to draw.
#ifndef RG_CORE_TECHNIQUES_SCENERY_SETTINGS_H
#define RG_CORE_TECHNIQUES_SCENERY_SETTINGS_H

#include "core/scene/city/city.h"
#include "core/techniques/params.h"

struct scenery_settings {
    struct city_settings city;
    char model[RG_PATH_SIZE]; // a user's mesh, as rg_mesh_load takes it; "": the city
    bool bare;                // it is never lit, so that the parts for its light are not made
};

// The settings for a user's choice: "city", with this size and seed, or a mesh. `scene` holds up to
// RG_PATH_SIZE characters.
struct scenery_settings scenery_named(const char *scene, enum city_size size, int seed);

#endif
