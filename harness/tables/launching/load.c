#include "harness/tables/launching/load.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

// Ticks by which the kernel's counts may be off between two readings.
enum { ROUNDING = 2 };

static double tick_s(void)
{
    return 1.0 / (double)sysconf(_SC_CLK_TCK);
}

static double seconds_of(clockid_t clock)
{
    struct timespec time;
    return clock_gettime(clock, &time) ? 0 : (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void read_machine(struct rg_load *load)
{
    enum { USER, NICE, SYSTEM, IDLE, WAIT, IRQ, SOFT_IRQ, STEAL, FIELDS };
    unsigned long long v[FIELDS];
    FILE *file = fopen("/proc/stat", "r");
    if (file && fscanf(file, "cpu %llu %llu %llu %llu %llu %llu %llu %llu", &v[USER], &v[NICE],
                       &v[SYSTEM], &v[IDLE], &v[WAIT], &v[IRQ], &v[SOFT_IRQ], &v[STEAL]) == FIELDS)
        for (int i = 0; i < FIELDS; i++) {
            load->all += (double)v[i] * tick_s();
            load->busy += i == IDLE || i == WAIT || i == STEAL ? 0 : (double)v[i] * tick_s();
            load->stolen += i == STEAL ? (double)v[i] * tick_s() : 0;
        }
    if (file)
        fclose(file);
}

// Adds a thread's time on a processor, and the time that it was ready to run without one.
static void add_thread(pid_t process, const char *thread, struct rg_load *load)
{
    unsigned long long ran_ns, waited_ns;
    char path[64];
    snprintf(path, sizeof(path), "/proc/%d/task/%.16s/schedstat", (int)process, thread);
    FILE *file = fopen(path, "r");
    if (file && fscanf(file, "%llu %llu", &ran_ns, &waited_ns) == 2) {
        load->ran += 1e-9 * (double)ran_ns;
        load->waited += 1e-9 * (double)waited_ns;
    }
    if (file)
        fclose(file);
}

static void read_threads(pid_t process, struct rg_load *load)
{
    char path[64];
    snprintf(path, sizeof(path), "/proc/%d/task", (int)process);
    DIR *folder = opendir(path);
    for (const struct dirent *entry; folder && (entry = readdir(folder));)
        if (*entry->d_name != '.')
            add_thread(process, entry->d_name, load);
    if (folder)
        closedir(folder);
}

struct rg_load rg_load_now(pid_t worker)
{
    struct rg_load load = {.own = seconds_of(CLOCK_PROCESS_CPUTIME_ID)};
    clockid_t clock;
    if (worker && !clock_getcpuclockid(worker, &clock))
        load.own += seconds_of(clock);
    read_machine(&load);
    read_threads(worker ? worker : getpid(), &load);
    return load;
}

void rg_load_shares(const struct rg_load *before, const struct rg_load *now, double *stolen,
                    double *others)
{
    const double all = now->all - before->all, ran = now->ran - before->ran;
    const double waited = fmax(now->waited - before->waited, 0);
    const double taken = now->busy - before->busy - (now->own - before->own) - ROUNDING * tick_s();
    *stolen = all > 0 ? fmax(now->stolen - before->stolen, 0) / all : 0;
    *others = all > 0 ? fmax(taken, 0) / all : 0;
    if (ran + waited >
        0) // a kernel without statistics of threads leaves the other processes' share
        *others = fmin(*others, waited / (ran + waited));
}
