// Patterns of names as people write them.
#ifndef RG_HARNESS_COMPARE_GATE_TEXT_GLOB_H
#define RG_HARNESS_COMPARE_GATE_TEXT_GLOB_H

#include <stdbool.h>
#include <stddef.h>

// Whether a pattern describes the whole text: * is any characters, also a slash or none, ? is any
// byte, all else is itself. It takes time in proportion to the product of both lengths at most,
// whatever stands in them, which fnmatch(3) does not promise.
bool rg_glob(const char *pattern, const char *text);
// The same of a pattern that has so many bytes.
bool rg_glob_part(const char *pattern, size_t length, const char *text);

#endif
