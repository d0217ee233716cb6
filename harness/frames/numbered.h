// Names of files with the place of a number in them: "rain-%d.png", or "rain-%04d.png" for four
// digits at least.
#ifndef RG_HARNESS_FRAMES_NUMBERED_H
#define RG_HARNESS_FRAMES_NUMBERED_H

#include <stdbool.h>
#include <stddef.h>

// How many such places a file's name has. One in a folder's name is none.
int rg_numbered_places(const char *path);

// The path with a number, not below 0, in its one place. False, and one logged line, where `size`
// is too small.
bool rg_numbered_path(const char *path, int number, char *numbered, size_t size);

#endif
