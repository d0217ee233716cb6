// Ways in which a driver ends its caller, by name: abort, fault, exit, hang, swell.
#ifndef RG_TESTS_CLI_DRIVERS_WAYS_H
#define RG_TESTS_CLI_DRIVERS_WAYS_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static inline void swell(void)
{
    for (;;) {
        char *more =
            mmap(NULL, 8 << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (more != MAP_FAILED)
            memset(more, 1, 8 << 20);
        usleep(500);
    }
}

static inline void fault(void)
{
    volatile int *volatile nowhere = NULL;
    *nowhere = 1;
}

// RG_HANGS=FILE makes it create a file when it hangs.
static inline void hang(void)
{
    const char *path = getenv("RG_HANGS");
    FILE *file = path ? fopen(path, "w") : NULL;
    if (file)
        fclose(file);
    for (;;)
        pause();
}

// Ends the process in this way; returns if the way is none of these.
static inline void end_as(const char *how)
{
    if (!strcmp(how, "abort"))
        abort();
    if (!strcmp(how, "fault"))
        fault();
    if (!strcmp(how, "exit"))
        _exit(0);
    if (!strcmp(how, "swell"))
        swell();
    if (!strcmp(how, "hang"))
        hang();
}

#endif
