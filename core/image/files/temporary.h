// The file that a result is written to before it is whole.
//
// It has no name while it is written, where the file system knows such files: whatever ends the
// program leaves nothing behind. Where it has one, the signals that end the program remove it
// (core/base/program.h): a temporary stays where it is in memory until it ends. A link is followed,
// as a shell's redirection does, and what stands there read-only is refused. What replaces a file
// has its mode, and until then is read by nobody else.
#ifndef RG_CORE_IMAGE_FILES_TEMPORARY_H
#define RG_CORE_IMAGE_FILES_TEMPORARY_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#include "core/image/files/why.h"

struct rg_temporary {
    char path[PATH_MAX];   // to write it by
    char target[PATH_MAX]; // where it goes
    int fd;                // the same file
    mode_t mode;           // of the file that it replaces, its type included; 0: there is none
    bool is_named;
};

// Makes an empty file for `path`. False, and `why` is set, where `path` cannot be written.
bool rg_temporary_make(const char *path, struct rg_temporary *temporary, struct rg_why *why);

// Puts it in place where it has been `written`, and drops it otherwise. False where what was there
// is untouched; `why` is set where it could not be put in place.
bool rg_temporary_end(struct rg_temporary *temporary, bool written, struct rg_why *why);

// Makes one and drops it: whether `path` can be written is known before any work.
bool rg_temporary_try(const char *path, struct rg_why *why);

#endif
