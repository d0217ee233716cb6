// What two picture files hold besides the texels that are compared: whether that differs.
#ifndef RG_HARNESS_COMPARE_DIFF_BESIDE_H
#define RG_HARNESS_COMPARE_DIFF_BESIDE_H

#include <jansson.h>
#include <stdbool.h>

#include "core/image/compare/compare.h"

struct rg_difference {
    char what[200], a[250], b[250]; // "channel Z", and what each file has of it or "none"
};

// Zeroed: nothing differs. The caller frees `items`.
struct rg_beside {
    struct rg_difference *items;
    int64_t count, room;
    bool is_short; // of memory
};

// Before the pictures are made alike. False, and one logged line, without memory. What both files
// have alike, and nobody applies, is one warning, which calls them `name_a` and `name_b`.
bool rg_beside_find(const struct rg_picture *a, const char *name_a, const struct rg_picture *b,
                    const char *name_b, struct rg_beside *beside);

// Has every tier fail if something differs.
void rg_beside_judge(const struct rg_beside *beside, struct rg_comparison *comparison);

// For people, to stdout, and for machines, where the caller owns it.
void rg_beside_print(const struct rg_beside *beside);
json_t *rg_beside_json(const struct rg_beside *beside);

#endif
