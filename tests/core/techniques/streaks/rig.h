// For tests of streaks as a whole: a small rain with settings as text, and its pictures.
#ifndef RG_TESTS_CORE_TECHNIQUES_STREAKS_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_STREAKS_RIG_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "core/techniques/streaks/instance.h"

enum { RAIN_WIDTH = 160, RAIN_HEIGHT = 90, RAIN_TEXELS = RAIN_WIDTH * RAIN_HEIGHT };

// The device named on the command line.
extern struct rg_device *rain_device;

// Opens streaks with these "key=value key=value" over those of a small rain in a corner of the
// small city. Fails the test if that fails.
struct streaks *rain_open(const char *settings);
void rain_close(struct streaks *s);
void rain_step(struct streaks *s, int frames);

struct rain_texels {
    uint16_t halves[RAIN_TEXELS * 4];
};

// The particles of a frame with state=on, STREAKS_STATE_WORDS words each. The caller frees the
// words.
struct rain_places {
    int64_t count;
    float *words;
};
struct rain_places rain_read_places(const struct streaks *s);

// Draws this frame. The caller frees it.
struct rain_texels *rain_read(struct streaks *s);
// The picture after so many frames. The caller frees it.
struct rain_texels *rain_draw_at(const char *settings, int frames);
// A texel's red, green or blue (0 to 2).
double rain_texel(const struct rain_texels *picture, int x, int y, int colour);

// Runs tests on the device named by argv[1]. Opens it before them, and closes it after them, which
// must find no leak.
int rain_tests_run(int argc, char **argv, const struct CMUnitTest *tests, int count);

#endif
