// Name patterns with * and ?.
#ifndef RG_HARNESS_COMPARE_GATE_TEXT_GLOB_H
#define RG_HARNESS_COMPARE_GATE_TEXT_GLOB_H

#include <stdbool.h>
#include <stddef.h>

// Whether a pattern matches the whole text: * is any characters, also a slash or none, ? is any
// byte, everything else is itself. The time is at most proportional to the product of both lengths,
// which fnmatch(3) does not promise.
bool rg_glob(const char *pattern, const char *text);
// The same for a pattern of `length` bytes.
bool rg_glob_part(const char *pattern, size_t length, const char *text);

#endif
