// Locks a folder for one command's results and journals. Two measurements at once would replace
// each other's journal, and could mix a table's files.
#ifndef RG_HARNESS_RECORD_DISK_HOLD_H
#define RG_HARNESS_RECORD_DISK_HOLD_H

#include <stdbool.h>
#include <stddef.h>

struct rg_hold {
    const char *folder;
    int fd;    // -1: no lock
    bool made; // the folder was made by this hold
};

// Locks a folder until it is released or this process ends in any way; the lock needs no file. The
// last part of its path is made if missing. `folder` must outlive the hold. False when another
// process has the lock. Returns true without a lock if the file system supports none, or if the
// folder cannot be made or opened, which writing will report.
bool rg_hold_folder(const char *folder, struct rg_hold *hold);
// Releases the lock, and removes the folder if it was made by the hold and is empty.
void rg_hold_release(struct rg_hold *hold);

// The user's folder for interrupted work (core/base/files/user.h); "" if no variable names one. Its
// parents are made; the writer makes the folder itself.
void rg_state_folder(char *folder, size_t size);

#endif
