#include "harness/devices/workers/held.h"

#include <stdio.h>
#include <unistd.h>

int64_t rg_held_bytes(pid_t process)
{
    char path[64];
    long long all, resident = 0;
    snprintf(path, sizeof(path), "/proc/%ld/statm", (long)process);
    FILE *file = fopen(path, "r");
    if (file && fscanf(file, "%lld %lld", &all, &resident) != 2)
        resident = 0;
    if (file)
        fclose(file);
    return resident * sysconf(_SC_PAGESIZE);
}
