// Reports on a compared pair of pictures: for people, for machines, and as heat maps.
#ifndef RG_HARNESS_COMPARE_DIFF_PAIR_H
#define RG_HARNESS_COMPARE_DIFF_PAIR_H

#include <jansson.h>
#include <stdbool.h>

#include "core/image/compare/compare.h"

// Prints all figures of a pair to stdout.
void rg_pair_print(const char *a, const char *b, const struct rg_comparison *comparison);

// The same as JSON (docs/records.md); the caller owns it. NULL, and one logged line, when a name is
// not UTF-8.
json_t *rg_pair_json(const char *a, const char *b, const struct rg_comparison *comparison);
// Prints the format number, the devices with pictures, their files, pairs, and devices without
// pictures; takes ownership of `devices`. `devices` and `pictures` are NULL for files. False, and
// one logged line, on failure.
bool rg_pairs_print_json(json_t *devices, json_t *pictures, json_t *pairs, json_t *failures);

// Checks before any work that heat maps of this many pixels together can be written there; a NULL
// prefix means none. False, and one logged line, if not.
bool rg_pair_heatmaps_can_be_written(const char *prefix, int64_t pixels);
// Whether no heat map would replace the file `read`, which may be NULL. False, and one logged line,
// if one would.
bool rg_pair_heatmaps_spare(const char *prefix, const char *read);
// Whether a prefix is a folder, so that file names follow it without a dash: it ends with a slash.
bool rg_is_folder_prefix(const char *prefix);
// Writes PREFIX-flip.png and PREFIX-difference.png, or FOLDER/flip.png and FOLDER/difference.png.
// False, and one logged line, on failure.
bool rg_pair_heatmaps(const char *prefix, const struct rg_picture *a, const struct rg_picture *b,
                      const struct rg_comparison *comparison);

#endif
