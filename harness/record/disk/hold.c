#include "harness/record/disk/hold.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

bool rg_hold_folder(const char *folder, struct rg_hold *hold)
{
    *hold = (struct rg_hold){.folder = folder, .made = mkdir(folder, 0777) == 0};
    // No program that is started inherits it: what outlives a harness that is killed holds nothing.
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
        rmdir(hold->folder); // refused where something lies in it
    if (hold->fd >= 0)
        close(hold->fd);
    *hold = (struct rg_hold){.fd = -1};
}

// Makes the folders that a folder lies in. What fails here is told by the writing that follows.
static void make_parents(char *folder)
{
    for (char *end = strchr(folder + 1, '/'); end; end = strchr(end + 1, '/')) {
        *end = 0;
        mkdir(folder, 0777);
        *end = '/';
    }
}

void rg_state_folder(char *folder, size_t size)
{
    const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
    int length = 0;
    *folder = 0;
    if (state && *state == '/')
        length = snprintf(folder, size, "%s/raingauge", state);
    else if (home && *home == '/')
        length = snprintf(folder, size, "%s/.local/state/raingauge", home);
    if (length >= (int)size)
        *folder = 0;
    if (*folder)
        make_parents(folder);
}
