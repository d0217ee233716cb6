// Opening files for reading and appending, and telling whether two names are one file.
#ifndef RG_CORE_BASE_FILES_FILE_H
#define RG_CORE_BASE_FILES_FILE_H

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>

// Opens a regular file to read. NULL for all else: a FIFO, a device or a socket would be waited for
// without end, and is not opened, for some devices act as soon as they are. `why` is then what is
// wrong, without the file's name, and errno the system's, or EINVAL where the file is at fault.
FILE *rg_file_open(const char *path, const char **why);

// The same for a text; reading starts after its byte order mark, if it has one.
FILE *rg_file_open_text(const char *path, const char **why);

// The same for files that users write by hand: one of more than 256 KiB is refused, so that no
// parser reads gigabytes or keeps many times their size.
FILE *rg_file_open_small(const char *path, const char **why);

// Opens a file to append to, and makes it if it is missing. In a shared folder, another user's file
// and links as described below are refused.
FILE *rg_file_append(const char *path, const char **why);

// The path of a file to write, after following the links that `path` ends in, whether or not the
// file exists. False, and `why`, if the path or its folder is another user's link in a folder that
// all may write to (sticky, as /tmp is) and that is not that user's. The owner of such a link would
// choose which file is overwritten.
bool rg_file_follow(const char *path, char target[PATH_MAX], const char **why);

// Copies a file from its start to the other's current offset. False, with errno set, on failure.
bool rg_file_copy(int from, int to);

// Whether two paths name the same file or folder, even one that does not exist yet. Links are
// followed.
bool rg_file_is_same(const char *a, const char *b);
// Whether writing `path` leaves the file `read` intact; `read` may be NULL. False, with one logged
// line, if it would replace it.
bool rg_file_spares(const char *path, const char *read);

// Whether a path is this folder or lies directly in it.
bool rg_file_is_in(const char *path, const char *folder);

#endif
