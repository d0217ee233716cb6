// The comparison key of a device: a hash of everything that its speed depends on, so that only
// comparable times are compared. docs/records.md lists its parts.
//
// All parts stay the same between runs on one machine: no current clock rate, no load, no list of
// cores, no path and no commit.
#ifndef RG_HARNESS_RECORD_PASSPORT_KEY_H
#define RG_HARNESS_RECORD_PASSPORT_KEY_H

#include <jansson.h>
#include <stdbool.h>

enum { RG_KEY_SIZE = 17, RG_KEY_TEXT = 1024 };

// The parts as texts by name, from a passport and one of its devices (rg_passport_device); the
// caller releases it.
json_t *rg_key_parts(const json_t *passport, const json_t *device);

// The hash of the parts, in 16 hexadecimal digits; "" when memory runs out.
void rg_key_hash(const json_t *parts, char key[RG_KEY_SIZE]);
// Whether a text is such a hash.
bool rg_key_is(const char *text);

// "cores 2 and not 4; driver Mesa 22.3.6 and not Mesa 23.1.0": the parts that differ between now
// and then. "" if none does.
void rg_key_difference(const json_t *now, const json_t *then, char text[RG_KEY_TEXT]);

// Likewise the libraries of two passports that raingauge computes with (docs/records.schema.json):
// "glibc 2.41 and not 2.36". "" also if a passport has none, being an earlier program's. They are
// no part of a key.
void rg_key_libraries(const json_t *now, const json_t *then, char text[RG_KEY_TEXT]);

// "cores 2; driver Mesa 22.3.6": all parts.
void rg_key_text(const json_t *parts, char text[RG_KEY_TEXT]);

#endif
