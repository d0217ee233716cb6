// What shower's tests share: an instance with settings as text, its particles, and the oracle's
// view of the same settings.
#ifndef RG_TESTS_CORE_TECHNIQUES_SHOWER_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_SHOWER_RIG_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "core/techniques/shower/instance.h"
#include "tests/oracle/shower.h"

// The device that the program was called with.
extern struct rg_device *pour_device;

// Opens shower with these "key=value key=value" over its defaults without geometry, and a picture
// of this size; fails the test otherwise.
struct shower *pour_open(const char *settings, int width, int height);
void pour_close(struct shower *s);
void pour_step(struct shower *s, int steps);

// All particles, by slot, for the caller to free; a slot without one has fall_m_s 0.
struct oracle_drop *pour_read(struct shower *s);
// One plane of the attributes, for the caller to free.
float *pour_attributes(struct shower *s, int plane);
// All words of a buffer, for the caller to free.
void *pour_words(struct shower *s, const char *name);
// Puts particles into the first slots; the others have none.
void pour_put(struct shower *s, const struct oracle_drop *drops, int count);
// What the last step added to a word of the tally.
uint32_t pour_tally(struct shower *s, int word);

// The settings as the oracle has them, with the wind and the place of the present frame.
struct oracle_rain pour_oracle(const struct shower *s);

// The sky of a picture without geometry, and the light of drops, of one colour, 0 to 2.
double pour_sky(int colour);
double pour_light(const struct shower *s, int colour);

void pour_expect(const char *what, double found, double due, double off);

// Runs tests on the device that argv[1] names, which is opened before them and closed behind them
// without a leak.
int pour_tests_run(int argc, char **argv, const struct CMUnitTest *tests, int count);

#endif
