// A table with each device beside print: its columns and cells, in the room that there is.
#ifndef RG_HARNESS_TABLES_SHEET_BESIDE_H
#define RG_HARNESS_TABLES_SHEET_BESIDE_H

#include <stdbool.h>

#include "harness/console/sheet.h"
#include "harness/record/result.h"

// How a cell tells its noise: "451 [430, 472]", "451 +-9%" or "451~".
enum rg_beside_marks { RG_BESIDE_INTERVALS, RG_BESIDE_TEXTS, RG_BESIDE_LETTERS };

// What a line holds.
struct rg_beside_layout {
    int optional; // columns after print: the share of particles drawn, error, packed, shaded
    enum rg_beside_marks marks;
    bool lacks_reference, lacks_times; // without cpu:reference, without the ratios to print
};

// Of the first row that was measured; NULL: there is none.
const struct rg_record *rg_beside_first(const struct rg_result *result, struct rg_place of);
// Makes the sheet of a work and a variant; the caller frees it. Memory that runs out is told by
// sheet->incomplete.
void rg_beside_make(const struct rg_result *result, struct rg_place of,
                    const struct rg_beside_layout *layout, struct rg_sheet *sheet);
// The same with the layout that holds most in `width` columns, which is returned. Pages wider than
// RG_PAGE_WIDTH have intervals; pages as wide as that are files and lack no device.
struct rg_beside_layout rg_beside_fit(const struct rg_result *result, struct rg_place of, int width,
                                      struct rg_sheet *sheet);

#endif
