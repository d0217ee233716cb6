#include "harness/record/disk/hold.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/files/user.h"

bool rg_hold_folder(const char *folder, struct rg_hold *hold)
{
    *hold = (struct rg_hold){.folder = folder, .made = mkdir(folder, 0777) == 0};
    // Close-on-exec, so that programs that outlive a killed harness hold no lock.
    hold->fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (hold->fd < 0 || flock(hold->fd, LOCK_EX | LOCK_NB) == 0)
        return true;
    const bool is_taken = errno == EWOULDBLOCK;
    close(hold->fd);
    hold->fd = -1;
    return !is_taken;
}

void rg_hold_release(struct rg_hold *hold)
{
    if (hold->made)
        rmdir(hold->folder); // fails if the folder is not empty
    if (hold->fd >= 0)
        close(hold->fd);
    *hold = (struct rg_hold){.fd = -1};
}

void rg_state_folder(char *folder, size_t size)
{
    char why[256]; // writing reports this failure later
    if (!rg_user_path(RG_USER_STATE, "", folder, size, why)) {
        *folder = 0;
        return;
    }
    folder[strlen(folder) - 1] = 0; // its slash, because the writer makes the last folder
    rg_user_make_folders(folder, why);
}
