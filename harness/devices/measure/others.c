#define _GNU_SOURCE // sched_getaffinity
#include "harness/devices/measure/others.h"

#include <dirent.h>
#include <math.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/record/record.h"

// The fields of a line "cpu0 ..." of /proc/stat, in ticks: see proc_stat(5).
enum { USER, NICE, SYSTEM, IDLE, IOWAIT, IRQ, SOFTIRQ, STEAL, FIELDS };

static bool is_allowed(const cpu_set_t *allowed, int processor)
{
    return processor >= 0 && processor < CPU_SETSIZE && CPU_ISSET(processor, allowed);
}

// Adds a processor's line. Linux counts idle and stolen time exactly and prints whole ticks.
static void add_processor(struct rg_processors *now, const double ticks[FIELDS], double tick_ms)
{
    now->count++;
    now->idle_ms += (ticks[IDLE] + ticks[IOWAIT]) * tick_ms;
    now->stolen_ms += ticks[STEAL] * tick_ms;
    now->grain_ms += tick_ms;
}

// Reads the processors' lines. The line of all together is rounded once, so it is taken instead if
// this process may use them all.
static void read_processors(FILE *file, const cpu_set_t *allowed, struct rg_processors *now)
{
    const double tick_ms = 1e3 / (double)sysconf(_SC_CLK_TCK);
    struct rg_processors all = {0};
    bool is_all = true;
    char line[512];
    while (fgets(line, sizeof(line), file) && !strncmp(line, "cpu", 3)) {
        double t[FIELDS];
        const int processor = line[3] == ' ' ? -1 : atoi(line + 3);
        if (sscanf(line, "%*s %lf %lf %lf %lf %lf %lf %lf %lf", &t[USER], &t[NICE], &t[SYSTEM],
                   &t[IDLE], &t[IOWAIT], &t[IRQ], &t[SOFTIRQ], &t[STEAL]) != FIELDS)
            return;
        if (processor < 0)
            add_processor(&all, t, tick_ms);
        else if (is_allowed(allowed, processor))
            add_processor(now, t, tick_ms);
        else
            is_all = false;
    }
    if (is_all && all.count) {
        all.count = now->count;
        *now = all;
    }
}

// The processor time of a process, in milliseconds; NAN if it has gone.
static double process_ms(clockid_t clock)
{
    struct timespec time;
    return clock_gettime(clock, &time) ? NAN
                                       : (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

static double ended_children_ms(void)
{
    struct rusage used;
    getrusage(RUSAGE_CHILDREN, &used);
    return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) * 1e3 +
           (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec) * 1e-3;
}

// Adds a thread's time on a processor, and the time that it was ready to run without one.
static void add_thread(pid_t process, const char *thread, struct rg_processors *now)
{
    unsigned long long ran_ns, waited_ns;
    char path[64];
    snprintf(path, sizeof(path), "/proc/%d/task/%.16s/schedstat", (int)process, thread);
    FILE *file = fopen(path, "r");
    if (file && fscanf(file, "%llu %llu", &ran_ns, &waited_ns) == 2) {
        now->ran_ms += 1e-6 * (double)ran_ns;
        now->waited_ms += 1e-6 * (double)waited_ns;
    }
    if (file)
        fclose(file);
}

static void read_threads(pid_t process, struct rg_processors *now)
{
    char path[64];
    snprintf(path, sizeof(path), "/proc/%d/task", (int)process);
    DIR *folder = opendir(path);
    for (const struct dirent *entry; folder && (entry = readdir(folder));)
        if (*entry->d_name != '.')
            add_thread(process, entry->d_name, now);
    if (folder)
        closedir(folder);
}

struct rg_processors rg_processors_read(const char *root, const pid_t *ours, int our_count)
{
    char path[1024];
    cpu_set_t allowed;
    struct rg_processors now = {0};
    snprintf(path, sizeof(path), "%s/proc/stat", root);
    FILE *file = sched_getaffinity(0, sizeof(allowed), &allowed) ? NULL : fopen(path, "r");
    if (!file)
        return now;
    read_processors(file, &allowed, &now);
    fclose(file);
    now.at_ms = rg_now_ms();
    now.own_ms = process_ms(CLOCK_PROCESS_CPUTIME_ID) + ended_children_ms();
    for (int i = 0; i < our_count; i++) {
        clockid_t clock;
        now.own_ms += clock_getcpuclockid(ours[i], &clock) ? (double)NAN : process_ms(clock);
        read_threads(ours[i], &now);
    }
    return now;
}

struct rg_taken rg_taken_between(const struct rg_processors *before,
                                 const struct rg_processors *after)
{
    const double all_ms = (after->at_ms - before->at_ms) * after->count;
    const double stolen_ms = after->stolen_ms - before->stolen_ms;
    const double own_ms = after->own_ms - before->own_ms;
    const double idle_ms = after->idle_ms - before->idle_ms;
    const double others_ms = all_ms - idle_ms - stolen_ms - own_ms - after->grain_ms;
    const double ran_ms = after->ran_ms - before->ran_ms;
    const double waited_ms = fmax(after->waited_ms - before->waited_ms, 0);
    struct rg_taken taken = {0};
    if (!before->count || before->count != after->count || !(all_ms > 0))
        return taken;
    taken.stolen = fmin(fmax((stolen_ms - after->grain_ms) / all_ms, 0), 1);
    taken.others = others_ms > 0 ? fmin(others_ms / all_ms, 1) : 0; // NAN: nothing is known
    if (ran_ms + waited_ms > 0)
        taken.others = fmin(taken.others, waited_ms / (ran_ms + waited_ms));
    return taken;
}

struct rg_processors rg_processors_now(const pid_t *ours, int our_count)
{
    return rg_processors_read("", ours, our_count);
}

double rg_probe_ms(void)
{
    const char *given = getenv("RG_PROBE_S");
    return 1e3 * (given ? strtod(given, NULL) : 1);
}

double rg_machine_busy(rg_watch *watch)
{
    enum { STEP_MS = 10 };
    const double probe_ms = rg_probe_ms();
    const struct rg_processors before = watch(NULL, 0);
    while (rg_now_ms() < before.at_ms + probe_ms && !rg_interrupted())
        nanosleep(&(struct timespec){.tv_nsec = STEP_MS * 1000000}, NULL);
    const struct rg_processors after = watch(NULL, 0);
    const struct rg_taken taken = rg_taken_between(&before, &after);
    const double share = taken.stolen + taken.others;
    return probe_ms > 0 && share > RG_MOST_TAKEN ? share : 0;
}

void rg_machine_probe(rg_watch *watch)
{
    const double share = rg_machine_busy(watch);
    if (share > 0)
        rg_warning("others take %.0f %% of this machine's processors, so that what is measured now "
                   "is slower than it is; end them, or measure later",
                   100 * share);
}
