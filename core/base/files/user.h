// The user's folders for files that programs keep, by the XDG base directories:
// https://specifications.freedesktop.org/basedir-spec/latest/
#ifndef RG_CORE_BASE_FILES_USER_H
#define RG_CORE_BASE_FILES_USER_H

#include <stdbool.h>
#include <stddef.h>

enum rg_user_folder {
    RG_USER_CACHE, // can be made anew: $XDG_CACHE_HOME/raingauge, or ~/.cache/raingauge
    RG_USER_STATE, // needed later: $XDG_STATE_HOME/raingauge, or ~/.local/state/raingauge
};

// The path of a name in a folder. False, and `why`, where neither variable names a folder or the
// path does not fit.
bool rg_user_path(enum rg_user_folder folder, const char *name, char *path, size_t size,
                  char why[256]);

// Makes the parent folders of a path. False, and `why`, where that fails; a place that takes no
// folders is reported only when the file is written.
bool rg_user_make_folders(const char *path, char why[256]);

#endif
