// For tests of shower: an instance with settings as text, its particles, and the oracle with the
// same settings.
#ifndef RG_TESTS_CORE_TECHNIQUES_SHOWER_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_SHOWER_RIG_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "core/techniques/shower/instance.h"
#include "tests/oracle/shower.h"

// The device named on the command line.
extern struct rg_device *pour_device;

// Opens shower with these "key=value key=value" over its defaults, without geometry, and with a
// picture of this size. Fails the test otherwise.
struct shower *pour_open(const char *settings, int width, int height);
void pour_close(struct shower *s);
void pour_step(struct shower *s, int steps);

// All particles by slot; an empty slot has fall_m_s 0. The caller frees them.
struct oracle_drop *pour_read(struct shower *s);
// One plane of the attributes; the caller frees it.
float *pour_attributes(struct shower *s, int plane);
// All words of a buffer; the caller frees them.
void *pour_words(struct shower *s, const char *name);
// Puts particles into the first slots and empties the others.
void pour_put(struct shower *s, const struct oracle_drop *drops, int count);
// The last step's addition to a word of the tally.
uint32_t pour_tally(struct shower *s, int word);

// The settings in the oracle's form, with this frame's wind and place.
struct oracle_rain pour_oracle(const struct shower *s);

// One colour, 0 to 2, of the sky in a picture without geometry, and of the light of drops.
double pour_sky(int colour);
double pour_light(const struct shower *s, int colour);

void pour_expect(const char *what, double found, double due, double off);

// Runs tests on the device named by argv[1]. Opens it before them, and closes it after them, which
// must find no leak.
int pour_tests_run(int argc, char **argv, const struct CMUnitTest *tests, int count);

#endif
