#include "harness/console/started.h"

#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "harness/console/clock.h"

// The place of the start time in /proc/self/stat, counted from the process's name. It is in ticks
// of a clock that goes on while the machine sleeps.
enum { START_FIELD = 20 };

static double start_ticks(void)
{
    char text[1024];
    FILE *file = fopen("/proc/self/stat", "r");
    const size_t size = file ? fread(text, 1, sizeof(text) - 1, file) : 0;
    double ticks = 0;
    if (file)
        fclose(file);
    text[size] = 0;
    char *at = strrchr(text, ')'); // the name may hold anything
    for (int field = 0; at && field < START_FIELD; field++)
        at = strchr(at + 1, ' ');
    return at && sscanf(at, "%lf", &ticks) == 1 ? ticks : 0;
}

double rg_started_ms(void)
{
    struct timespec now;
    const double ticks = start_ticks();
    clock_gettime(CLOCK_BOOTTIME, &now);
    const double age_ms = ((double)now.tv_sec - ticks / (double)sysconf(_SC_CLK_TCK)) * 1e3 +
                          (double)now.tv_nsec * 1e-6;
    return rg_now_ms() - (ticks > 0 && age_ms > 0 ? age_ms : 0);
}
