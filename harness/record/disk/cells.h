// The checksums of a stored table's cells. A journal has one checksum of all that it holds; a table
// that people keep, merge and shorten has one of each cell, so that what was changed can be named.
//
// A cell's checksum is of the cell and of what stands before the cells: table, length, settings,
// passport. It is not of what follows from other fields and is made anew when it is read, so that a
// record which leaves these out keeps it (results/keep.py); nor of how a number is written. The
// order of fields counts: rows have their axis first, and passes stand as they run.
#ifndef RG_HARNESS_RECORD_DISK_CELLS_H
#define RG_HARNESS_RECORD_DISK_CELLS_H

#include "harness/record/schema/schema.h"

// Sets the checksum of each cell of a result's document. False without memory.
bool rg_cells_seal(json_t *document);

// Whether each cell of a document that rg_result_from_json takes has its checksum, or none has:
// before there were any, none did. Else `why` names the file, the cell and the mend in one line.
bool rg_cells_are_whole(const char *path, const json_t *document, char why[RG_WHY_SIZE]);

#endif
