// A folder of a group's own; make_folder and remove_folder are setup and teardown. Each test
// removes the files that it writes there.
#ifndef RG_TESTS_CORE_FOLDER_H
#define RG_TESTS_CORE_FOLDER_H

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static char folder[] = "/tmp/raingauge-test-XXXXXX";

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return rmdir(folder);
}

// Valid until the next call.
static const char *in_folder(const char *name)
{
    static char path[256];
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    return path;
}

#endif
