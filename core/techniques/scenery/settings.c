#include "core/techniques/scenery/settings.h"

#include <string.h>

struct scenery_settings scenery_named(const char *scene, enum city_size size, int seed)
{
    struct scenery_settings settings = {.city = {.seed = seed, .size = size}};
    if (strcmp(scene, "city") != 0)
        memcpy(settings.model, scene, sizeof(settings.model));
    return settings;
}
