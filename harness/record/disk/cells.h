// Checksums of a stored table's cells. A journal has one checksum for its whole content. A table,
// which people keep, merge and shorten, has one for each cell, so that a changed cell can be named.
//
// A cell's checksum covers the cell and the fields before the cells: table, length, settings,
// passport. It excludes fields that are derived when reading, so that a record without them keeps
// its checksums (results/keep.py), and the notation of numbers. The order of fields counts: rows
// begin with their axis, and passes are in the order of running.
#ifndef RG_HARNESS_RECORD_DISK_CELLS_H
#define RG_HARNESS_RECORD_DISK_CELLS_H

#include "harness/record/schema/schema.h"

// Sets the checksum of each cell of a result's document. False when memory runs out.
bool rg_cells_seal(json_t *document);

// Whether in a document accepted by rg_result_from_json every cell has its correct checksum, or
// none has one, as in old documents. If not, `why` names the file, the cell and the mend in one
// line.
bool rg_cells_are_whole(const char *path, const json_t *document, char why[RG_WHY_SIZE]);

#endif
