// Files without a name: they vanish with the last process that has them open.
#ifndef RG_CORE_BASE_FILES_NAMELESS_H
#define RG_CORE_BASE_FILES_NAMELESS_H

#include <stddef.h>

enum { RG_NAMELESS_WHY = 200 };

// Makes an empty file to read, write and map, which is closed by exec. It is in memory, or, if the
// system refuses that, in a folder for temporary files. Returns -1 if neither works; `why` is then
// a sentence with the mend, and errno is that of the folder's file.
int rg_file_nameless(char why[RG_NAMELESS_WHY]);

#endif
