// Files that are read.
#ifndef RG_CORE_BASE_FILES_FILE_H
#define RG_CORE_BASE_FILES_FILE_H

#include <stdio.h>

// Opens a regular file to read. NULL for all else: a FIFO, a device or a socket would be waited for
// without end. `why` is then what is wrong, without the file's name.
FILE *rg_file_open(const char *path, const char **why);

#endif
