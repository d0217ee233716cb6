// Which program this is.
#ifndef RG_HARNESS_RECORD_PASSPORT_PROGRAM_H
#define RG_HARNESS_RECORD_PASSPORT_PROGRAM_H

enum { RG_PROGRAM_ID_SIZE = 129 };

// What the linker made of all that the program was linked from, in hexadecimal digits: equal for
// equal programs, and another after any change, which a commit's name with "-dirty" is not.
// "unknown" where the linker left none.
void rg_program_id(char id[RG_PROGRAM_ID_SIZE]);

#endif
