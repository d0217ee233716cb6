// Which program this is.
#ifndef RG_HARNESS_RECORD_PASSPORT_PROGRAM_H
#define RG_HARNESS_RECORD_PASSPORT_PROGRAM_H

#include <stdint.h>

enum { RG_PROGRAM_ID_SIZE = 129 };

// The linker's build id, in hexadecimal digits: a hash of the program, so that any change gives
// another one. A commit's name with "-dirty" would stay the same. Where the linker left no build
// id, a hash of its code.
void rg_program_id(char id[RG_PROGRAM_ID_SIZE]);

// A hash of the same of the libraries that are loaded now, drivers among them.
uint64_t rg_libraries_hash(void);

#endif
