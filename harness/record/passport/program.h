// Identifies this program.
#ifndef RG_HARNESS_RECORD_PASSPORT_PROGRAM_H
#define RG_HARNESS_RECORD_PASSPORT_PROGRAM_H

#include <stdint.h>

#include "backends/library.h"

// Its build id. A commit's name with "-dirty" would not change with the program.
void rg_program_id(char id[RG_BUILD_ID_SIZE]);

// A hash of the build ids of all loaded libraries, including drivers.
uint64_t rg_libraries_hash(void);

#endif
