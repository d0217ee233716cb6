// The pictures of a cell that differ, as files that a report names.
#ifndef RG_HARNESS_COMPARE_GATE_PICTURES_PICTURES_H
#define RG_HARNESS_COMPARE_GATE_PICTURES_PICTURES_H

#include <limits.h>

#include "core/image/compare/compare.h"

// What is written of a cell: A's picture and B's, where one would see that they differ (FLIP), and
// by how much they do.
enum { RG_GATE_PICTURES = 4 };

// The path of one of them, FOLDER/NAME_HASH-a.png, where NAME is that of the case, in letters that
// every file system and every mark of a report takes, and the hash is of all of it.
void rg_gate_picture_path(const char *folder, const char *name, int picture, char path[PATH_MAX]);

// Whether pictures of so many pixels can be written there, as is found out before any work. False,
// and one logged line.
bool rg_gate_pictures_can_be_written(const char *folder, int64_t pixels);

// Writes all of them; the folder is made where only its last part is missing. False, and one logged
// line, where one cannot be written.
bool rg_gate_pictures_write(const char *folder, const char *name, const struct rg_picture *a,
                            const struct rg_picture *b, const struct rg_comparison *comparison);

#endif
