// A measured row as the journal holds it.
#ifndef RG_HARNESS_RECORD_ROWS_H
#define RG_HARNESS_RECORD_ROWS_H

#include "harness/tables/table.h"

// The caller owns it.
json_t *rg_journal_row_json(const struct rg_table_run *run, int row);
// Sets a row's cells and groups, whose names are then the JSON's: it must live as long as they.
// False when it is no such row.
bool rg_journal_row_read(const json_t *json, struct rg_table_run *run, int row);

#endif
