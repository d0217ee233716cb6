// The file to which a result is written before it is complete.
//
// It has no name while it is written, where the file system supports that, so that nothing is left
// behind however the program ends. A named one is removed by the signals that end the program
// (core/base/program.h), so that the struct must not move in memory until it ends. Links are
// followed, as a shell's redirection does, and a read-only target is refused. A file that replaces
// another gets that one's mode, and until then only the user can read it.
#ifndef RG_CORE_IMAGE_FILES_TEMPORARY_H
#define RG_CORE_IMAGE_FILES_TEMPORARY_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#include "core/image/files/why.h"

struct rg_temporary {
    char path[PATH_MAX];   // the path to write to
    char target[PATH_MAX]; // the path that it will get
    int fd;                // a descriptor of the same file
    mode_t mode;           // mode of the file to be replaced, including its type; 0: none
    bool is_named;
};

// Makes an empty file for `path`. False, and `why` is set, where `path` cannot be written.
bool rg_temporary_make(const char *path, struct rg_temporary *temporary, struct rg_why *why);

// Moves the file into place if it is `written`, else drops it. False where the target is unchanged;
// `why` is set where moving it failed.
bool rg_temporary_end(struct rg_temporary *temporary, bool written, struct rg_why *why);

// Makes a temporary file and drops it, to learn before any work whether `path` can be written.
bool rg_temporary_try(const char *path, struct rg_why *why);

#endif
