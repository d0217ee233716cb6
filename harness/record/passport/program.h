// Which program this is.
#ifndef RG_HARNESS_RECORD_PASSPORT_PROGRAM_H
#define RG_HARNESS_RECORD_PASSPORT_PROGRAM_H

#include <stdint.h>

#include "backends/library.h"

// Its build id. A commit's name with "-dirty" would stay the same where the program changes.
void rg_program_id(char id[RG_BUILD_ID_SIZE]);

// A hash of the same of the libraries that are loaded now, drivers among them.
uint64_t rg_libraries_hash(void);

#endif
