// THE schema of results and records, version 1 (docs/records.md): this pair of functions writes and
// reads it, and nothing else does. What `table --json` prints, what `table -o` writes and what a
// journal holds are the same document.
#ifndef RG_HARNESS_RECORD_SCHEMA_SCHEMA_H
#define RG_HARNESS_RECORD_SCHEMA_SCHEMA_H

#include "harness/record/result.h"

enum { RG_FORMAT_VERSION = 1, RG_WHY_SIZE = 512 };

// The document of a result; the caller owns it. jansson's flags that numbers are written with.
json_t *rg_result_json(const struct rg_result *result);
#define RG_JSON_FLAGS JSON_REAL_PRECISION(RG_NUMBER_DIGITS)

// Fills a zeroed result from a document. What is derived from other fields in it is not read but
// made anew, and fields that are not of the schema are skipped. False where it is damaged or no
// result: `why` names the file, the place and the mend in one line, and the result is zeroed.
bool rg_result_from_json(const json_t *document, const char *file, struct rg_result *result,
                         char why[RG_WHY_SIZE]);

#endif
