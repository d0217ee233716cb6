// A folder that one command at a time writes its results and journals into. Two that measure at
// once would replace each other's journal, and may leave a table's files of one beside those of
// the other.
#ifndef RG_HARNESS_RECORD_DISK_HOLD_H
#define RG_HARNESS_RECORD_DISK_HOLD_H

#include <stdbool.h>
#include <stddef.h>

struct rg_hold {
    const char *folder;
    int fd;    // -1: nothing is held
    bool made; // the folder was not there before
};

// Holds a folder until it is released or this process ends, in whatever way; nothing is left on
// the disk. Its last part is made where it is missing. `folder` must outlive the hold. False when
// another process holds it. Where the file system knows no locks, or the folder cannot be made or
// opened, which the writing will tell, nothing is held and true returned.
bool rg_hold_folder(const char *folder, struct rg_hold *hold);
// Removes the folder if it was made and has stayed empty.
void rg_hold_release(struct rg_hold *hold);

// The user's folder for what goes on later (core/base/files/user.h); "" where no variable names
// one. The folders that it lies in are made; itself is made by who writes there.
void rg_state_folder(char *folder, size_t size);

#endif
