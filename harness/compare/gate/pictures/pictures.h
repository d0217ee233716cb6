// Writes the pictures of a cell that differ, as files that a report names.
#ifndef RG_HARNESS_COMPARE_GATE_PICTURES_PICTURES_H
#define RG_HARNESS_COMPARE_GATE_PICTURES_PICTURES_H

#include <limits.h>

#include "core/image/compare/compare.h"

// A cell's pictures: A's, B's, a map of visible differences (FLIP), and a map of their size.
enum { RG_GATE_PICTURES = 4 };

// The path of one picture, FOLDER/NAME_HASH-a.png. NAME is the case's name, reduced to characters
// that file systems and report formats accept; the hash is of the whole name.
void rg_gate_picture_path(const char *folder, const char *name, int picture, char path[PATH_MAX]);

// Checks before any work that pictures of so many pixels can be written there. False, and one
// logged line, if not.
bool rg_gate_pictures_can_be_written(const char *folder, int64_t pixels);

// Writes all of them, and A's and B's linear light as NAME_HASH-a.exr and -b.exr; creates the
// folder if only its last part is missing. False, and one logged line, if one cannot be written.
bool rg_gate_pictures_write(const char *folder, const char *name, const struct rg_picture *a,
                            const struct rg_picture *b, const struct rg_comparison *comparison);

#endif
