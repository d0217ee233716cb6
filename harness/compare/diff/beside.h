// Compares the extras of two picture files.
#ifndef RG_HARNESS_COMPARE_DIFF_BESIDE_H
#define RG_HARNESS_COMPARE_DIFF_BESIDE_H

#include <jansson.h>
#include <stdbool.h>

#include "core/image/compare/compare.h"

struct rg_difference {
    char what[200], a[250], b[250]; // "channel Z", and its value in each file or "none"
};

// Zeroed: nothing differs. The caller frees `items`.
struct rg_beside {
    struct rg_difference *items;
    int64_t count, room;
    bool is_short; // memory ran out
};

// Call it before the pictures are converted to one shape. False, and one logged line, when memory
// runs out. Extras that both files share, but that are not applied, get one warning, which calls
// the files `name_a` and `name_b`.
bool rg_beside_find(const struct rg_picture *a, const char *name_a, const struct rg_picture *b,
                    const char *name_b, struct rg_beside *beside);

// Makes every tier fail if something differs.
void rg_beside_judge(const struct rg_beside *beside, struct rg_comparison *comparison);

// Print differences for people, to stdout, and return them for machines as JSON, which the caller
// owns.
void rg_beside_print(const struct rg_beside *beside);
json_t *rg_beside_json(const struct rg_beside *beside);

#endif
