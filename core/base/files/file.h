// Files that are read, files that are appended to, and which of two names are one file's.
#ifndef RG_CORE_BASE_FILES_FILE_H
#define RG_CORE_BASE_FILES_FILE_H

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>

// Opens a regular file to read. NULL for all else: a FIFO, a device or a socket would be waited for
// without end, and is not opened, for some devices act as soon as they are. `why` is then what is
// wrong, without the file's name, and errno the system's, or EINVAL where the file is at fault.
FILE *rg_file_open(const char *path, const char **why);

// The same of a text, behind its byte order mark, if it has one.
FILE *rg_file_open_text(const char *path, const char **why);

// The same of what users write by hand. A file of more than 256 KiB is refused as well, so that no
// parser reads one of gigabytes to its end, or keeps many times its size.
FILE *rg_file_open_small(const char *path, const char **why);

// The same to append to, behind all that is there; it is made where it is not. In a folder for all
// one of another user is refused, and a link as below.
FILE *rg_file_append(const char *path, const char **why);

// The path of a file that is to be written, behind the links that `path` ends in, whether or not it
// is there. False, and `why`, where that or its folder is another user's link in a folder to which
// all may write (sticky, as /tmp is) and which is not that user's: whoever put it there would
// choose what is overwritten.
bool rg_file_follow(const char *path, char target[PATH_MAX], const char **why);

// Copies a file from its start to where another stands; errno on failure.
bool rg_file_copy(int from, int to);

// Whether two paths are one file or folder, also one that neither has made yet. A link is what it
// leads to.
bool rg_file_is_same(const char *a, const char *b);
// Whether a file that is written would not replace one that is read; NULL: none is. False, and one
// logged line.
bool rg_file_spares(const char *path, const char *read);

// Whether a path is this folder, or a file that lies in it.
bool rg_file_is_in(const char *path, const char *folder);

#endif
