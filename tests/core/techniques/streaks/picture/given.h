// Inputs of the oracles of rain's pictures: the device's atlas, lights, and the viewer.
#ifndef RG_TESTS_CORE_TECHNIQUES_STREAKS_PICTURE_GIVEN_H
#define RG_TESTS_CORE_TECHNIQUES_STREAKS_PICTURE_GIVEN_H

#include "tests/core/techniques/streaks/rig.h"
#include "tests/oracle/streaks/picture.h"

// The atlas' pictures, whose ends are joined, and its factors; read once.
const struct streak_atlas *given_atlas(void);
void given_atlas_free(void);

// Writes a file of the lights whose bit in `chosen` is set, and their copies to `written`. Returns
// their number.
int given_lights(const char *path, const struct streak_light *lights, int count, int chosen,
                 struct streak_light *written);

// The camera, the fall and the settings, without sky and lights.
struct streak_view given_view(const struct streaks *s);

#endif
