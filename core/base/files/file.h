// Files that are read, and files that are appended to.
#ifndef RG_CORE_BASE_FILES_FILE_H
#define RG_CORE_BASE_FILES_FILE_H

#include <stdio.h>

// Opens a regular file to read. NULL for all else: a FIFO, a device or a socket would be waited for
// without end. `why` is then what is wrong, without the file's name.
FILE *rg_file_open(const char *path, const char **why);

// The same to append to, behind all that is there; it is made where it is not.
FILE *rg_file_append(const char *path, const char **why);

#endif
