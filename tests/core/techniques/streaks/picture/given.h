// What the oracles of rain's pictures are given: the atlas as it is on the device, lights, and who
// looks.
#ifndef RG_TESTS_CORE_TECHNIQUES_STREAKS_PICTURE_GIVEN_H
#define RG_TESTS_CORE_TECHNIQUES_STREAKS_PICTURE_GIVEN_H

#include "tests/core/techniques/streaks/rig.h"
#include "tests/oracle/streaks/picture.h"

// Its pictures, the ends of each joined, and the factors. Read once.
const struct streak_atlas *given_atlas(void);
void given_atlas_free(void);

// Writes those of the lights whose bit in `chosen` is set as a file of lights, and their copies to
// `written`. How many they are.
int given_lights(const char *path, const struct streak_light *lights, int count, int chosen,
                 struct streak_light *written);

// The camera, the fall and the settings; no sky and no lights.
struct streak_view given_view(const struct streaks *s);

#endif
