// The user's folders for what programs keep, by the XDG base directories:
// https://specifications.freedesktop.org/basedir-spec/latest/
#ifndef RG_CORE_BASE_FILES_USER_H
#define RG_CORE_BASE_FILES_USER_H

#include <stdbool.h>
#include <stddef.h>

enum rg_user_folder {
    RG_USER_CACHE, // what can be made anew: $XDG_CACHE_HOME/raingauge, or ~/.cache/raingauge
    RG_USER_STATE, // what goes on later: $XDG_STATE_HOME/raingauge, or ~/.local/state/raingauge
};

// The path of a name in a folder. False, and `why`, where neither variable names a folder or the
// path does not fit.
bool rg_user_path(enum rg_user_folder folder, const char *name, char *path, size_t size,
                  char why[256]);

// Makes the folders of a path, the last name left out. False, and `why`; where the place takes no
// folders, what is written there later says so.
bool rg_user_make_folders(const char *path, char why[256]);

#endif
