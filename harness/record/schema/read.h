// The two halves of reading a result's document: rg_result_from_json (schema.h) calls both. False,
// and the reader's line, if the document is no result.
#ifndef RG_HARNESS_RECORD_SCHEMA_READ_H
#define RG_HARNESS_RECORD_SCHEMA_READ_H

#include "harness/record/schema/fields.h"
#include "harness/record/result.h"

bool rg_read_head(struct rg_reader *reader, const json_t *document, struct rg_result *result);
// Reads all cells of the rows that the document has.
bool rg_read_cells(struct rg_reader *reader, const json_t *document, struct rg_result *result);

#endif
