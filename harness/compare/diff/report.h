// What is said of a pair of pictures that were compared: for people, for machines, and as heat
// maps.
#ifndef RG_HARNESS_COMPARE_DIFF_REPORT_H
#define RG_HARNESS_COMPARE_DIFF_REPORT_H

#include <jansson.h>
#include <stdbool.h>

#include "core/image/compare/compare.h"

// Every figure of a pair, to stdout.
void rg_pair_print(const char *a, const char *b, const struct rg_comparison *comparison);

// The same for machines (docs/records.md); the caller owns it. NULL, and one logged
// line, when a name is not UTF-8.
json_t *rg_pair_json(const char *a, const char *b, const struct rg_comparison *comparison);
// Prints an array of pairs, and one of devices that gave no picture, with their format number, and
// the devices that gave one, which it takes over; NULL: they are files. False, and one logged line,
// on failure.
bool rg_pairs_print_json(json_t *devices, json_t *pairs, json_t *failures);

// Whether heat maps of so many pixels together can be written there, as is found out before any
// work; a prefix of NULL asks for none. False, and one logged line.
bool rg_pair_heatmaps_can_be_written(const char *prefix, int64_t pixels);
// Whether none of them would replace a file that is read; NULL: none is. False, and one logged
// line.
bool rg_pair_heatmaps_spare(const char *prefix, const char *read);
// Whether names that begin so lie in a folder, and need nothing between: it ends with a slash.
bool rg_is_folder_prefix(const char *prefix);
// Writes PREFIX-flip.png and PREFIX-difference.png, or FOLDER/flip.png and FOLDER/difference.png.
// False, and one logged line, on failure.
bool rg_pair_heatmaps(const char *prefix, const struct rg_picture *a, const struct rg_picture *b,
                      const struct rg_comparison *comparison);

#endif
