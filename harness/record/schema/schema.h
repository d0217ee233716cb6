// The schema of results and records, version 1 (docs/records.md). Only this pair of functions
// writes and reads it. `table --json`, `table -o` and journals give the same document.
#ifndef RG_HARNESS_RECORD_SCHEMA_SCHEMA_H
#define RG_HARNESS_RECORD_SCHEMA_SCHEMA_H

#include "harness/record/result.h"

enum { RG_FORMAT_VERSION = 1, RG_WHY_SIZE = 512 };

// The document of a result, which the caller owns; and jansson's flags for writing its numbers.
json_t *rg_result_json(const struct rg_result *result);
#define RG_JSON_FLAGS JSON_REAL_PRECISION(RG_NUMBER_DIGITS)

// Fills a zeroed result from a document. Fields that are derived from others are computed anew, not
// read; fields outside the schema are skipped. False if the document is damaged or no result: `why`
// names the file, the place and the mend in one line, and the result is zeroed.
bool rg_result_from_json(const json_t *document, const char *file, struct rg_result *result,
                         char why[RG_WHY_SIZE]);

#endif
