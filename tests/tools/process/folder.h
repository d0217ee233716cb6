// A folder of a test's or a group's own; make_folder and one of the two that remove it are setup
// and teardown.
#ifndef RG_TESTS_TOOLS_PROCESS_FOLDER_H
#define RG_TESTS_TOOLS_PROCESS_FOLDER_H

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/raingauge-test-XXXXXX";

static inline int make_folder(void **state)
{
    (void)state;
    strcpy(strrchr(folder, '-'), "-XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

// Fails if a file is left in it.
static inline int remove_folder(void **state)
{
    (void)state;
    return rmdir(folder);
}

static inline int folder_remove_one(const char *path, const struct stat *found, int type,
                                    struct FTW *place)
{
    (void)found;
    (void)type;
    (void)place;
    return remove(path);
}

// With all that is in it.
static inline int remove_whole_folder(void **state)
{
    (void)state;
    return nftw(folder, folder_remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

// Valid until the fourth call from now.
static inline const char *in_folder(const char *name)
{
    static char paths[4][256];
    static int next;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof(paths[0]), "%s/%s", folder, name);
    return path;
}

#endif
