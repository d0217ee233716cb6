// File names with a place for a number: "rain-%d.png", or "rain-%04d.png" for at least four digits.
#ifndef RG_HARNESS_RECORD_NUMBERED_H
#define RG_HARNESS_RECORD_NUMBERED_H

#include <stdbool.h>
#include <stddef.h>

// The number of such places in a file's name; those in folders' names do not count.
int rg_numbered_places(const char *path);

// Puts a number of at least 0 into the path's only place. False, and one logged line, if `size` is
// too small.
bool rg_numbered_path(const char *path, int number, char *numbered, size_t size);

#endif
