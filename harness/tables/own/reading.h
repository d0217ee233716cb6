// A table's file while it is read.
#ifndef RG_HARNESS_TABLES_OWN_READING_H
#define RG_HARNESS_TABLES_OWN_READING_H

#include "core/base/files/lines.h"
#include "core/techniques/technique.h"
#include "harness/tables/claims/claim.h"
#include "harness/tables/papers/published.h"
#include "harness/tables/own/grid.h"

enum { RG_OWN_CLAIMS = 32 };

struct rg_own {
    struct rg_lines lines; // whose words all texts of the table are
    const struct rg_technique *technique;
    void *defaults; // its settings
    struct rg_grid grid;
    struct rg_table table;
    char columns[RG_TABLE_VARIANTS][RG_AXIS_NAME + 4]; // of frame rates: "fps_NAME"
    const char *printed[RG_TABLE_VALUES];              // names of columns after the keys
    double values[RG_TABLE_ROWS][RG_TABLE_VALUES];     // of these
    int variant_count, printed_count, claim_count;
    struct rg_claim claims[RG_OWN_CLAIMS];
};

// The number of rows that the lines so far make.
int rg_own_rows(const struct rg_own *own);
// Whether the table times a variant of this name.
bool rg_own_has_variant(const struct rg_own *own, const char *name);
// Cuts the text at a bar. Returns what is behind it, or NULL without one.
char *rg_own_behind(char *text);
// Cuts "key=value" off *rest into its two parts. False at the end, and, with one logged line, for a
// word without a sign.
bool rg_own_pair(char **rest, char **key, char **value);
// Reads a number. False, and one logged line, for anything else.
bool rg_own_number(const char *key, const char *text, double *number);

// Whether the technique accepts assignments. False, and one logged line, if not.
bool rg_own_accepts(const struct rg_own *own, const char *assignments);

// Take "KEY=VALUE,VALUE", and "KEY=VALUE... [| PRINTED=NUMBER...]". False, and one logged line, if
// it is refused.
bool rg_own_take_axis(struct rg_own *own, char *text);
bool rg_own_take_row(struct rg_own *own, char *text);

// Takes "TEST [KEY=VALUE]... | WORDS" as a claim. False, and one logged line, if it is refused.
bool rg_own_take_claim(struct rg_own *own, char *text);

#endif
